// Weights of one particle at the nodes around its nearest one, made of the classes in mpm/shape; and the two ways to go
// through them: all nodes of a particle, all particles of a node.
//
// A shape function has kNodes along an axis, 3 or 5, and so reaches kNodes / 2 to each side of the nearest node: less
// than a block, so that the blocks around one hold all. A node's sums are gathered by its own index: it visits the
// particles that are nearest to it and to the nodes in reach, cell by cell, in their sorted order. So no two indices
// write one place, and the order of a sum is fixed. A particle's weights are made kNodes^dim times in a pass; of five
// nodes an axis one has no weight, which is visited all the same. The alternative is to be measured on a card beside
// this one: blocks of one colour of 2^dim at a time, sums in shared memory, particles of a cell in their order. For
// code of one lane alone.
#pragma once

#include "mpm/kernel/kernels.hpp"
#include "mpm/kernel/wide.hpp"
#include "mpm_gpu/views.hpp"

namespace mpm_gpu {

template <int Dim>
struct Local {
  int at[3];  ///< in the block, 0 to 3; of a neighbour -2 to 5
};
template <int Dim>
Local<Dim> local_of(long node) {
  Local<Dim> local{};
  long rest = node % nodes_of_block(Dim);
  for (int k = Dim - 1; k >= 0; --k, rest /= kEdge) local.at[k] = static_cast<int>(rest % kEdge);
  return local;
}
/// Number in the table of a node that lies in the block or in one around it; -1 if it has none.
template <int Dim>
long number_of(const NodeView& nodes, long block, const Local<Dim>& local) {
  int part = 0, within = 0;
  for (int k = 0; k < Dim; ++k) {
    part = part * 3 + (local.at[k] < 0 ? 0 : local.at[k] < kEdge ? 1 : 2);
    within = within * kEdge + ((local.at[k] + kEdge) & (kEdge - 1));
  }
  const std::int32_t there = nodes.neighbours[block * neighbours_of(Dim) + part];
  return there < 0 ? -1 : static_cast<long>(there) * nodes_of_block(Dim) + within;
}
/// Numbers of a block's first node along the axes of the grid.
template <int Dim>
void corner_of(const GridView& grid, std::uint64_t key, int (&corner)[3]) {
  for (int k = Dim - 1; k >= 0; --k) {
    const auto along = static_cast<std::uint64_t>(grid.blocks_along[k]);
    corner[k] = static_cast<int>(key % along) * kEdge - kBeside;
    key /= along;
  }
}

using mpm_kernel::Beside;

/// The shape function along each axis around the nearest node, and what stands beside it: its gradient or, for APIC,
/// its first moments, also over the second.
template <class T, int Dim, template <class> class ShapeClass, Beside What = Beside::gradient>
class Stencil {
  using W = mpm::Wide<T>;

 public:
  static constexpr int kNodes = ShapeClass<W>::kNodes;
  static_assert(kNodes / 2 <= kEdge);

  Stencil(const GridView& grid, const SetView& set, const ParticleView<T>& particles, long p, const int* nearest) {
    for (int k = 0; k < Dim; ++k) {
      const W offset(W::B::place(particles.x[k] + p, 1, grid.origin[k], grid.inverse_cell[k], nearest[k]));
      ShapeClass<W> along = shape(grid, set, particles, k, p, offset, nearest[k]);
      if constexpr (What != Beside::gradient) put_moments(along, offset, 1.0 / grid.inverse_cell[k]);
      for (int n = 0; n < kNodes; ++n) {
        s_[k][n] = along.s[n];
        g_[k][n] = along.g[n];
      }
    }
  }
  /// Value at the node n[k] - kNodes / 2 from the nearest.
  W value(const int* n) const {
    W value = s_[0][n[0]];
    for (int k = 1; k < Dim; ++k) value *= s_[k][n[k]];
    return value;
  }
  /// Gradient along axis `of` there [1/m], or what stands in its place.
  W beside(const int* n, int of) const {
    W value = of == 0 ? g_[0][n[0]] : s_[0][n[0]];
    for (int k = 1; k < Dim; ++k) value *= of == k ? g_[k][n[k]] : s_[k][n[k]];
    return value;
  }

 private:
  static ShapeClass<W> shape(const GridView& grid, const SetView& set, const ParticleView<T>& particles, int k, long p,
                             W offset, int nearest) {
    const typename ShapeClass<W>::Axis axis(set.half[k], grid.inverse_cell[k]);
    if constexpr (ShapeClass<W>::kStretches) {
      return ShapeClass<W>(offset, ShapeClass<W>::half(W::load(particles.domain[k] + p), axis), axis);
    } else {
      ShapeClass<W> along(offset, axis);
      if constexpr (ShapeClass<W>::kFoldsAtWalls) {
        along.fold(W(nearest - grid.low_wall[k]), W(grid.high_wall[k] - nearest));
      }
      return along;
    }
  }

