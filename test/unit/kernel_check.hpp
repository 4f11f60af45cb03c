// Every pass of a step against the reference (kernel_reference.hpp), which begins each pass with the numbers that the
// kernels begin it with.
#pragma once

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "kernel_scene.hpp"
#include "mpm/mechanics/kernel_views.hpp"

namespace mpm::test {
/// How far a field is from the reference's.
struct Difference {
  double largest = 0.0, error = 0.0;
  void add(double found, double expected) {
    largest = std::max(largest, std::abs(expected));
    const double apart = std::abs(found - expected);
    error = std::isfinite(apart) ? std::max(error, apart) : std::numeric_limits<double>::infinity();
  }
};

/// Of the largest value of a field. Double: what the project promises, a thousand times what one pass needs.
/// Single: a place in a tile is a number up to 8, rounded to 2 epsilon, and weights change by 1 / (2 half) = 2.5 times
/// as much; a node sums the particles of some 20 cells, each sum rounded; together a few tens of epsilon.
template <class T>
constexpr double kTolerance = sizeof(T) == 8 ? 1e-12 : 64 * std::numeric_limits<float>::epsilon();

/// A scene, and the passes of its step beside the reference's.
template <class Geometry, class T, template <class> class Shape = Ugimp>
class Kernels {
  static constexpr int kDim = Geometry::kDim;
  using Scene = KernelScene<Geometry, T, Shape>;

 public:
  Kernels(const paths::Specimen& specimen, Places places, Isa isa, double flip,
          const mpm_kernel::KernelTable<T>* table = nullptr)
      : name_(specimen.material.name + ", " + name_of(places) + ", " + isa_name(isa)),
        scene_(specimen, places, isa, settings(flip), table),
        context_{scene_.grid, scene_.dt} {}

  /// A step of either schedule, pass by pass.
  void check(bool regather) {
    for (ParticleSet& set : scene_.sets) {
      if (!regather) set.next_x.clear();  // particles are placed at once
    }
    scatter_momentum();
    strain_and_force(regather ? 0.5 * scene_.dt : scene_.dt);
    update_momentum();
    if (regather) {
      move_and_regather();
      strain_and_place();
    } else {
      move_particles();
    }
  }

  void scatter_momentum() {
    scene_.mechanics->scatter_momentum(context_);
    scene_.reference.scatter_momentum();
    compare_nodes("mass", scene_.grid.mass, [](const ReferenceNode& n, int) { return n.mass; });
    compare_nodes("momentum", scene_.grid.momentum, [](const ReferenceNode& n, int c) { return n.momentum[c]; });
    expect_total("mass", scene_.grid.mass, [](const auto& set, const auto&, int) { return set.mass; });
    expect_total("momentum", scene_.grid.momentum,
                 [](const auto& set, const auto& p, int c) { return set.mass * p.v[c]; });
    scene_.read_nodes();
    scene_.reference.nodal_velocity(scene_.grid.least_mass);
    compare_nodes(
        "velocity", scene_.grid.velocity, [](const ReferenceNode& n, int c) { return n.velocity[c]; }, 1e-12);
  }

  void strain_and_force(double dt) {
    scene_.read_nodes();
    scene_.mechanics->strain_and_force(context_, dt);
    EXPECT_FALSE(scene_.mechanics->failed());
    scene_.reference.strain(dt, scene_.settings.gradient_terms);
    compare_state();
    scene_.reference.force();  // of the kernels' stress: a stress that is off by its tolerance is another matter
    compare_nodes("force", scene_.grid.force, [](const ReferenceNode& n, int c) { return n.force[c]; });
    // Nothing pushes from outside: GIMP notes (1.26), the sum of G over the nodes of a particle is zero.
    expect_total("force", scene_.grid.force, [](const auto&, const auto&, int) { return 0.0; });
  }

  void update_momentum() {
    scene_.read_nodes();
    scene_.mechanics->update_momentum(context_);
    double gravity[3] = {};
    for (int k = 0; k < kDim; ++k) gravity[k] = scene_.settings.gravity[scene_.grid.layout.axis(k)];
    scene_.reference.nodal_update(scene_.dt, gravity, scene_.grid.least_mass);
    // Nodes are double in either precision.
    compare_nodes(
        "acceleration", scene_.grid.force, [](const ReferenceNode& n, int c) { return n.force[c]; }, 1e-12);
    compare_nodes(
        "velocity", scene_.grid.velocity, [](const ReferenceNode& n, int c) { return n.velocity[c]; }, 1e-12);
  }

  void move_particles() {
    scene_.read_nodes();
    scene_.mechanics->move_particles(context_);
    scene_.reference.move(scene_.dt, scene_.settings.transfer.flip);
    compare_motion(&ParticleSet::x);
    check_reach(&ParticleSet::x);
  }

