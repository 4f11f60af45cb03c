// One contact of the implicit step: a point of a rigid body, or a node on a wall with friction, with Coulomb's law. The
// impulse is that for which the velocity there fulfils the law, with the answer of the axes that is the largest. Weak:
// a sweep does less than it could where the axes answer unalike. Source: own derivation; soil_cells.hpp.
#pragma once

#include "mpm/kernel/soil_lanes.hpp"

namespace mpm::soil {

using mpm_kernel::ContactRow;
using mpm_kernel::WallRow;

constexpr int kContactPasses = 2;  ///< passes over the rows of a block in a sweep: rows of a body bind the same nodes

template <class T>
Four<T>& four(T* of) {
  return *reinterpret_cast<Four<T>*>(of);
}

/// The impulse of Coulomb's law where an impulse l makes the velocity u + own l: no approach, no pull.
template <class T>
inline __attribute__((always_inline)) void coulomb(const T* u, const T* normal, T own, T friction, T* l) {
  const T un = u[0] * normal[0] + u[1] * normal[1] + u[2] * normal[2];
  const T ln = -un / own;
  if (ln <= T(0)) {
    l[0] = l[1] = l[2] = T(0);
    return;
  }
  T along = T(0);
  for (int a = 0; a < 3; ++a) {
    l[a] = -(u[a] - un * normal[a]) / own;
    along += l[a] * l[a];
  }
  const T most = friction * ln;
  const T part = friction >= T(0) && along > most * most ? most / root_of(along) : T(1);
  for (int a = 0; a < 3; ++a) l[a] = part * l[a] + ln * normal[a];
}

template <class T>
inline __attribute__((always_inline)) void touch_row(ContactRow<T>& row, SoilNode<T>* nodes) {
  Four<T> part[2] = {};  // sums of even and odd nodes, so that half as many sums wait for each other
  for (int e = 0; e < kCellNodes; ++e) part[e % 2] += four(row.weight[e]) * four(nodes[row.node[e]].v);
  const Four<T> velocity = part[0] + part[1];
  T u[3], l[3];
  for (int a = 0; a < 3; ++a) u[a] = velocity[a] - row.velocity[a] - row.own * row.impulse[a];
  coulomb(u, row.normal, row.own, row.friction, l);
  const Four<T> change = {l[0] - row.impulse[0], l[1] - row.impulse[1], l[2] - row.impulse[2], T(0)};
  for (int a = 0; a < 3; ++a) row.impulse[a] = l[a];
  // The fourth number of a node, its inverse mass, has no weight.
  for (int e = 0; e < kCellNodes; ++e) {
    SoilNode<T>& node = nodes[row.node[e]];
    // A node without mass may be that of several rows at once, on a device.
    if (kSoilLanes == 1 && !(node.inverse_mass > T(0))) continue;
    four(node.v) += node.inverse_mass * (four(row.weight[e]) * change);
  }
}

template <class T>
inline __attribute__((always_inline)) void touch_wall(WallRow<T>& row, SoilNode<T>* nodes) {
  SoilNode<T>& node = nodes[row.node];
  T normal[3] = {T(0), T(0), T(0)}, u[3], l[3];
  normal[row.axis] = row.out;
  for (int a = 0; a < 3; ++a) u[a] = row.free[a] * (node.v[a] - node.inverse_mass * row.impulse[a]);
  coulomb(u, normal, node.inverse_mass, row.friction, l);
  for (int a = 0; a < 3; ++a) {
    node.v[a] += node.inverse_mass * (l[a] - row.impulse[a]);
    row.impulse[a] = l[a];
  }
}

}  // namespace mpm::soil
