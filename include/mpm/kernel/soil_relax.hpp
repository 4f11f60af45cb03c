// A sweep over the cells of one group: the rate of strain from the nodes' velocities, the stress that fulfils the law
// with it, and the momentum of its change back to the nodes; and what has flowed when sweeps have ended. One source for
// the processor, eight cells at once, and for devices, a cell a thread. Weak and source: soil_cells.hpp.
#pragma once

#include "mpm/kernel/soil_answer.hpp"
#include "mpm/kernel/soil_surface.hpp"

namespace mpm::soil {

// In rings a node's gradient along y is its hoop function, the mean of N / r; in planes it is none, and what follows
// from motion along y is left out.

/// Rates of strain, mapped, from the velocities of the nodes.
template <class T, CellKind Kind>
inline __attribute__((always_inline)) void rate(const Group<T>& group, const GroupNodes<T, Kind>& nodes,
                                                Register<T> (&e)[6]) {
  // Sums of even and odd nodes apart, so that half as many sums wait for each other.
  Register<T> part[2][6] = {};
  for (int n = 0; n < nodes.kCount; ++n) {
    const Register<T> x = load(group.gradient[0][n]), y = load(group.gradient[1][n]), z = load(group.gradient[2][n]);
    const Corners<T>& v = nodes.of[n];
    Register<T>(&sums)[6] = part[n % 2];
    sums[0] += x * v.x;
    if constexpr (Kind != CellKind::plane) sums[1] += y * (Kind == CellKind::rings ? v.x : v.y);
    sums[2] += z * v.z;
    if constexpr (Kind == CellKind::space) sums[3] += y * v.z + z * v.y;
    sums[4] += x * v.z + z * v.x;
    if constexpr (Kind == CellKind::space) sums[5] += x * v.y + y * v.x;
  }
  Register<T> whole[6];
  for (int i = 0; i < 6; ++i) whole[i] = part[0][i] + part[1][i];
  const auto& [xx, yy, zz, yz, xz, xy] = whole;
  e[0] = static_cast<T>(kOverRoot3) * (xx + yy + zz);
  e[1] = static_cast<T>(kOverRoot2) * (xx - yy);
  e[2] = static_cast<T>(kOverRoot6) * (zz + zz - xx - yy);
  e[3] = static_cast<T>(kOverRoot2) * yz;
  e[4] = static_cast<T>(kOverRoot2) * xz;
  e[5] = static_cast<T>(kOverRoot2) * xy;
}

/// Changes the velocities of the nodes by changes `d` of the stresses.
template <class T, CellKind Kind>
inline __attribute__((always_inline)) void spread(const Group<T>& group, const Mask<T>* masks,
                                                  const Register<T> (&d)[6], GroupNodes<T, Kind>& nodes) {
  const Register<T> f = load(group.push);
  const Register<T> p = static_cast<T>(kOverRoot3) * d[0], q = static_cast<T>(kOverRoot6) * d[2],
                    h = static_cast<T>(kOverRoot2) * d[1];
  const Register<T> sx = f * (p + h - q), sy = f * (p - h - q), sz = f * (p + q + q);
  const Register<T> g = f * static_cast<T>(kOverRoot2), yz = g * d[3], xz = g * d[4], xy = g * d[5];
  for (int n = 0; n < nodes.kCount; ++n) {
    const Register<T> bx = load(group.gradient[0][n]), by = load(group.gradient[1][n]), bz = load(group.gradient[2][n]);
    Corners<T>& v = nodes.of[n];
    Register<T> x = bx * sx + bz * xz, y{}, z = bx * xz + bz * sz;
    if constexpr (Kind == CellKind::rings) x += by * sy;
    if constexpr (Kind == CellKind::space) {
      x += by * xy;
      y = v.m * (bx * xy + by * sy + bz * yz);
      z += by * yz;
    }
    x *= v.m;
    z *= v.m;
    if (group.mask >= 0) {
      const Mask<T>& mask = masks[group.mask];
      x *= load(mask.free[0][n]);
      if constexpr (Kind == CellKind::space) y *= load(mask.free[1][n]);
      z *= load(mask.free[2][n]);
    }
    v.x += x;
    if constexpr (Kind == CellKind::space) v.y += y;
    v.z += z;
  }
}

template <class T, CellKind Kind>
inline __attribute__((always_inline)) void relax(Group<T>& group, const Mask<T>* masks, SoilNode<T>* nodes,
                                                 Register<T>& size, Register<T>& change) {
  GroupNodes<T, Kind> corners(group, nodes);
  Register<T> b[6], r[6];
  rate(group, corners, b);
  const Register<T> weight_n = load(group.weight_n), weight_t = load(group.weight_t);
  for (int k = 0; k < 6; ++k) b[k] += load(group.shift[k]) - (k == 0 ? weight_n : weight_t) * load(group.stress[k]);
  const Register<T> bt = length<T>(b);
  const Register<T> own_n = weight_n + load(group.compliance_n), own_t = weight_t + load(group.compliance_t);
  solve(group, own_n, own_t, load(group.theta), b, bt, r);
  const Register<T> push = load(group.push);
  for (int k = 0; k < 6; ++k) {
    const Register<T> found = r[k], weight = push * (k == 0 ? own_n : own_t);
    r[k] -= load(group.stress[k]);
    store(group.stress[k], found);
    size += weight * found * found;
    change += weight * r[k] * r[k];
  }
  spread(group, masks, r, corners);
  for (int e = 0; e < corners.kCount; ++e) store(nodes, group.node[e], corners.of[e]);
  find_surface(group, b, bt);
  if (group.friction_rise > T(0)) find_slope_at_rate(group, bt, own_t, load(group.stress[0]));
}

/// Part of the strength from which on a stress lies on the surface, whose Lode angle is found anew after each sweep.
constexpr double kFlows = 0.95;

template <class T, CellKind Kind>
void flow(const Group<T>& group, const SoilNode<T>* nodes, Flow<T>& out) {
  const GroupNodes<T, Kind> corners(group, nodes);
  Register<T> e[6], plastic[6], shear{};
  rate(group, corners, e);
  const Register<T> compliance_n = load(group.compliance_n), compliance_t = load(group.compliance_t);
  for (int k = 0; k < 6; ++k) {
    store(out.rate[k], e[k]);
    plastic[k] = e[k] + load(group.shift[k]) + (k == 0 ? compliance_n : compliance_t) * load(group.stress[k]);
    if (k > 0) shear += plastic[k] * plastic[k];
  }
  shear = square_root<T>(shear);
  // Below the surface what elasticity does not account for is work that sweeps have left, and no flow.
  Register<T> r[6];
  for (int k = 0; k < 6; ++k) r[k] = load(group.stress[k]);
  const Register<T> bears = load(group.strength) + load(group.slope) * r[0], none{};
  store(out.shear, length<T>(r) >= static_cast<T>(kFlows) * bears ? shear : none);
  store(out.opening, plastic[0] - load(group.closing) - load(group.theta) * shear);
  for (int a = 0; a < 3; ++a) {
    for (int k = 0; k < 3; ++k) {
      Register<T> sum{};
      for (int n = 0; n < corners.kCount; ++n) {
        if (Kind == CellKind::rings && (a == 1) != (k == 1)) break;
        const Corners<T>& v = corners.of[n];
        sum += load(group.gradient[k][n]) * (a == 0 || (Kind == CellKind::rings && a == 1) ? v.x : a == 1 ? v.y : v.z);
      }
      store(out.gradient[3 * a + k], sum);
    }
  }
}

}  // namespace mpm::soil
