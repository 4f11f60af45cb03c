// Weights of one particle at the 3^dim nodes around its nearest one, made of the classes in mpm/shape; and the two ways
// to go through them: all nodes of a particle, all particles of a node.
//
// A node's sums are gathered by its own index: it visits the particles that are nearest to it and to the nodes around
// it, cell by cell, in their sorted order. So no two indices write one place, and the order of a sum is fixed. A
// particle's weights are made 3^dim times in a pass. The alternative is to be measured on a card beside this one:
// blocks of one colour of 2^dim at a time, sums in shared memory, particles of a cell in their order. For code of one
// lane alone.
#pragma once

#include "mpm/kernel/wide.hpp"
#include "mpm_gpu/views.hpp"

namespace mpm_gpu {

template <int Dim>
struct Local {
  int at[3];  ///< in the block, 0 to 3; of a neighbour -1 to 4
};
template <int Dim>
Local<Dim> local_of(long node) {
  Local<Dim> local{};
  long rest = node % nodes_of_block(Dim);
  for (int k = Dim - 1; k >= 0; --k, rest /= kEdge) local.at[k] = static_cast<int>(rest % kEdge);
  return local;
}
/// Number in the table of a node that is one to each side of the block at most; -1 if it has none.
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

/// The shape function along each axis around the nearest node.
template <class T, int Dim, template <class> class ShapeClass>
class Stencil {
  using W = mpm::Wide<T>;

 public:
  Stencil(const GridView& grid, const SetView& set, const double* const* x, long p, const int* nearest) {
    for (int k = 0; k < Dim; ++k) {
      const typename ShapeClass<W>::Axis axis(set.half[k], grid.inverse_cell[k]);
      const W offset(W::B::place(x[k] + p, 1, grid.origin[k], grid.inverse_cell[k], nearest[k]));
      ShapeClass<W> along(offset, axis);
      if constexpr (ShapeClass<W>::kFoldsAtWalls) {
        along.fold(W(nearest[k] - grid.low_wall[k]), W(grid.high_wall[k] - nearest[k]));
      }
      for (int n = 0; n < 3; ++n) {
        s_[k][n] = along.s[n];
        g_[k][n] = along.g[n];
      }
    }
  }
  /// Value at the node n[k] - 1 from the nearest.
  W value(const int* n) const {
    W value = s_[0][n[0]];
    for (int k = 1; k < Dim; ++k) value *= s_[k][n[k]];
    return value;
  }
  /// Gradient along axis `of` there [1/m].
  W gradient(const int* n, int of) const {
    W value = of == 0 ? g_[0][n[0]] : s_[0][n[0]];
    for (int k = 1; k < Dim; ++k) value *= of == k ? g_[k][n[k]] : s_[k][n[k]];
    return value;
  }

 private:
  W s_[Dim][3], g_[Dim][3];
};

/// visit(n) for the 3^dim places n[k] of 0, 1, 2, the last axis fastest.
template <int Dim, class Visit>
void each_beside(Visit&& visit) {
  int n[3] = {};
  for (n[0] = 0; n[0] < 3; ++n[0]) {
    for (n[1] = 0; n[1] < 3; ++n[1]) {
      if constexpr (Dim == 2) {
        visit(n);
      } else {
        for (n[2] = 0; n[2] < 3; ++n[2]) visit(n);
      }
    }
  }
}

/// visit(number of the node, n) for all nodes of a particle: the blocks around that of its nearest node are there.
template <class T, int Dim, class Visit>
void each_node_of(const StepView<T>& step, long p, Visit&& visit) {
  const long nearest = step.particles.node[p], block = nearest / nodes_of_block(Dim);
  const Local<Dim> local = local_of<Dim>(nearest);
  each_beside<Dim>([&](const int* n) {
    Local<Dim> there = local;
    for (int k = 0; k < Dim; ++k) there.at[k] += n[k] - 1;
    visit(number_of<Dim>(step.nodes, block, there), n);
  });
}
/// Stencil of a particle.
template <class T, int Dim, template <class> class ShapeClass>
Stencil<T, Dim, ShapeClass> stencil_of(const StepView<T>& step, const SetView& set, long p) {
  const long node = step.particles.node[p];
  int nearest[3];
  corner_of<Dim>(step.grid, step.nodes.key[node / nodes_of_block(Dim)], nearest);
  const Local<Dim> local = local_of<Dim>(node);
  for (int k = 0; k < Dim; ++k) nearest[k] += local.at[k];
  return {step.grid, set, step.particles.x, p, nearest};
}

/// visit(set, particle, stencil, n) for all particles that give to a node, in the order of sets, cells and particles; n
/// is the node's place in the stencil. `number`: of the node along the axes.
template <class T, int Dim, template <class> class ShapeClass, class Visit>
void each_particle_of(const StepView<T>& step, long node, const int* number, Visit&& visit) {
  const long block = node / nodes_of_block(Dim);
  const Local<Dim> local = local_of<Dim>(node);
  for (int s = 0; s < step.set_count; ++s) {
    const SetView set = step.sets_there[s];
    each_beside<Dim>([&](const int* cell) {
      Local<Dim> there = local;
      int nearest[3] = {}, n[3] = {};
      for (int k = 0; k < Dim; ++k) {
        there.at[k] += cell[k] - 1;
        nearest[k] = number[k] + cell[k] - 1;
        n[k] = 2 - cell[k];
      }
      const long at = number_of<Dim>(step.nodes, block, there);
      if (at < 0) return;
      const long row = s * step.nodes.nodes + at;
      for (std::uint32_t p = step.nodes.begin[row]; p < step.nodes.end[row]; ++p) {
        visit(set, p, Stencil<T, Dim, ShapeClass>(step.grid, set, step.particles.x, p, nearest), n);
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
