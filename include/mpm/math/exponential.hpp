// exp(A) truncated after k terms, without matrix products beyond A^2: Cayley-Hamilton gives every power in terms of
// A^2, A and I. Weak for large steps: a pure rotation by theta raises J by theta^2 (k = 1) or theta^4 / 4 (k = 2) in
// each step. Source: Nairn, GIMP notes 2.1; Nairn & Guilkey (2015) eq. (9); method reference 7.
#pragma once

#include "mpm/math/tensor.hpp"

namespace mpm {

/// I + A + A^2/2! + ... + A^terms/terms!, terms >= 1.
template <class T>
Matrix3<T> exponential(const Matrix3<T>& a, int terms) {
  if (terms == 1) {
    return {T(1) + a.xx, a.xy, a.xz, a.yx, T(1) + a.yy, a.yz, a.zx, a.zy, T(1) + a.zz};
  }
  const Matrix3<T> a2 = product(a, a);
  if (terms == 2) {
    const T half(0.5);
    return {T(1) + a.xx + half * a2.xx, a.xy + half * a2.xy,        a.xz + half * a2.xz,
            a.yx + half * a2.yx,        T(1) + a.yy + half * a2.yy, a.yz + half * a2.yz,
            a.zx + half * a2.zx,        a.zy + half * a2.zy,        T(1) + a.zz + half * a2.zz};
  }
  T square = T(0.5), linear = T(1), constant = T(1);
  if (terms > 2) {
    const T i1 = a.xx + a.yy + a.zz;
    const T i2 = T(0.5) * (i1 * i1 - (a2.xx + a2.yy + a2.zz));
    const T i3 = determinant(a);
    T pa = T(1), pb = T(0), pc = T(0);  // A^k = pa A^2 + pb A + pc I
    double factorial = 2.0;
    for (int k = 3; k <= terms; ++k) {
      const T na = i1 * pa + pb, nb = pc - i2 * pa, nc = i3 * pa;
      pa = na, pb = nb, pc = nc;
      factorial *= k;
      const T weight = T(1.0 / factorial);
      square += pa * weight;
      linear += pb * weight;
      constant += pc * weight;
    }
  }
  return {constant + linear * a.xx + square * a2.xx,
          linear * a.xy + square * a2.xy,
          linear * a.xz + square * a2.xz,
          linear * a.yx + square * a2.yx,
          constant + linear * a.yy + square * a2.yy,
          linear * a.yz + square * a2.yz,
          linear * a.zx + square * a2.zx,
          linear * a.zy + square * a2.zy,
          constant + linear * a.zz + square * a2.zz};
}

template <class T>
MatrixPlane<T> exponential(const MatrixPlane<T>& a, int terms) {
  const T t = a.xx + a.zz;
  const T d = a.xx * a.zz - a.xz * a.zx;
  T linear = T(1), constant = T(1);
  T pa = T(1), pb = T(0);  // A^k = pa A + pb I
  double factorial = 1.0;
  T power = a.yy;
  T out_of_plane = T(1) + a.yy;
  for (int k = 2; k <= terms; ++k) {
    const T na = t * pa + pb, nb = -(d * pa);
    pa = na, pb = nb;
    factorial *= k;
    const T weight = T(1.0 / factorial);
    linear += pa * weight;
    constant += pb * weight;
    power *= a.yy;
    out_of_plane += power * weight;
  }
  return {constant + linear * a.xx, linear * a.xz, linear * a.zx, constant + linear * a.zz, out_of_plane};
}

}  // namespace mpm
