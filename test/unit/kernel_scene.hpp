// Particles on a grid at positions that are difficult for kernels, and the reference in the same state.
#pragma once

#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "kernel_reference.hpp"
#include "kernel_tables.hpp"
#include "material_zoo.hpp"
#include "mpm/mechanics/continuum.hpp"

namespace mpm::test {

/// Arrangements of particles.
enum class Places {
  lattice,    ///< two a cell along each axis
  irregular,  ///< a lattice with random displacements
  mixed,      ///< moved inside their blocks since they were sorted, so that groups are mixed
  loose,      ///< moved as far as their blocks' tiles reach
  bodies,     ///< three bodies with different laws that share all blocks
  half_way,   ///< half way between nodes along every axis, to within a kernel's rounding
  lone,       ///< each alone in its block
  walled      ///< in a box of walls that they fill, some slightly beyond them
};
constexpr Places kAllPlaces[] = {Places::lattice, Places::irregular, Places::mixed, Places::loose,
                                 Places::bodies,  Places::half_way,  Places::lone,  Places::walled};
inline const char* name_of(Places places) {
  constexpr const char* kNames[] = {"lattice", "irregular", "mixed", "loose", "bodies", "half way", "lone", "walled"};
  return kNames[static_cast<int>(places)];
}

inline std::vector<Isa> available_isas() {
  std::vector<Isa> there;
  for (const Isa isa : {Isa::plain, Isa::avx2, Isa::avx512}) {
    if (isa_available(isa)) there.push_back(isa);
  }
  return there;
}

/// `T`: precision of the particles. Cells differ between the axes; they are powers of two, so that half way is exact.
template <class Geometry, class T>
struct KernelScene {
  static constexpr int kDim = Geometry::kDim;
  static constexpr Precision kPrecision = sizeof(T) == 4 ? Precision::float32 : Precision::float64;
  using Particle = ReferenceParticle<Geometry>;

  KernelScene(ShapeKind shape_of, const paths::Specimen& specimen, Places places_of, Isa isa_of,
              const ContinuumSettings& more = {}, const AxisRules& axis_of = {})
      : shape(shape_of),
        axis(axis_of),
        isa(isa_of),
        kernels(kernels_of<Geometry, T>(shape, isa)),
        places(places_of),
        fields(make_fields(layout(places))),
        reference(shape, reference_grid(grid.layout, places == Places::walled, axis)),
        random(7) {
    grid.has_wall.fill(places == Places::walled);
    const int count = places == Places::bodies ? 3 : 1;
    const paths::Specimen rubber{{"rubber", 1200.0, NeoHookeanDefinition{{2e5, 0.25}}}, 0.05, 0.0, 1.0};
    const paths::Specimen soil{
        {"soil", 1500.0, DruckerPragerDefinition{{1e5, 0.3}, 0.6, 0.2, 100.0, -1.0, ConeMatch::compression}},
        1e-3,
        -0.02,
        1.0};
    const paths::Specimen* of[] = {&specimen, &rubber, &soil};
    for (int s = 0; s < count; ++s) laws.push_back(make_law(of[s]->material));
    ReferenceParticle<Solid> rest;  // a gas at rest has its initial pressure
    rest.deform(laws[0], {}, 0.0, 1);
    const double speed = std::visit([&](const auto& law) { return law.wave_speed(rest.f, rest.tau, 1.0); }, laws[0]);
    stiffness = speed * speed;
    dt = std::min(specimen.time, 0.3 * smallest_cell() / speed);
    for (int s = 0; s < count; ++s) add_body(*of[s], s, count);
    settings = more;
    if constexpr (Geometry::kHoop) {
      settings.axis_motion = axis.motion;
      reference.by_point = axis.motion == AxisMotion::point;
    }
    for (ParticleSet& set : sets) prepare(set, shape, settings.transfer);
    if (settings.transfer.kind == TransferKind::apic) turn_particles();
    settings.gravity = Vec3(0.3, -0.2, -9.81);
    const auto gone = Sorter(settings.threads, kernel_grouping(kernels)).sort(sets, fields);
    if (gone) throw Error("a particle of the test is out of place");
    if (places == Places::mixed || places == Places::loose) move_on();
    grid.least_mass = 1e-30 * sets[0].least_mass();
    read_particles();
    mechanics = make_mechanics(kernels, fields, sets, laws, settings);
  }

