// Comparison of the fields of grid and particles after a kernel with the reference (kernel_reference.hpp), and the
// allowed differences.
#pragma once

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "kernel_scene.hpp"
#include "mpm/mechanics/kernel_views.hpp"

namespace mpm::test {

/// Difference between a field and that of the reference.
struct Difference {
  double largest = 0.0, error = 0.0;
  void add(double found, double expected) {
    largest = std::max(largest, std::abs(expected));
    const double apart = std::abs(found - expected);
    error = std::isfinite(apart) ? std::max(error, apart) : std::numeric_limits<double>::infinity();
  }
};

/// Tolerance over the largest value of a field. Double: that of the project, a thousand times the round-off of a pass.
/// Single: a coordinate in a tile is a number up to 8, rounded to 2 epsilon, and weights change by 1 / (2 half) = 2.5
/// times as much; a node sums the particles of some 20 cells, each sum rounded; together a few tens of epsilon.
template <class T>
constexpr double kTolerance = sizeof(T) == 8 ? 1e-12 : 64 * std::numeric_limits<float>::epsilon();

/// A scene, and the comparison of its grid and particles with the reference.
template <class Geometry, class T>
class KernelComparison {
 protected:
  static constexpr int kDim = Geometry::kDim;
  using Scene = KernelScene<Geometry, T>;
  using GridView = mpm_kernel::GridView;

  KernelComparison(std::string name, ShapeKind shape, const paths::Specimen& specimen, Places places, Isa isa,
                   const ContinuumSettings& settings, const AxisRules& axis)
      : name_(std::move(name)), scene_(shape, specimen, places, isa, settings, axis) {}

  // With boxes and domains of half their initial size weights change twice as fast. Those of rings have a term over r
  // in addition, of the same size a tenth of a cell from the axis: twice the rounding.
  double tolerance() const {
    return (traits_of(scene_.shape).follows_deformation() ? 2.0 : 1.0) * (Geometry::kHoop ? 2.0 : 1.0) * kTolerance<T>;
  }
  bool average() const { return scene_.settings.average_dilatation; }
  bool affine() const { return scene_.settings.transfer.kind == TransferKind::apic; }

  std::vector<mpm_kernel::SetView<T>> views() {
    std::vector<mpm_kernel::SetView<T>> views;
    for (std::size_t s = 0; s < scene_.sets.size(); ++s) {
      views.push_back(view_of<T>(scene_.sets[s], scene_.laws[s], scene_.kernels));
    }
    return views;
  }
  // pass(grid, block, sets, how many)
  template <class Pass>
  void each_block(const std::vector<mpm_kernel::SetView<T>>& sets, Pass&& pass) {
    const GridView grid = view_of(scene_.grid);
    each_owner("loop", scene_.grid, 1, [&](const mpm_kernel::BlockView& block) {
      pass(grid, block, sets.data(), static_cast<int>(sets.size()));
    });
  }

  void compare_drag(const ReferenceDrag& found, const ReferenceDrag& expected) {
    // The round-off of all particles is relative to the sum of magnitudes, by the inequality of Cauchy and Schwarz.
    double mass = 0.0;
    scene_.reference.each([&](const auto&, const auto& p) { mass += p.mass; });
    const double energy = expected.grid_kinetic + expected.particle_kinetic;
    for (int c = 0; c < kDim; ++c) {
      EXPECT_NEAR(found.drag[c], expected.drag[c], tolerance() * std::sqrt(2.0 * mass * energy)) << name_;
    }
    EXPECT_NEAR(found.grid_kinetic, expected.grid_kinetic, tolerance() * energy) << name_;
    EXPECT_NEAR(found.particle_kinetic, expected.particle_kinetic, tolerance() * energy) << name_;
  }

  // Number of blocks with a domain that leaves their tile. Domains within rounding of that may count or not.
  int compare_outgrown() {
    const double near = 8 * mpm_kernel::kTileEdge * std::numeric_limits<T>::epsilon();
    int outgrown = 0;
    each_block(views(), [&](const GridView& grid, const mpm_kernel::BlockView& block, const auto* of, int count) {
      const bool found = scene_.kernels.outgrown(grid, block, of, count);
      outgrown += found;
      double beyond = -1.0;
      for (std::size_t s = 0; s < scene_.sets.size(); ++s) {
        const auto& begin = scene_.sets[s].begin;
        for (std::uint32_t p = begin[block.owner]; p < begin[block.owner + 1]; ++p) {
          auto particle = scene_.reference.sets[s].particles[p];
          Reference<Geometry>::note_domain(particle);
          const ReferencePlace place = Reference<Geometry>::place_of(scene_.reference.sets[s], particle);
          double d[kDim][kDim];
          reference_domain(scene_.reference.grid(), place, d);
          for (int k = 0; k < kDim; ++k) {
            const double at = scene_.grid.layout.in_cells(k, place.x[k]) - block.corner[k];
            double reach = 0.0;
            for (const auto& vector : d) reach += std::abs(vector[k]) / scene_.grid.layout.cell(k);
            beyond = std::max({beyond, reach - at, at + reach - (mpm_kernel::kTileEdge - 1)});
          }
        }
      }
      if (std::abs(beyond) > near) {
        EXPECT_EQ(found, beyond > 0.0) << name_ << " block " << block.owner;
      }
    });
    return outgrown;
  }

