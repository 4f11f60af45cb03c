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

  // visit(offset of a register of nodes in a nodal field's first component, 1 / mass there).
  template <class Visit>
  static void each(const mpm_kernel::GridView& grid, int first, int last, Visit&& visit) {
    const W least(grid.least_mass);
    for (long b = first; b < last; ++b) {
      for (int n = 0; n < kNodes; n += W::kLanes) {
        const W mass = W::load(grid.mass + b * kNodes + n);
        const WideMask<double> carries = mass > least;
        visit(b * Dim * kNodes + n, select(carries, W(1.0) / select(carries, mass, W(1.0)), W(0.0)), carries);
      }
    }
  }
};

template <int Dim>
void nodal_velocity(const mpm_kernel::GridView& grid, int first, int last) {
  using W = Wide<double>;
  NodeRange<Dim>::each(grid, first, last, [&](long at, W inverse_mass, WideMask<double>) {
    for (int c = 0; c < Dim; ++c) {
      const long i = at + c * NodeRange<Dim>::kNodes;
      (W::load(grid.momentum + i) * inverse_mass).store(grid.velocity + i);
    }
  });
}

template <int Dim>
void nodal_update(const mpm_kernel::GridView& grid, int first, int last, double dt, const double* gravity) {
  using W = Wide<double>;
  NodeRange<Dim>::each(grid, first, last, [&](long at, W inverse_mass, WideMask<double> carries) {
    for (int c = 0; c < Dim; ++c) {
      const long i = at + c * NodeRange<Dim>::kNodes;
      const W a = select(carries, W::load(grid.force + i) * inverse_mass + W(gravity[c]), W(0.0));
      (W::load(grid.momentum + i) * inverse_mass + a * W(dt)).store(grid.velocity + i);
      a.store(grid.force + i);
    }
  });
}

}  // namespace mpm