  double smallest_cell() const { return grid.layout.smallest_cell(); }

  /// Copies the particles of the sets, in their order, to the reference.
  void read_particles() {
    reference.sets.resize(sets.size());
    for (std::size_t s = 0; s < sets.size(); ++s) {
      const ParticleSet& set = sets[s];
      ReferenceSet<Geometry>& to = reference.sets[s];
      to.half = set.half;
      to.law = &laws[s];
      to.particles.resize(set.size());
      for (int p = 0; p < set.size(); ++p) {
        Particle& one = to.particles[p];
        one.mass = set.mass_of(p);
        for (int k = 0; k < kDim; ++k) {
          one.x[k] = set.x[k][p];
          one.v[k] = set.v[k][p];
        }
        one.f = Geometry::load_matrix(set.f, p);
        one.tau = Geometry::load_symmetric(set.tau, p);
        for (std::size_t h = 0; h < set.history.size(); ++h) one.history[h] = set.history[h][p];
        for (std::size_t c = 0; c < set.affine.size(); ++c) one.affine[c / kDim][c % kDim] = set.affine[c][p];
        one.id = set.id[p];
      }
    }
  }

  /// Calls visit(particle) for all particles of the reference.
  template <class Visit>
  void each_reference(Visit&& visit) {
    reference.each([&](const auto&, auto& p) { visit(p); });
  }
  /// Calls visit(block, node in the block, node of the reference) for all nodes.
  template <class Visit>
  void each_node(Visit&& visit) {
    for (int b = 0; b < grid.blocks.size(); ++b) {
      for (int n = 0; n < grid.layout.nodes_per_block(); ++n) {
        visit(b, n, reference.node(grid.layout.node(grid.blocks.block(b), n)));
      }
    }
  }
  /// Copies the nodes of the grid to the reference, so that the next pass begins with the same numbers.
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

  ShapeKind shape;
  AxisRules axis;  ///< rules of the shape function at the axis, for rings
  Isa isa;
  mpm_kernel::KernelTable<T> kernels;
  Places places;
  Fields fields;
  Grid& grid = *fields.front();
  Reference<Geometry> reference;
  std::mt19937 random;
  std::vector<ParticleSet> sets;
  std::vector<Law> laws;
  ContinuumSettings settings;
  std::unique_ptr<Mechanics> mechanics;
  double dt = 0.0;         ///< a Courant number of 0.3, or the step of the specimen [s]
  double stiffness = 0.0;  ///< squared wave speed of the first law [J/kg]

 private:
  static constexpr int kEdge = kDim == 3 ? 9 : 20;  ///< particles along an axis, two a cell
  static GridLayout layout(Places places) {
    const double cells = places == Places::walled ? 0.5 * (kEdge + 1) : 24.0;
    return {kDim, Vec3(0.125, 0.25, 0.0625), Vec3::Zero(), cells * Vec3(0.125, 0.25, 0.0625)};
  }
  static ReferenceGrid reference_grid(const GridLayout& layout, bool walls, const AxisRules& axis) {
    ReferenceGrid grid;
    grid.rings = Geometry::kHoop;
    grid.axis = axis;
    for (int k = 0; k < kDim; ++k) {
      grid.cell[k] = layout.cell(k);
      if (walls) grid.low_wall[k] = 0.0;
      if (walls) grid.high_wall[k] = layout.last_node(k);
    }
    return grid;
  }
  double uniform(double size) { return std::uniform_real_distribution<double>(-size, size)(random); }

