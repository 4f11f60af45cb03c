// Gradients of the nodes' functions over the soil in a cell, and how the cell's rate of strain answers to its own
// stress, which sweeps of the implicit step divide by (soil_cells.hpp). Weak: two numbers stand for the whole answer,
// so that a sweep does less than it could where a cell is far from a cube. Source: own derivation.
#pragma once

#include "mpm/kernel/soil_lanes.hpp"

namespace mpm::soil {

/// Answer of a cell's rate of strain to its own stress: sum over nodes and axes of w w^T / m, where w are the numbers
/// that a velocity along the axis gives to e. What stands for it, a number for e_N and one for e_T, must not be less in
/// any direction: sweeps would make energy where a node is light.
template <class T>
class CellAnswer {
 public:
  void add(const Register<T> (&w)[6], Register<T> im) {
    int at = 0;
    for (int i = 0; i < 6; ++i) {
      const Register<T> scaled = im * w[i];
      for (int j = 0; j <= i; ++j) w_[at++] += scaled * w[j];
    }
  }
  /// By the coupling more than that of e_N alone.
  Register<T> normal() const { return w_[0] + coupling(); }
  /// Gershgorin's bound of the largest eigenvalue of the part for e_T, and the coupling.
  Register<T> shear() const {
    Register<T> most{};
    for (int i = 1; i < 6; ++i) {
      Register<T> sum{};
      for (int j = 1; j < 6; ++j) {
        const Register<T> one = entry(i, j);
        sum += largest<T>(one, -one);
      }
      most = largest<T>(most, sum);
    }
    return most + coupling();
  }

 private:
  Register<T> entry(int i, int j) const { return i < j ? w_[j * (j + 1) / 2 + i] : w_[i * (i + 1) / 2 + j]; }
  Register<T> coupling() const {
    Register<T> sum{};
    for (int i = 1; i < 6; ++i) sum += entry(i, 0) * entry(i, 0);
    return square_root<T>(sum);
  }

  Register<T> w_[21] = {};
};

template <class T, CellKind Kind>
void prepare(Group<T>& group, const Places<T>& places, const SoilNode<T>* nodes, const Mask<T>* mask) {
  const Register<T> x = load(places.mean[0]), y = load(places.mean[1]), z = load(places.mean[2]);
  const Register<T> xy = load(places.mean[3]), xz = load(places.mean[4]), yz = load(places.mean[5]), none{};
  constexpr bool plane = Kind != CellKind::space;
  const T r2 = static_cast<T>(kOverRoot2), r3 = static_cast<T>(kOverRoot3), r6 = static_cast<T>(kOverRoot6);
  CellAnswer<T> answer;
  for (int e = 0; e < kCellNodes; ++e) {
    if (plane && e >= kCellNodes / 2) {
      for (int k = 0; k < 3; ++k) store(group.gradient[k][e], none);
      continue;
    }
    // Hat functions along the axes: a + s x, a = 1 and s = -1 at the lower node, 0 and 1 at the upper one; 1 along y in
    // a plane.
    const bool up[3] = {(e & 1) != 0, !plane && (e & 2) != 0, (e >> (plane ? 1 : 2) & 1) != 0};
    T a[3], s[3];
    for (int k = 0; k < 3; ++k) {
      s[k] = up[k] ? T(1) : T(-1);
      a[k] = up[k] ? T(0) : T(1);
    }
    if (plane) s[1] = T(0), a[1] = T(1);
    const T* h = places.inverse_cell;
    const Register<T> gx = s[0] * h[0] * (a[1] * a[2] + (a[2] * s[1]) * y + (a[1] * s[2]) * z + (s[1] * s[2]) * yz);
    Register<T> gy = s[1] * h[1] * (a[0] * a[2] + (a[2] * s[0]) * x + (a[0] * s[2]) * z + (s[0] * s[2]) * xz);
    if constexpr (Kind == CellKind::rings) {
      gy = (a[0] * a[2]) * load(places.over_radius[0]) + (a[2] * s[0]) * load(places.over_radius[1]) +
           (a[0] * s[2]) * load(places.over_radius[2]) + (s[0] * s[2]) * load(places.over_radius[3]);
    }
    const Register<T> gz = s[2] * h[2] * (a[0] * a[1] + (a[1] * s[0]) * x + (a[0] * s[1]) * y + (s[0] * s[1]) * xy);
    store(group.gradient[0][e], gx);
    store(group.gradient[1][e], gy);
    store(group.gradient[2][e], gz);
    const Register<T> im = inverse_masses(nodes, group.node[e]);
    const auto free = [&](int axis) { return mask != nullptr ? im * load(mask->free[axis][e]) : im; };
    if constexpr (Kind == CellKind::rings) {
      answer.add({r3 * (gx + gy), r2 * (gx - gy), -r6 * (gx + gy), none, r2 * gz, none}, free(0));
      answer.add({r3 * gz, none, (r6 + r6) * gz, none, r2 * gx, none}, free(2));
    } else {
      answer.add({r3 * gx, r2 * gx, -r6 * gx, none, r2 * gz, r2 * gy}, free(0));
      answer.add({r3 * gy, -r2 * gy, -r6 * gy, r2 * gz, none, r2 * gx}, free(1));
      answer.add({r3 * gz, none, (r6 + r6) * gz, r2 * gy, r2 * gx, none}, free(2));
    }
  }
  const Register<T> push = load(group.push);
  store(group.weight_n, push * answer.normal());
  store(group.weight_t, push * answer.shear());
}

}  // namespace mpm::soil