  // Moments are those of kernel/weights.hpp, of products that reproduce linear fields: S (x_i - x_p), over D in what is
  // spread. A spline folded at a wall has no D on the wall, where moments are zero, and a negative one beyond it.
  static void put_moments(ShapeClass<W>& along, W offset, double cell) {
    constexpr double kLeastMoment = 1e-10;  // [cells^2]
    W second(0.0);
    for (int n = 0; n < kNodes; ++n) {
      const W arm = (W(n - kNodes / 2) - offset) * W(cell);
      along.g[n] = along.s[n] * arm;
      second += along.g[n] * arm;
    }
    if (What != Beside::affine) return;
    const W least(kLeastMoment * cell * cell);
    second = select(second < W(0.0), min(second, -least), max(second, least));
    for (int n = 0; n < kNodes; ++n) along.g[n] /= second;
  }

  W s_[Dim][kNodes], g_[Dim][kNodes];
};

/// Mass of a particle [kg].
template <class T>
mpm::Wide<T> mass_of(const ParticleView<T>& particles, const SetView& set, long p) {
  return particles.mass == nullptr ? mpm::Wide<T>(set.mass) : mpm::Wide<T>::load(particles.mass + p);
}

/// visit(n) for the places n[k] of 0 to Nodes - 1, the last axis fastest.
template <int Dim, int Nodes, class Visit>
void each_beside(Visit&& visit) {
  int n[3] = {};
  for (n[0] = 0; n[0] < Nodes; ++n[0]) {
    for (n[1] = 0; n[1] < Nodes; ++n[1]) {
      if constexpr (Dim == 2) {
        visit(n);
      } else {
        for (n[2] = 0; n[2] < Nodes; ++n[2]) visit(n);
      }
    }
  }
}

/// visit(number of the node, n) for all nodes of a particle: the blocks around that of its nearest node are there.
template <int Dim, int Nodes, class T, class Visit>
void each_node_of(const StepView<T>& step, long p, Visit&& visit) {
  const long nearest = step.particles.node[p], block = nearest / nodes_of_block(Dim);
  const Local<Dim> local = local_of<Dim>(nearest);
  each_beside<Dim, Nodes>([&](const int* n) {
    Local<Dim> there = local;
    for (int k = 0; k < Dim; ++k) there.at[k] += n[k] - Nodes / 2;
    visit(number_of<Dim>(step.nodes, block, there), n);
  });
}
/// Stencil of a particle.
template <class T, int Dim, template <class> class ShapeClass, Beside What = Beside::gradient>
Stencil<T, Dim, ShapeClass, What> stencil_of(const StepView<T>& step, const SetView& set, long p) {
  const long node = step.particles.node[p];
  int nearest[3];
  corner_of<Dim>(step.grid, step.nodes.key[node / nodes_of_block(Dim)], nearest);
  const Local<Dim> local = local_of<Dim>(node);
  for (int k = 0; k < Dim; ++k) nearest[k] += local.at[k];
  return {step.grid, set, step.particles, p, nearest};
}

/// visit(set, particle, stencil, n) for all particles that give to a node, in the order of sets, cells and particles; n
/// is the node's place in the stencil. `number`: of the node along the axes.
template <class T, int Dim, template <class> class ShapeClass, Beside What = Beside::gradient, class Visit>
void each_particle_of(const StepView<T>& step, long node, const int* number, Visit&& visit) {
  using Weights = Stencil<T, Dim, ShapeClass, What>;
  constexpr int kNodes = Weights::kNodes, kReach = kNodes / 2;
  const long block = node / nodes_of_block(Dim);
  if (step.nodes.key[block] == kNoBlock) return;
  const Local<Dim> local = local_of<Dim>(node);
  for (int s = 0; s < step.set_count; ++s) {
    const SetView set = step.sets_there[s];
    each_beside<Dim, kNodes>([&](const int* cell) {
      Local<Dim> there = local;
      int nearest[3] = {}, n[3] = {};
      for (int k = 0; k < Dim; ++k) {
        there.at[k] += cell[k] - kReach;
        nearest[k] = around(step.grid, k, number[k] + cell[k] - kReach);
        n[k] = kNodes - 1 - cell[k];
      }
      const long at = number_of<Dim>(step.nodes, block, there);
      if (at < 0) return;
      const long row = s * step.nodes.nodes + at;
      for (std::uint32_t p = step.nodes.begin[row]; p < step.nodes.end[row]; ++p) {
        visit(set, p, Weights(step.grid, set, step.particles, p, nearest), n);
      }
    });
  }
}
/// Numbers of a node along the axes.
template <class T, int Dim>
void number_along(const StepView<T>& step, long node, int (&number)[3]) {
  corner_of<Dim>(step.grid, step.nodes.key[node / nodes_of_block(Dim)], number);
  const Local<Dim> local = local_of<Dim>(node);
  for (int k = 0; k < Dim; ++k) number[k] += local.at[k];
}

}  // namespace mpm_gpu