  template <class Value>
  void compare_nodes(const char* what, const NodalField& field, Value&& value, double allowed = -1.0) {
    if (allowed < 0.0) allowed = tolerance();
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
    EXPECT_LE(difference.error, allowed * difference.largest) << name_ << ": " << what;
  }

  // Compares the sum over nodes with that over particles; they are equal, since each particle's weights sum to one.
  template <class Value>
  void expect_total(const char* what, const NodalField& field, Value&& of_particle) {
    for (int c = 0; c < field.components(); ++c) {
      double found = 0.0, expected = 0.0, size = 0.0;
      scene_.each_node([&](int b, int n, const ReferenceNode&) {
        found += field.at(b, c, n);
        size += std::abs(field.at(b, c, n));
      });
      scene_.reference.each([&](const auto&, const auto& p) {
        expected += of_particle(p, c);
        size += std::abs(of_particle(p, c));
      });
      EXPECT_NEAR(found, expected, 0.1 * tolerance() * size) << name_ << ": sum of the " << what;
    }
  }

  void compare_state() {
    // The dashpot's work is the sum of three small differences of isochoric tensors of size 1: in single precision it
    // is below their round-off, one or two epsilon each, times the stiffness.
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
      EXPECT_LE(f.error, tolerance() * f.largest) << of << ", F";
      EXPECT_LE(tau.error, tolerance() * tau.largest) << of << ", stress";
      for (int h = 0; h < static_cast<int>(set.history.size()); ++h) {
        const bool is_work = std::visit([&](const auto& law) { return law.kPlasticWork == h; }, scene_.laws[s]);
        EXPECT_LE(history[h].error, tolerance() * history[h].largest + (is_work ? work : 0.0))
            << of << ", history " << h;
      }
    }
    scene_.read_particles();  // the next pass starts from the kernels' numbers
  }

  void compare_motion(std::vector<PaddedArray<double>> ParticleSet::*places) { compare_motion(places, affine()); }
  void compare_motion(std::vector<PaddedArray<double>> ParticleSet::*places, bool affine) {
    Difference v, displacement, turn;
    for (std::size_t s = 0; s < scene_.sets.size(); ++s) {
      const ParticleSet& set = scene_.sets[s];
      for (int p = 0; p < set.size(); ++p) {
        auto& expected = scene_.reference.sets[s].particles[p];
        for (int k = 0; k < kDim; ++k) {
          v.add(set.v[k][p], expected.v[k]);
          displacement.add((set.*places)[k][p] - expected.x[k], expected.next_x[k] - expected.x[k]);
          expected.v[k] = set.v[k][p];
          expected.next_x[k] = (set.*places)[k][p];
          for (int j = 0; affine && j < kDim; ++j) {
            turn.add(set.affine[k * kDim + j][p], expected.affine[k][j]);
            expected.affine[k][j] = set.affine[k * kDim + j][p];
          }
        }
      }
    }
    EXPECT_GT(displacement.largest, 0.0);
    // A weighted sum over nodes has the round-off of the largest of them: with APIC and hat functions at a point a
    // light node can be far faster than any particle.
    double fastest = 0.0;
    if (this->affine()) {
      for (const ReferenceNode& n : scene_.reference.nodes()) {
        for (const double component : n.velocity) fastest = std::max(fastest, std::abs(component));
      }
    }
    v.largest = std::max(v.largest, fastest);
    turn.largest = std::max(turn.largest, fastest * scene_.smallest_cell());
    displacement.largest = std::max(displacement.largest, fastest * scene_.dt);
    EXPECT_LE(v.error, tolerance() * v.largest) << name_ << ": particle velocity";
    EXPECT_LE(turn.error, tolerance() * turn.largest) << name_ << ": affine field";
    // Round-off of positions up to 3 m.
    const double rounding = 3.0 * std::numeric_limits<double>::epsilon();
    EXPECT_LE(displacement.error, tolerance() * displacement.largest + rounding) << name_ << ": displacement";
  }

  // A block is loose when a particle lies beyond its limit. Particles within rounding of the limit may count or not.
  void check_reach(std::vector<PaddedArray<double>> ParticleSet::*places) {
    const double near = 8 * mpm_kernel::kTileEdge * std::numeric_limits<T>::epsilon();
    for (int owner = 0; owner < scene_.grid.blocks.owners(); ++owner) {
      const auto& block = scene_.grid.blocks.block(scene_.grid.blocks.owner_block(owner));
      double beyond = -1.0;  // distance of the farthest particle beyond the limit [cells]
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
};

}  // namespace mpm::test
