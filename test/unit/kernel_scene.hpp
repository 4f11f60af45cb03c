// Particles in the places that kernels find difficult, on a grid, with the reference beside them in the same state.
#pragma once

#include <memory>
#include <random>
#include <string>
#include <vector>

#include "kernel_reference.hpp"
#include "kernel_tables.hpp"
#include "material_zoo.hpp"
#include "mpm/mechanics/continuum.hpp"

namespace mpm::test {

/// Where the particles are.
enum class Places {
  lattice,    ///< two a cell along each axis
  irregular,  ///< the same, shaken
  mixed,      ///< moved since they were sorted, inside their blocks: groups are not what they were
  loose,      ///< moved as far as their blocks' tiles reach
  bodies,     ///< three bodies that share all blocks, of different laws
  half_way,   ///< half way between nodes along every axis, or next to it by less than a kernel's rounding
  lone        ///< each alone in its block
};
constexpr Places kAllPlaces[] = {Places::lattice, Places::irregular, Places::mixed, Places::loose,
                                 Places::bodies,  Places::half_way,  Places::lone};
inline const char* name_of(Places places) {
  constexpr const char* kNames[] = {"lattice", "irregular", "mixed", "loose", "bodies", "half way", "lone"};
  return kNames[static_cast<int>(places)];
}

inline std::vector<Isa> available_isas() {
  std::vector<Isa> there;
  for (const Isa isa : {Isa::plain, Isa::avx2, Isa::avx512}) {
    if (isa_available(isa)) there.push_back(isa);
  }
  return there;
}

/// `T`: what particles carry; `Shape`: of the reference, which goes with the kernels. Cells differ along the axes; they
/// are powers of two, so that half way is exactly so.
template <class Geometry, class T, template <class> class Shape = Ugimp>
struct KernelScene {
  static constexpr int kDim = Geometry::kDim;
  static constexpr Precision kPrecision = sizeof(T) == 4 ? Precision::float32 : Precision::float64;
  using Particle = ReferenceParticle<Geometry>;

  /// With `table` in place of uGIMP's kernels, if there is one.
  KernelScene(const paths::Specimen& specimen, Places places_of, Isa isa_of, const ContinuumSettings& more = {},
              const mpm_kernel::KernelTable<T>* table = nullptr)
      : isa(isa_of),
        kernels(table != nullptr ? *table : ugimp_kernels<T>(kDim, isa)),
        places(places_of),
        grid(GridLayout(kDim, Vec3(0.125, 0.25, 0.0625), Vec3::Zero(), Vec3(3.0, 6.0, 1.5))),
        reference({}, cells(grid.layout)),
        random(7) {
    const int count = places == Places::bodies ? 3 : 1;
    const paths::Specimen rubber{{"rubber", 1200.0, NeoHookeanDefinition{{2e5, 0.25}}}, 0.05, 0.0, 1.0};
    const paths::Specimen soil{
        {"soil", 1500.0, DruckerPragerDefinition{{1e5, 0.3}, 0.6, 0.2, 100.0, -1.0, ConeMatch::compression}},
        1e-3,
        -0.02,
        1.0};
    const paths::Specimen* of[] = {&specimen, &rubber, &soil};
    for (int s = 0; s < count; ++s) laws.push_back(make_law(of[s]->material));
    ReferenceParticle<Solid> rest;  // a gas has its pressure at rest
    rest.deform(laws[0], {}, 0.0, 1);
    const double speed = std::visit([&](const auto& law) { return law.wave_speed(rest.f, rest.tau, 1.0); }, laws[0]);
    stiffness = speed * speed;
    dt = std::min(specimen.time, 0.3 * smallest_cell() / speed);
    for (int s = 0; s < count; ++s) add_body(*of[s], s, count);
    settings = more;
    settings.gravity = Vec3(0.3, -0.2, -9.81);
    const auto gone = Sorter(settings.threads, kernel_grouping(kernels)).sort(sets, grid);
    if (gone) throw Error("a particle of the test is out of place");
    if (places == Places::mixed || places == Places::loose) move_on();
    grid.least_mass = 1e-30 * sets[0].mass;
    read_particles();
    mechanics = make_mechanics(kernels, sets, laws, settings);
  }

