// Kernels whose nodes are scattered, as CPDI's are: a particle is a box, and reaches every node that the linear shape
// functions of its eight corners reach. They share nothing with the passes of kernel/passes.hpp but the table and the
// laws' border; here to show that the schedule does not need more. Weak: the box does not deform, no registers, slow.
// Source: Sadeghirad, Brannon & Burghardt (2011) eq. (20), (21), for a box with edges along the axes.
#pragma once

#include <algorithm>
#include <cmath>

#include "mpm/kernel/kernels.hpp"
#include "mpm/material/increment.hpp"
#include "mpm/material/neo_hookean.hpp"
#include "mpm/math/dimension.hpp"
#include "mpm/math/exponential.hpp"

namespace mpm::test {

/// In three dimensions, in double precision, of neo-Hookean material.
class CornerPasses {
  using Grid = mpm_kernel::GridView;
  using Block = mpm_kernel::BlockView;
  using Set = mpm_kernel::SetView<double>;

 public:
  /// `nodes`: whose passes over nodes are used.
  static mpm_kernel::KernelTable<double> table(const mpm_kernel::KernelTable<double>& nodes) {
    return {1,
            false,
            &scatter_momentum,
            &strain,
            &move,
            &scatter_load,
            nodes.survey,
            nodes.nodal_velocity,
            nodes.nodal_update};
  }

 private:
  static void scatter_momentum(const Grid& grid, const Block& block, const Set* sets, int count) {
    each(grid, block, sets, count, [&](const Set& set, int p, long mass_at, long at, double s, const double*) {
      grid.mass[mass_at] += set.mass * s;
      for (int c = 0; c < 3; ++c) grid.momentum[at + 64 * c] += set.mass * s * set.v[c][p];
    });
  }

  static mpm_kernel::Failure strain(const Grid& grid, const Block& block, const Set* sets, int count,
                                    const mpm_kernel::StrainSettings& settings) {
    mpm_kernel::Failure failure{-1, 0};
    for (int s = 0; s < count; ++s) {
      const Set& set = sets[s];
      for (int p = static_cast<int>(set.group[set.group_begin[block.owner]]);
           p < static_cast<int>(set.group[set.group_begin[block.owner + 1]]); ++p) {
        double l[3][3] = {};
        each_node(grid, block, set, p, [&](long, long at, double, const double* g) {
          for (int c = 0; c < 3; ++c) {
            for (int k = 0; k < 3; ++k) l[c][k] += settings.dt * grid.velocity[at + 64 * c] * g[k];
          }
        });
        const auto du = Solid::gradient(l), df = exponential(du, settings.terms);
        const auto old = Solid::load_matrix(set.f, p), now = product(df, old);
        auto tau = Solid::load_symmetric(set.tau, p);
        const double j = determinant(now);
        static_cast<const NeoHookean*>(set.law)->update(
            Increment<double, Matrix3<double>>{du, df, now, determinant(old), j, settings.dt}, tau,
            static_cast<double*>(nullptr));
        Solid::store_matrix(now, set.f, p);
        Solid::store_symmetric(tau, set.tau, p);
        if (!(j > 0.0) && failure.set < 0) failure = {s, p};
      }
    }
    if (!settings.and_force) return failure;
    each(grid, block, sets, count, [&](const Set& set, int p, long, long at, double, const double* g) {
      for (int k = 0; k < 3; ++k) {
        double column[3];
        Solid::column(Solid::load_symmetric(set.tau, p), k, column);
        for (int c = 0; c < 3; ++c) grid.force[at + 64 * c] -= set.mass * column[c] * g[k];
      }
    });
    return failure;
  }

