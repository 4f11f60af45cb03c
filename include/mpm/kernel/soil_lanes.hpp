// Registers of sweeps of the implicit step, a cell a lane, and the nodes of the cells that are solved at once: four
// numbers of each node, turned into those of each component. Eight lanes, compiler vectors as wide.hpp has them,
// whatever the instruction set, since cells come in groups of eight. Compiled once an instruction set, under another
// name of the namespace (kernels.hpp). With MPM_ONE_LANE a register is a plain number, as for a device.
#pragma once

#include <cmath>

#include "mpm/kernel/soil_cells.hpp"

namespace mpm::soil {

using mpm_kernel::CellKind;
using mpm_kernel::kCellNodes;
using mpm_kernel::kOverRoot2;
using mpm_kernel::kOverRoot3;
using mpm_kernel::kOverRoot6;
using mpm_kernel::SoilNode;

template <class T>
struct Lanes {
  typedef T Eight __attribute__((vector_size(8 * sizeof(T)), aligned(sizeof(T)), may_alias));
  typedef T Four __attribute__((vector_size(4 * sizeof(T)), aligned(sizeof(T)), may_alias));
};
template <class T>
using Four = typename Lanes<T>::Four;

inline double root_of(double a) { return __builtin_sqrt(a); }
inline float root_of(float a) { return __builtin_sqrtf(a); }

#ifdef MPM_ONE_LANE
constexpr int kSoilLanes = 1;
template <class T>
using Register = T;

template <class T>
T load(const T* from) {
  return *from;
}
template <class T>
void store(T* to, Register<T> v) {
  *to = v;
}
template <class T>
Register<T> square_root(Register<T> a) {
  return root_of(a);
}
#else
constexpr int kSoilLanes = mpm_kernel::kGroupCells;
template <class T>
using Register = typename Lanes<T>::Eight;

template <class T>
Register<T> load(const T* from) {
  return *reinterpret_cast<const Register<T>*>(from);
}
template <class T>
void store(T* to, Register<T> v) {
  *reinterpret_cast<Register<T>*>(to) = v;
}
template <class T>
Register<T> square_root(Register<T> a) {
  alignas(64) T v[8];
  store(v, a);
  for (int l = 0; l < 8; ++l) v[l] = std::sqrt(v[l]);
  return load(v);
}
#endif

/// Velocities and inverse masses of nodes, a node a lane.
template <class T>
struct Corners {
  Register<T> x, y, z, m;
};

#ifdef MPM_ONE_LANE
template <class T>
Corners<T> load(const SoilNode<T>* nodes, const int* n) {
  const SoilNode<T>& node = nodes[*n];
  return {node.v[0], node.v[1], node.v[2], node.inverse_mass};
}
// A node without mass, which may be that of several cells, has no velocity.
template <class T>
void store(SoilNode<T>* nodes, const int* n, const Corners<T>& c) {
  if (!(c.m > T(0))) return;
  T* v = nodes[*n].v;
  v[0] = c.x;
  v[1] = c.y;
  v[2] = c.z;
}
#else
template <class T>
inline __attribute__((always_inline)) Corners<T> load(const SoilNode<T>* nodes, const int* n) {
  const auto pair = [&](int a, int b) {
    const Four<T> low = *reinterpret_cast<const Four<T>*>(nodes[n[a]].v);
    const Four<T> high = *reinterpret_cast<const Four<T>*>(nodes[n[b]].v);
    return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
  };
  const Register<T> a = pair(0, 4), b = pair(1, 5), c = pair(2, 6), d = pair(3, 7);
  const Register<T> ab = __builtin_shufflevector(a, b, 0, 8, 1, 9, 4, 12, 5, 13);
  const Register<T> cd = __builtin_shufflevector(c, d, 0, 8, 1, 9, 4, 12, 5, 13);
  const Register<T> up_ab = __builtin_shufflevector(a, b, 2, 10, 3, 11, 6, 14, 7, 15);
  const Register<T> up_cd = __builtin_shufflevector(c, d, 2, 10, 3, 11, 6, 14, 7, 15);
  return {__builtin_shufflevector(ab, cd, 0, 1, 8, 9, 4, 5, 12, 13),
          __builtin_shufflevector(ab, cd, 2, 3, 10, 11, 6, 7, 14, 15),
          __builtin_shufflevector(up_ab, up_cd, 0, 1, 8, 9, 4, 5, 12, 13),
          __builtin_shufflevector(up_ab, up_cd, 2, 3, 10, 11, 6, 7, 14, 15)};
}

template <class T>
inline __attribute__((always_inline)) void store(SoilNode<T>* nodes, const int* n, const Corners<T>& c) {
  const Register<T> xy = __builtin_shufflevector(c.x, c.y, 0, 8, 1, 9, 4, 12, 5, 13);
  const Register<T> up_xy = __builtin_shufflevector(c.x, c.y, 2, 10, 3, 11, 6, 14, 7, 15);
  const Register<T> zm = __builtin_shufflevector(c.z, c.m, 0, 8, 1, 9, 4, 12, 5, 13);
  const Register<T> up_zm = __builtin_shufflevector(c.z, c.m, 2, 10, 3, 11, 6, 14, 7, 15);
  const Register<T> q[4] = {__builtin_shufflevector(xy, zm, 0, 1, 8, 9, 4, 5, 12, 13),
                            __builtin_shufflevector(xy, zm, 2, 3, 10, 11, 6, 7, 14, 15),
                            __builtin_shufflevector(up_xy, up_zm, 0, 1, 8, 9, 4, 5, 12, 13),
                            __builtin_shufflevector(up_xy, up_zm, 2, 3, 10, 11, 6, 7, 14, 15)};
  for (int k = 0; k < 4; ++k) {
    *reinterpret_cast<Four<T>*>(nodes[n[k]].v) = __builtin_shufflevector(q[k], q[k], 0, 1, 2, 3);
    *reinterpret_cast<Four<T>*>(nodes[n[k + 4]].v) = __builtin_shufflevector(q[k], q[k], 4, 5, 6, 7);
  }
}
#endif

template <class T>
using Truth = decltype(Register<T>{} < Register<T>{});

template <class T>
Register<T> all(double value) {
  return Register<T>{} + static_cast<T>(value);
}
template <class T>
Register<T> largest(Register<T> a, Register<T> b) {
  return a > b ? a : b;
}
template <class T>
Register<T> least_of(Register<T> a, Register<T> b) {
  return a < b ? a : b;
}

/// A group of as many cells as a register has lanes, and what goes with it.
template <class T>
using Group = mpm_kernel::SoilGroup<T, kSoilLanes>;
template <class T>
using Places = mpm_kernel::SoilPlaces<T, kSoilLanes>;
template <class T>
using Mask = mpm_kernel::SoilMask<T, kSoilLanes>;
template <class T>
using Flow = mpm_kernel::SoilFlow<T, kSoilLanes>;

/// Inverse masses of the nodes of a group's corner.
template <class T>
inline __attribute__((always_inline)) Register<T> inverse_masses(const SoilNode<T>* nodes, const int* n) {
#ifdef MPM_ONE_LANE
  return nodes[*n].inverse_mass;
#else
  Register<T> im;
  for (int l = 0; l < kSoilLanes; ++l) im[l] = nodes[n[l]].inverse_mass;
  return im;
#endif
}

/// The nodes of the cells of a group, a cell a lane: eight in space, else the four that a cell has.
template <class T, CellKind Kind>
struct GroupNodes {
  static constexpr int kCount = Kind == CellKind::space ? kCellNodes : kCellNodes / 2;
  Corners<T> of[kCount];

  GroupNodes(const Group<T>& group, const SoilNode<T>* nodes) {
    for (int e = 0; e < kCount; ++e) of[e] = load(nodes, group.node[e]);
  }
};

}  // namespace mpm::soil