  void move_and_regather() {
    scene_.read_nodes();
    scene_.mechanics->move_and_regather(context_);
    scene_.reference.move(scene_.dt, scene_.settings.transfer.flip);
    compare_motion(&ParticleSet::next_x);
    scene_.reference.gather_momentum();
    compare_nodes("momentum", scene_.grid.momentum, [](const ReferenceNode& n, int c) { return n.momentum[c]; });
    expect_total("momentum", scene_.grid.momentum,
                 [](const auto& set, const auto& p, int c) { return set.mass * p.v[c]; });
    scene_.read_nodes();
    scene_.reference.nodal_velocity(scene_.grid.least_mass);
    compare_nodes(
        "velocity", scene_.grid.velocity, [](const ReferenceNode& n, int c) { return n.velocity[c]; }, 1e-12);
  }

  void strain_and_place() {
    scene_.read_nodes();
    std::vector<PaddedArray<double>> placed;
    for (const ParticleSet& set : scene_.sets) placed.push_back(set.next_x[0]);
    scene_.mechanics->strain_and_place(context_, 0.5 * scene_.dt);
    scene_.reference.strain(0.5 * scene_.dt, scene_.settings.gradient_terms);
    compare_state();
    compare_nodes(
        "acceleration", scene_.grid.force, [](const ReferenceNode& n, int c) { return n.force[c]; }, 0.0);
    for (std::size_t s = 0; s < scene_.sets.size(); ++s) {
      EXPECT_TRUE(std::equal(placed[s].begin(), placed[s].end(), scene_.sets[s].x[0].begin())) << name_;
    }
    check_reach(&ParticleSet::x);
  }

  void scatter_load() {
    std::vector<std::vector<PaddedArray<double>>> loads;
    std::vector<mpm_kernel::SetView<T>> views;
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    for (std::size_t s = 0; s < scene_.sets.size(); ++s) {
      views.push_back(view_of<T>(scene_.sets[s], scene_.laws[s], scene_.kernels.laws));
      loads.emplace_back(kDim, PaddedArray<double>(scene_.sets[s].size()));
      if (s == 1) continue;  // the second body has no load
      for (int k = 0; k < kDim; ++k) {
        for (int p = 0; p < scene_.sets[s].size(); ++p) {
          loads[s][k][p] = scene_.reference.sets[s].particles[p].load[k] = u(scene_.random);
        }
        views[s].load[k] = loads[s][k].data();
      }
    }
    NodalField field(kDim, scene_.grid.layout.nodes_per_block());
    field.resize(scene_.grid.blocks.size());
    std::fill(field.block(0), field.block(scene_.grid.blocks.size()), 0.0);
    each_owner(scene_.grid, 1, [&](const mpm_kernel::BlockView& block) {
      scene_.kernels.scatter_load(view_of(scene_.grid), block, views.data(), static_cast<int>(views.size()),
                                  field.data());
    });
    scene_.reference.scatter_load();
    compare_nodes("load", field, [](const ReferenceNode& n, int c) { return n.load[c]; });
    expect_total("load", field, [](const auto& set, const auto& p, int c) { return set.mass * p.load[c]; });
  }

 private:
  static ContinuumSettings settings(double flip) {
    ContinuumSettings settings;
    settings.transfer.flip = flip;
    return settings;
  }

  template <class Value>
  void compare_nodes(const char* what, const NodalField& field, Value&& value, double tolerance = kTolerance<T>) {
    Difference difference;
    double inside = 0.0, all = 0.0;
    scene_.each_node([&](int b, int n, const ReferenceNode& expected) {
      for (int c = 0; c < field.components(); ++c) {
        difference.add(field.at(b, c, n), value(expected, c));
        inside += std::abs(value(expected, c));
      }
    });
    for (const ReferenceNode& n : scene_.reference.nodes()) {
      for (int c = 0; c < field.components(); ++c) all += std::abs(value(n, c));
    }
    EXPECT_NEAR(inside, all, 1e-12 * all) << name_ << ": nodes of the " << what << " are not in the grid";
    EXPECT_LE(difference.error, tolerance * difference.largest) << name_ << ": " << what;
  }

  // The sum over nodes against that over particles, as exact as the parts of one: each particle's weights sum to one.
  template <class Value>
  void expect_total(const char* what, const NodalField& field, Value&& of_particle) {
    for (int c = 0; c < field.components(); ++c) {
      double found = 0.0, expected = 0.0, size = 0.0;
      scene_.each_node([&](int b, int n, const ReferenceNode&) {
        found += field.at(b, c, n);
        size += std::abs(field.at(b, c, n));
      });
      scene_.reference.each([&](const auto& set, const auto& p) {
        expected += of_particle(set, p, c);
        size += std::abs(of_particle(set, p, c));
      });
      EXPECT_NEAR(found, expected, 0.1 * kTolerance<T> * size) << name_ << ": sum of the " << what;
    }
  }

