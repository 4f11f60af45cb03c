// Functions that drive a material point along paths, for the tests of the laws.
#pragma once

#include <cmath>
#include <random>

#include "mpm/material/material_point.hpp"

namespace mpm::paths {

inline Matrix3<double> scaled(const Matrix3<double>& m, double a) {
  return {a * m.xx, a * m.xy, a * m.xz, a * m.yx, a * m.yy, a * m.yz, a * m.zx, a * m.zy, a * m.zz};
}

/// a : b of symmetric tensors.
inline double contract(const Symmetric3<double>& a, const Symmetric3<double>& b) {
  return a.xx * b.xx + a.yy * b.yy + a.zz * b.zz + 2.0 * (a.yz * b.yz + a.xz * b.xz + a.xy * b.xy);
}

inline Symmetric3<double> deviator(const Symmetric3<double>& s) { return scale_shift(s, 1.0, -trace(s) / 3.0); }
inline double mises(const Symmetric3<double>& s) { return std::sqrt(1.5 * squared_norm(deviator(s))); }
inline double distance(const Symmetric3<double>& a, const Symmetric3<double>& b) {
  return std::sqrt(squared_norm(sum(a, scale_shift(b, -1.0, 0.0))));
}

/// A matrix of random components from -size to size.
inline Matrix3<double> random_gradient(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> d(-size, size);
  return {d(random), d(random), d(random), d(random), d(random), d(random), d(random), d(random), d(random)};
}

/// One step of axial strain `axial` along x with no lateral stress: y and z strain equally, by a secant to 1e-12 of
/// `scale`.
inline void advance_uniaxial(MaterialPoint& point, double axial, double dt, double scale) {
  const auto moved = [&](double lateral) {
    MaterialPoint next = point;
    next.advance({axial, 0, 0, 0, lateral, 0, 0, 0, lateral}, dt);
    return next;
  };
  double a = 0.0, b = -0.4 * axial;
  double fa = moved(a).cauchy().yy, fb = moved(b).cauchy().yy;
  for (int n = 0; n < 50 && std::abs(fb) > 1e-12 * scale && fb != fa; ++n) {
    const double c = b - fb * (b - a) / (fb - fa);
    a = b, fa = fb, b = c, fb = moved(b).cauchy().yy;
  }
  point = moved(b);
}

/// Work of the stress [J/kg] over a step of the point, by the trapezoidal rule.
inline double advance_with_work(MaterialPoint& point, const Matrix3<double>& du, double dt) {
  const Symmetric3<double> before = point.tau();
  point.advance(du, dt);
  return 0.5 * contract(sum(before, point.tau()), symmetric_part(du));
}

}  // namespace mpm::paths
