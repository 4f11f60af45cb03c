// Eight numbers in a register, and the nodes of the cells that sweeps of the implicit step solve at once: four numbers
// of each node, turned into eight of each component. Compiler vectors, as wide.hpp has them; of eight numbers whatever
// the instruction set, since cells come in groups of eight. Compiled once an instruction set, under another name of the
// namespace (kernels.hpp).
#pragma once

#include <cmath>

#include "mpm/kernel/soil_cells.hpp"

namespace mpm {

template <class T>
struct Lanes {
  typedef T Eight __attribute__((vector_size(8 * sizeof(T)), aligned(sizeof(T)), may_alias));
  typedef T Four __attribute__((vector_size(4 * sizeof(T)), aligned(sizeof(T)), may_alias));
};
template <class T>
using Eight = typename Lanes<T>::Eight;
template <class T>
using Four = typename Lanes<T>::Four;

template <class T>
Eight<T> load(const T* from) {
  return *reinterpret_cast<const Eight<T>*>(from);
}
template <class T>
void store(T* to, Eight<T> v) {
  *reinterpret_cast<Eight<T>*>(to) = v;
}

/// Velocities and inverse masses of eight nodes, a node a lane.
template <class T>
struct Corners {
  Eight<T> x, y, z, m;
};

template <class T>
inline __attribute__((always_inline)) Corners<T> load(const mpm_kernel::SoilNode<T>* nodes, const int* n) {
  const auto pair = [&](int a, int b) {
    const Four<T> low = *reinterpret_cast<const Four<T>*>(nodes[n[a]].v);
    const Four<T> high = *reinterpret_cast<const Four<T>*>(nodes[n[b]].v);
    return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
  };
  const Eight<T> a = pair(0, 4), b = pair(1, 5), c = pair(2, 6), d = pair(3, 7);
  const Eight<T> ab = __builtin_shufflevector(a, b, 0, 8, 1, 9, 4, 12, 5, 13);
  const Eight<T> cd = __builtin_shufflevector(c, d, 0, 8, 1, 9, 4, 12, 5, 13);
  const Eight<T> up_ab = __builtin_shufflevector(a, b, 2, 10, 3, 11, 6, 14, 7, 15);
  const Eight<T> up_cd = __builtin_shufflevector(c, d, 2, 10, 3, 11, 6, 14, 7, 15);
  return {__builtin_shufflevector(ab, cd, 0, 1, 8, 9, 4, 5, 12, 13),
          __builtin_shufflevector(ab, cd, 2, 3, 10, 11, 6, 7, 14, 15),
          __builtin_shufflevector(up_ab, up_cd, 0, 1, 8, 9, 4, 5, 12, 13),
          __builtin_shufflevector(up_ab, up_cd, 2, 3, 10, 11, 6, 7, 14, 15)};
}

template <class T>
inline __attribute__((always_inline)) void store(mpm_kernel::SoilNode<T>* nodes, const int* n, const Corners<T>& c) {
  const Eight<T> xy = __builtin_shufflevector(c.x, c.y, 0, 8, 1, 9, 4, 12, 5, 13);
  const Eight<T> up_xy = __builtin_shufflevector(c.x, c.y, 2, 10, 3, 11, 6, 14, 7, 15);
  const Eight<T> zm = __builtin_shufflevector(c.z, c.m, 0, 8, 1, 9, 4, 12, 5, 13);
  const Eight<T> up_zm = __builtin_shufflevector(c.z, c.m, 2, 10, 3, 11, 6, 14, 7, 15);
  const Eight<T> q[4] = {__builtin_shufflevector(xy, zm, 0, 1, 8, 9, 4, 5, 12, 13),
                         __builtin_shufflevector(xy, zm, 2, 3, 10, 11, 6, 7, 14, 15),
                         __builtin_shufflevector(up_xy, up_zm, 0, 1, 8, 9, 4, 5, 12, 13),
                         __builtin_shufflevector(up_xy, up_zm, 2, 3, 10, 11, 6, 7, 14, 15)};
  for (int k = 0; k < 4; ++k) {
    *reinterpret_cast<Four<T>*>(nodes[n[k]].v) = __builtin_shufflevector(q[k], q[k], 0, 1, 2, 3);
    *reinterpret_cast<Four<T>*>(nodes[n[k + 4]].v) = __builtin_shufflevector(q[k], q[k], 4, 5, 6, 7);
  }
}

template <class T>
using Truth = decltype(Eight<T>{} < Eight<T>{});

template <class T>
Eight<T> all(double value) {
  return Eight<T>{} + static_cast<T>(value);
}
template <class T>
Eight<T> largest(Eight<T> a, Eight<T> b) {
  return a > b ? a : b;
}
template <class T>
Eight<T> least_of(Eight<T> a, Eight<T> b) {
  return a < b ? a : b;
}
template <class T>
Eight<T> root(Eight<T> a) {
  alignas(64) T v[8];
  store(v, a);
  for (int l = 0; l < 8; ++l) v[l] = std::sqrt(v[l]);
  return load(v);
}

/// The nodes of the cells of a group, a cell a lane: eight in space, else the four that a cell has.
template <class T, mpm_kernel::CellKind Kind>
struct GroupNodes {
  static constexpr int kCount =
      Kind == mpm_kernel::CellKind::space ? mpm_kernel::kCellNodes : mpm_kernel::kCellNodes / 2;
  Corners<T> of[kCount];

  GroupNodes(const mpm_kernel::SoilGroup<T>& group, const mpm_kernel::SoilNode<T>* nodes) {
    for (int e = 0; e < kCount; ++e) of[e] = load(nodes, group.node[e]);
  }
};

}  // namespace mpm