  void compare_state() {
    // The dashpot's work is the sum of three differences of what isochoric tensors of size 1 have in excess: in single
    // precision it is lost among the roundings of these, one or two epsilon each, times the stiffness.
    const double work = sizeof(T) == 4 ? 6 * std::numeric_limits<T>::epsilon() * scene_.stiffness : 0.0;
    for (std::size_t s = 0; s < scene_.sets.size(); ++s) {
      const ParticleSet& set = scene_.sets[s];
      Difference f, tau, history[mpm_kernel::kMostHistory];
      for (int p = 0; p < set.size(); ++p) {
        const auto& expected = scene_.reference.sets[s].particles[p];
        double m[Geometry::kMatrix], t[Geometry::kSymmetric];
        double *to_m[Geometry::kMatrix], *to_t[Geometry::kSymmetric];
        for (int c = 0; c < Geometry::kMatrix; ++c) to_m[c] = m + c;
        for (int c = 0; c < Geometry::kSymmetric; ++c) to_t[c] = t + c;
        Geometry::store_matrix(expected.f, to_m, 0);
        Geometry::store_symmetric(expected.tau, to_t, 0);
        for (int c = 0; c < Geometry::kMatrix; ++c) f.add(set.f[c][p], m[c]);
        for (int c = 0; c < Geometry::kSymmetric; ++c) tau.add(set.tau[c][p], t[c]);
        for (std::size_t h = 0; h < set.history.size(); ++h) history[h].add(set.history[h][p], expected.history[h]);
      }
      const std::string of = name_ + ": " + set.name;
      EXPECT_LE(f.error, kTolerance<T> * f.largest) << of << ", F";
      EXPECT_LE(tau.error, kTolerance<T> * tau.largest) << of << ", stress";
      for (int h = 0; h < static_cast<int>(set.history.size()); ++h) {
        const bool is_work = std::visit([&](const auto& law) { return law.kPlasticWork == h; }, scene_.laws[s]);
        EXPECT_LE(history[h].error, kTolerance<T> * history[h].largest + (is_work ? work : 0.0))
            << of << ", history " << h;
      }
    }
    // The next pass begins with the kernels' numbers.
    const auto before = scene_.reference.sets;
    scene_.read_particles();
    for (std::size_t s = 0; s < before.size(); ++s) {
      for (std::size_t p = 0; p < before[s].particles.size(); ++p) {
        std::copy(before[s].particles[p].next_x, before[s].particles[p].next_x + 3,
                  scene_.reference.sets[s].particles[p].next_x);
      }
    }
  }

  void compare_motion(std::vector<PaddedArray<double>> ParticleSet::*places) {
    Difference v, displacement;
    for (std::size_t s = 0; s < scene_.sets.size(); ++s) {
      const ParticleSet& set = scene_.sets[s];
      for (int p = 0; p < set.size(); ++p) {
        auto& expected = scene_.reference.sets[s].particles[p];
        for (int k = 0; k < kDim; ++k) {
          v.add(set.v[k][p], expected.v[k]);
          displacement.add((set.*places)[k][p] - expected.x[k], expected.next_x[k] - expected.x[k]);
          expected.v[k] = set.v[k][p];
          expected.next_x[k] = (set.*places)[k][p];
        }
      }
    }
    EXPECT_GT(displacement.largest, 0.0);
    EXPECT_LE(v.error, kTolerance<T> * v.largest) << name_ << ": particle velocity";
    // Positions, up to 3 m, are rounded.
    const double rounding = 3.0 * std::numeric_limits<double>::epsilon();
    EXPECT_LE(displacement.error, kTolerance<T> * displacement.largest + rounding) << name_ << ": displacement";
  }

  // A block is loose when a particle is beyond it, less the kernels' slack; what lies within rounding of the limit may
  // be on either side.
  void check_reach(std::vector<PaddedArray<double>> ParticleSet::*places) {
    const double near = 8 * mpm_kernel::kTileEdge * std::numeric_limits<T>::epsilon();
    for (int owner = 0; owner < scene_.grid.blocks.owners(); ++owner) {
      const auto& block = scene_.grid.blocks.block(scene_.grid.blocks.owner_block(owner));
      double beyond = -1.0;  // how far the farthest one is beyond the limit [cells]
      for (const ParticleSet& set : scene_.sets) {
        for (std::uint32_t p = set.begin[owner]; p < set.begin[owner + 1]; ++p) {
          for (int k = 0; k < kDim; ++k) {
            const double at = scene_.grid.layout.in_cells(k, (set.*places)[k][p]) - block[k] * kBlockEdge;
            beyond = std::max({beyond, -0.5 + mpm_kernel::kSlack - at, at - 3.5 + mpm_kernel::kSlack});
          }
        }
      }
      if (std::abs(beyond) > near) {
        EXPECT_EQ(scene_.grid.loose[owner] != 0, beyond > 0.0) << name_ << " block " << owner;
      }
    }
  }

  std::string name_;
  Scene scene_;
  StepContext context_;
};

}  // namespace mpm::test