  double smallest_cell() const { return grid.layout.smallest_cell(); }

  /// The reference's particles become those of the sets, in their order.
  void read_particles() {
    reference.sets.resize(sets.size());
    for (std::size_t s = 0; s < sets.size(); ++s) {
      const ParticleSet& set = sets[s];
      ReferenceSet<Geometry>& to = reference.sets[s];
      to.mass = set.mass;
      to.half = set.half;
      to.law = &laws[s];
      to.particles.resize(set.size());
      for (int p = 0; p < set.size(); ++p) {
        Particle& one = to.particles[p];
        for (int k = 0; k < kDim; ++k) {
          one.x[k] = set.x[k][p];
          one.v[k] = set.v[k][p];
        }
        one.f = Geometry::load_matrix(set.f, p);
        one.tau = Geometry::load_symmetric(set.tau, p);
        for (std::size_t h = 0; h < set.history.size(); ++h) one.history[h] = set.history[h][p];
        one.id = set.id[p];
      }
    }
  }

  /// visit(block, node of it, the reference's node).
  template <class Visit>
  void each_node(Visit&& visit) {
    for (int b = 0; b < grid.blocks.size(); ++b) {
      for (int n = 0; n < grid.layout.nodes_per_block(); ++n) {
        visit(b, n, reference.node(grid.layout.node(grid.blocks.block(b), n)));
      }
    }
  }
  /// The reference's nodes become those of the grid, so that the next pass begins with the same numbers.
  void read_nodes() {
    for (ReferenceNode& n : reference.nodes()) n = {};
    each_node([&](int b, int n, ReferenceNode& to) {
      to.mass = grid.mass.at(b, 0, n);
      for (int c = 0; c < kDim; ++c) {
        to.momentum[c] = grid.momentum.at(b, c, n);
        to.velocity[c] = grid.velocity.at(b, c, n);
        to.force[c] = grid.force.at(b, c, n);
      }
    });
  }

  Isa isa;
  mpm_kernel::KernelTable<T> kernels;
  Places places;
  Grid grid;
  Reference<Geometry, Shape> reference;
  std::mt19937 random;
  std::vector<ParticleSet> sets;
  std::vector<Law> laws;
  ContinuumSettings settings;
  std::unique_ptr<Mechanics> mechanics;
  double dt = 0.0;         ///< three tenths of a cell's time, or the specimen's
  double stiffness = 0.0;  ///< of the first law: squared wave speed [J/kg]

 private:
  static std::array<double, 3> cells(const GridLayout& layout) {
    std::array<double, 3> cell{1.0, 1.0, 1.0};
    for (int k = 0; k < kDim; ++k) cell[k] = layout.cell(k);
    return cell;
  }
  double uniform(double size) { return std::uniform_real_distribution<double>(-size, size)(random); }

  // A place in cells, particle `p` of all.
  bool place(int p, double (&cells)[3]) {
    const int edge = places == Places::lone ? 3 : kDim == 3 ? 9 : 20;
    int count = 1;
    for (int k = 0; k < kDim; ++k) count *= edge;
    if (p >= count) return false;
    for (int k = 0; k < kDim; ++k, p /= edge) {
      const int i = p % edge;
      switch (places) {
        case Places::lone:
          cells[k] = 5.0 + 4.0 * i + uniform(1.4);  // blocks are four cells, the first nearest node is 3.5 cells on
          break;
        case Places::half_way: {
          const double middle = 4.5 + i / 2;
          const double sides[] = {middle, std::nextafter(middle, 0.0), std::nextafter(middle, 99.0), middle - 1e-10,
                                  middle + 1e-10};
          cells[k] = sides[random() % 5];
          break;
        }
        default:
          cells[k] = 4.25 + 0.5 * i + (places == Places::lattice ? 0.0 : uniform(0.6));
      }
    }
    return true;
  }