  // Least radius of a ring [cells]: from there on 1 / r is as exact as the rest, although single precision rounds the
  // position by 1e-6 of a cell.
  static constexpr double kLeastRadius = 0.1;

  // Sets the position of particle `p` [cells].
  bool place(int p, double (&cells)[3]) {
    const int edge = places == Places::lone ? 3 : kEdge;
    int count = 1;
    for (int k = 0; k < kDim; ++k) count *= edge;
    if (p >= count) return false;
    for (int k = 0; k < kDim; ++k, p /= edge) {
      const int i = p % edge;
      switch (places) {
        case Places::lone:
          cells[k] =
              5.0 + 4.0 * i + uniform(1.4);  // a block is four cells; the one for the nearest node begins at 3.5 cells
          break;
        case Places::half_way: {
          const double middle = 4.5 + i / 2;
          const double sides[] = {middle, std::nextafter(middle, 0.0), std::nextafter(middle, 99.0), middle - 1e-10,
                                  middle + 1e-10};
          cells[k] = sides[random() % 5];
          break;
        }
        case Places::walled:
          cells[k] = std::clamp(0.25 + 0.5 * i + uniform(0.6), -0.15, grid.layout.last_node(k) + 0.15);
          break;
        default:
          cells[k] = 4.25 + 0.5 * i + (places == Places::lattice ? 0.0 : uniform(0.6));
      }
    }
    // Rings lie from the axis on.
    if (Geometry::kHoop) cells[0] = std::max(places == Places::walled ? cells[0] : cells[0] - 4.0, kLeastRadius);
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
    for (int k = 0; k < kDim; ++k) {
      set.lowest[k] = places == Places::walled ? -0.2 : 0.5;
      set.highest[k] = grid.layout.last_node(k) - set.lowest[k];
      if (Geometry::kHoop && k == 0) set.lowest[0] = 0.0;
    }
    std::vector<std::array<double, 3>> at;
    double where[3] = {};
    for (int p = 0; place(p, where); ++p) {
      if (p % bodies == body) at.push_back({where[0], where[1], where[2]});
    }
    const std::size_t count = at.size();
    if (Geometry::kHoop) {
      set.whole_domains = axis.domains == AxisDomains::whole;
      set.planar_functions = axis.functions == AxisFunctions::planar;
      set.masses.assign(1, ParticleScalar(kPrecision, count));
      for (std::size_t p = 0; p < count; ++p) set.masses[0].set(p, set.mass * at[p][0]);
      set.mass = std::numeric_limits<double>::quiet_NaN();  // never used
    }
    set.x.assign(kDim, PaddedArray<double>(count));
    set.next_x.assign(kDim, PaddedArray<double>(count));
    set.v.assign(kDim, ParticleScalar(kPrecision, count));
    set.f.assign(Geometry::kMatrix, ParticleScalar(kPrecision, count));
    set.tau.assign(Geometry::kSymmetric, ParticleScalar(kPrecision, count));
    set.history.assign(history_size(laws[body]), ParticleScalar(kPrecision, count));
    set.id.resize(count);
    double gradient[3][3];  // velocity gradient of the bodies' mean motion [1/s]
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

  // The state of a particle before the test: after hardly any strain, or after the strain path of the specimen.
  Particle worked(const paths::Specimen& specimen, const Law& law) {
    Particle particle;
    const double size = specimen.strain * std::pow(10.0, uniform(1.0) - 0.7);
    if (traits_of(shape).follows_deformation()) particle.f = stretched();
    for (int n = 0; n < 8; ++n) {
      const Matrix3<double> m = paths::random_gradient(random, size);
      const double all[3][3] = {{m.xx, m.xy, m.xz}, {m.yx, m.yy, m.yz}, {m.zx, m.zy, m.zz}};
      double l[kDim][kDim];
      for (int c = 0; c < kDim; ++c) {
        for (int k = 0; k < kDim; ++k) l[c][k] = all[grid.layout.axis(c)][grid.layout.axis(k)];
        l[c][c] += specimen.pressing / 8.0;
      }
      auto du = Geometry::gradient(l);
      if constexpr (Geometry::kHoop) du.yy = m.yy + specimen.pressing / 8.0;
      particle.deform(law, du, dt, 4);
    }
    return particle;
  }
  // A deformation that stretches, compresses and shears a domain, sometimes beyond its largest reach.
  typename Geometry::template Matrix<double> stretched() {
    double m[Geometry::kMatrix], *at[Geometry::kMatrix];
    for (int c = 0; c < Geometry::kMatrix; ++c) at[c] = m + c;
    Geometry::store_matrix(Particle().f, at, 0);
    for (int k = 0; k < kDim; ++k) {
      const double stretch = std::pow(2.0, 0.25 + uniform(1.25));
      for (int c = 0; c < kDim; ++c) m[c * kDim + k] = stretch * (m[c * kDim + k] + uniform(0.3));
    }
    return Geometry::load_matrix(at, 0);
  }
  // Sets the affine fields of APIC, with velocity gradients of up to 0.1 per step.
  void turn_particles() {
    for (ParticleSet& set : sets) {
      for (ParticleScalar& component : set.affine) {
        for (int p = 0; p < set.size(); ++p) component.set(p, uniform(0.02 * smallest_cell() * smallest_cell() / dt));
      }
    }
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

  // Moves particles as some steps without a sort do: anywhere in the block, or in the reach of its tile.
  void move_on() {
    const bool far = places == Places::loose;
    const double reach = far ? (shape == ShapeKind::bspline3 ? 0.99 : 1.49) : 0.49;  // beyond the block
    for (std::size_t s = 0; s < sets.size(); ++s) {
      ParticleSet& set = sets[s];
      for (int owner = 0; owner < grid.blocks.owners(); ++owner) {
        const auto& block = grid.blocks.block(grid.blocks.owner_block(owner));
        for (std::uint32_t p = set.begin[owner]; p < set.begin[owner + 1]; ++p) {
          if (random() % 4 == 0) continue;  // some stay in place
          const std::array<double, 3> room = room_of(set, static_cast<int>(p));
          for (int k = 0; k < kDim; ++k) {
            const double most = std::min(reach, room[k]);
            const double place = std::uniform_real_distribution<double>(-most, kBlockEdge - 1 + most)(random);
            set.x[k][p] = (block[k] * kBlockEdge + place) * grid.layout.cell(k);
            if (Geometry::kHoop && k == 0) set.x[0][p] = std::max(set.x[0][p], kLeastRadius * grid.layout.cell(0));
          }
        }
        grid.loose[owner] = far ? 1 : 0;
      }
    }
  }
  // Distance by which a particle may leave its block before its domain leaves the block's tile [cells].
  std::array<double, 3> room_of(ParticleSet& set, int p) {
    std::array<double, 3> room{9.0, 9.0, 9.0};
    if (!traits_of(shape).follows_deformation() || shape == ShapeKind::ugimp_stretch) return room;
    Particle particle;
    particle.f = Geometry::load_matrix(set.f, p);
    Reference<Geometry>::note_domain(particle);
    ReferenceSet<Geometry> one;
    one.half = set.half;
    double d[kDim][kDim];
    ReferenceGrid plane = reference.grid();  // the domain of a ring may shrink when the ring moves
    plane.rings = false;
    reference_domain(plane, Reference<Geometry>::place_of(one, particle), d);
    for (int k = 0; k < kDim; ++k) {
      room[k] = mpm_kernel::kTileMargin - 1e-3;
      for (const auto& vector : d) room[k] -= std::abs(vector[k]) / grid.layout.cell(k);
    }
    return room;
  }
};

}  // namespace mpm::test
