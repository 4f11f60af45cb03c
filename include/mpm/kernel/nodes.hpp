// The passes over nodes between those over particles: velocity from momentum, and the update of momentum by force and
// gravity. GIMP notes (2.8), (2.14). Nodes that no particle touches get zero.
#pragma once

#include "mpm/kernel/kernels.hpp"
#include "mpm/kernel/wide.hpp"

namespace mpm {

template <int Dim>
struct NodeRange {
  static constexpr int kNodes = Dim == 3 ? 64 : Dim == 2 ? 16 : 4;
  using W = Wide<double>;

  // visit(offset of a register of nodes in a nodal field's first component, 1 / mass there, whether there is any, how
  // many nodes of the register to write). A block of a line is no whole register: its nodes, of one component, follow
  // those of the block before.
  template <class Visit>
  static void each(const mpm_kernel::GridView& grid, int first, int last, Visit&& visit) {
    const W least(grid.least_mass);
    const long step = Dim == 1 ? static_cast<long>(last - first) * kNodes : kNodes;
    for (long b = first; b < last; b += step / kNodes) {
      for (long n = 0; n < step; n += W::kLanes) {
        const int count = static_cast<int>(step - n);
        const W mass = load(grid.mass + b * kNodes + n, count);
        const WideMask<double> carries = mass > least;
        visit(b * Dim * kNodes + n, select(carries, W(1.0) / select(carries, mass, W(1.0)), W(0.0)), carries, count);
      }
    }
  }
  static W load(const double* from, int count) {
    if constexpr (Dim == 1) return W::load_first(from, count);
    return W::load(from);
  }
  static void store(W value, double* to, int count) {
    if constexpr (Dim == 1) {
      value.store_first(to, count);
    } else {
      value.store(to);
    }
  }
};

template <int Dim>
void nodal_velocity(const mpm_kernel::GridView& grid, int first, int last) {
  using W = Wide<double>;
  using Range = NodeRange<Dim>;
  Range::each(grid, first, last, [&](long at, W inverse_mass, WideMask<double>, int count) {
    for (int c = 0; c < Dim; ++c) {
      const long i = at + c * Range::kNodes;
      Range::store(Range::load(grid.momentum + i, count) * inverse_mass, grid.velocity + i, count);
    }
  });
}

template <int Dim>
void nodal_update(const mpm_kernel::GridView& grid, int first, int last, double dt, const double* gravity) {
  using W = Wide<double>;
  using Range = NodeRange<Dim>;
  Range::each(grid, first, last, [&](long at, W inverse_mass, WideMask<double> carries, int count) {
    for (int c = 0; c < Dim; ++c) {
      const long i = at + c * Range::kNodes;
      const W a = select(carries, Range::load(grid.force + i, count) * inverse_mass + W(gravity[c]), W(0.0));
      Range::store(Range::load(grid.momentum + i, count) * inverse_mass + a * W(dt), grid.velocity + i, count);
      Range::store(a, grid.force + i, count);
    }
  });
}

}  // namespace mpm