  void add_body(const paths::Specimen& specimen, int body, int bodies) {
    sets.emplace_back();
    ParticleSet& set = sets.back();
    set.name = specimen.material.name;
    set.precision = kPrecision;
    set.mass = specimen.material.density;
    for (int k = 0; k < kDim; ++k) set.mass *= 0.5 * grid.layout.cell(k);
    set.half = {0.25, 0.2, 0.5};
    set.lowest = {0.5, 0.5, 0.5};
    set.highest = {23.5, 23.5, 23.5};
    std::vector<std::array<double, 3>> at;
    double where[3] = {};
    for (int p = 0; place(p, where); ++p) {
      if (p % bodies == body) at.push_back({where[0], where[1], where[2]});
    }
    const std::size_t count = at.size();
    set.x.assign(kDim, PaddedArray<double>(count));
    set.next_x.assign(kDim, PaddedArray<double>(count));
    set.v.assign(kDim, ParticleScalar(kPrecision, count));
    set.f.assign(Geometry::kMatrix, ParticleScalar(kPrecision, count));
    set.tau.assign(Geometry::kSymmetric, ParticleScalar(kPrecision, count));
    set.history.assign(history_size(laws[body]), ParticleScalar(kPrecision, count));
    set.id.resize(count);
    double gradient[3][3];  // of the bodies' mean motion [1/s]
    for (auto& row : gradient) {
      for (double& l : row) l = uniform(specimen.strain / dt);
    }
    for (std::size_t p = 0; p < count; ++p) {
      set.id[p] = static_cast<std::uint32_t>(p * bodies + body);
      for (int k = 0; k < kDim; ++k) {
        set.x[k][p] = at[p][k] * grid.layout.cell(k);
        double v = uniform(0.3 * specimen.strain * smallest_cell() / dt);
        for (int j = 0; j < kDim; ++j) v += gradient[k][j] * (at[p][j] - 8.0) * smallest_cell();
        set.v[k].set(p, v);
      }
      store(set, static_cast<int>(p), worked(specimen, laws[body]));
    }
  }

  // What a particle has gone through before the test: hardly any strain, or the path that shows the law.
  Particle worked(const paths::Specimen& specimen, const Law& law) {
    Particle particle;
    const double size = specimen.strain * std::pow(10.0, uniform(1.0) - 0.7);
    for (int n = 0; n < 8; ++n) {
      const Matrix3<double> m = paths::random_gradient(random, size);
      const double press = specimen.pressing / 8.0;
      if constexpr (kDim == 3) {
        particle.deform(law, {m.xx + press, m.xy, m.xz, m.yx, m.yy + press, m.yz, m.zx, m.zy, m.zz + press}, dt, 4);
      } else {
        particle.deform(law, {m.xx + press, m.xz, m.zx, m.zz + press, 0.0}, dt, 4);
      }
    }
    return particle;
  }
  static void store(ParticleSet& set, int p, const Particle& particle) {
    double m[Geometry::kMatrix], s[Geometry::kSymmetric];
    double *f[Geometry::kMatrix], *tau[Geometry::kSymmetric];
    for (int c = 0; c < Geometry::kMatrix; ++c) f[c] = m + c;
    for (int c = 0; c < Geometry::kSymmetric; ++c) tau[c] = s + c;
    Geometry::store_matrix(particle.f, f, 0);
    Geometry::store_symmetric(particle.tau, tau, 0);
    for (int c = 0; c < Geometry::kMatrix; ++c) set.f[c].set(p, m[c]);
    for (int c = 0; c < Geometry::kSymmetric; ++c) set.tau[c].set(p, s[c]);
    for (std::size_t h = 0; h < set.history.size(); ++h) set.history[h].set(p, particle.history[h]);
  }

  // As after some steps without a sort: anywhere in the block, or in what its tile reaches.
  void move_on() {
    const double first = places == Places::loose ? -1.49 : -0.49, last = places == Places::loose ? 4.49 : 3.49;
    for (ParticleSet& set : sets) {
      for (int owner = 0; owner < grid.blocks.owners(); ++owner) {
        const auto& block = grid.blocks.block(grid.blocks.owner_block(owner));
        for (std::uint32_t p = set.begin[owner]; p < set.begin[owner + 1]; ++p) {
          if (random() % 4 == 0) continue;  // some have stayed
          for (int k = 0; k < kDim; ++k) {
            const double place = std::uniform_real_distribution<double>(first, last)(random);
            set.x[k][p] = (block[k] * kBlockEdge + place) * grid.layout.cell(k);
          }
        }
        grid.loose[owner] = places == Places::loose ? 1 : 0;
      }
    }
  }
};

}  // namespace mpm::test