  static mpm_kernel::Moved move(const Grid& grid, const Block& block, const Set* sets, int count,
                                const mpm_kernel::MoveSettings& settings) {
    mpm_kernel::Moved moved{false, false, 0, 0};
    for (int s = 0; s < count; ++s) {
      const Set& set = sets[s];
      for (int p = static_cast<int>(set.group[set.group_begin[block.owner]]);
           p < static_cast<int>(set.group[set.group_begin[block.owner + 1]]); ++p) {
        double after[3] = {}, a[3] = {};
        each_node(grid, block, set, p, [&](long, long at, double weight, const double*) {
          for (int c = 0; c < 3; ++c) {
            after[c] += weight * grid.velocity[at + 64 * c];
            a[c] += weight * grid.force[at + 64 * c];
          }
        });
        for (int c = 0; c < 3; ++c) set.v[c][p] += settings.dt * a[c];
        if (settings.regather) {
          each_node(grid, block, set, p, [&](long, long at, double weight, const double*) {
            for (int c = 0; c < 3; ++c) grid.momentum[at + 64 * c] += set.mass * weight * set.v[c][p];
          });
        }
        for (int c = 0; c < 3; ++c) {
          set.next_x[c][p] = set.x[c][p] + settings.dt * (after[c] - 0.5 * settings.dt * a[c]);
          const double place = (set.next_x[c][p] - grid.origin[c]) * grid.inverse_cell[c] - block.corner[c];
          moved.loose = moved.loose || !(place > 1.5 && place < 5.5);
          moved.gone = moved.gone || !(place > 0.5 && place < mpm_kernel::kTileEdge - 1.5);
        }
        ++moved.groups;
        ++moved.parts;
      }
    }
    return moved;
  }

  static void scatter_load(const Grid& grid, const Block& block, const Set* sets, int count, double* field) {
    each(grid, block, sets, count, [&](const Set& set, int p, long, long at, double s, const double*) {
      for (int c = 0; c < 3 && set.load[c] != nullptr; ++c) field[at + 64 * c] += set.mass * s * set.load[c][p];
    });
  }

  // visit(set, particle, place of a node in a scalar field, in a vector field, S, grad S [1/m]), a corner at a time.
  template <class Visit>
  static void each(const Grid& grid, const Block& block, const Set* sets, int count, Visit&& visit) {
    for (int s = 0; s < count; ++s) {
      const Set& set = sets[s];
      for (std::uint32_t p = set.group[set.group_begin[block.owner]]; p < set.group[set.group_begin[block.owner + 1]];
           ++p) {
        each_node(grid, block, set, static_cast<int>(p), [&](long mass_at, long at, double weight, const double* g) {
          visit(set, static_cast<int>(p), mass_at, at, weight, g);
        });
      }
    }
  }

  // A node comes as often as corners reach it.
  template <class Visit>
  static void each_node(const Grid& grid, const Block& block, const Set& set, int p, Visit&& visit) {
    for (int corner = 0; corner < 8; ++corner) {
      int cell[3];
      double hat[3][2], sign[3];
      for (int k = 0; k < 3; ++k) {
        sign[k] = (corner >> k & 1) == 0 ? -1.0 : 1.0;
        const double place =
            (set.x[k][p] - grid.origin[k]) * grid.inverse_cell[k] - block.corner[k] + sign[k] * set.half[k];
        cell[k] = static_cast<int>(std::floor(place));
        hat[k][1] = place - cell[k];
        hat[k][0] = 1.0 - hat[k][1];
      }
      for (int n = 0; n < 8; ++n) {
        double value = 0.125, g[3];
        int part = 0, node = 0;
        for (int k = 0; k < 3; ++k) {
          value *= hat[k][n >> k & 1];
          const int at = cell[k] + (n >> k & 1) + 2;  // tile nodes 0 and 1 are the last of the block before
          part = part * 3 + at / 4;
          node = node * 4 + at % 4;
        }
        for (int k = 0; k < 3; ++k) g[k] = value * sign[k] / set.half[k] * grid.inverse_cell[k];
        const long b = block.neighbours[part];
        visit(b * 64 + node, b * 192 + node, value, g);
      }
    }
  }
};

}  // namespace mpm::test
