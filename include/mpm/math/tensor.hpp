// Small tensors of the kernels, by component and by geometry: in a solid all nine (six) components; in a planar body
// the x-z block and the out-of-plane yy. Laws are written once against the functions below; components that a planar
// tensor lacks cost nothing. T is a number or a wide register (lanes.hpp).
#pragma once

#include "mpm/math/lanes.hpp"

namespace mpm {

/// Row-major 3x3: deformation gradient, velocity gradient.
template <class T>
struct Matrix3 {
  T xx, xy, xz, yx, yy, yz, zx, zy, zz;
  static Matrix3 identity() { return {T(1), T(0), T(0), T(0), T(1), T(0), T(0), T(0), T(1)}; }
};

template <class T>
struct Symmetric3 {
  T xx, yy, zz, yz, xz, xy;
  /// value I
  static Symmetric3 isotropic(T value) { return {value, value, value, T(0), T(0), T(0)}; }
};

/// x-z block and yy.
template <class T>
struct MatrixPlane {
  T xx, xz, zx, zz, yy;
  static MatrixPlane identity() { return {T(1), T(0), T(0), T(1), T(1)}; }
};

template <class T>
struct SymmetricPlane {
  T xx, zz, xz, yy;
  static SymmetricPlane isotropic(T value) { return {value, value, T(0), value}; }
};

// --- solid ------------------------------------------------------------------------------------------------------

template <class T>
T determinant(const Matrix3<T>& a) {
  return a.xx * (a.yy * a.zz - a.yz * a.zy) - a.xy * (a.yx * a.zz - a.yz * a.zx) + a.xz * (a.yx * a.zy - a.yy * a.zx);
}

template <class T>
Matrix3<T> product(const Matrix3<T>& a, const Matrix3<T>& b) {
  return {a.xx * b.xx + a.xy * b.yx + a.xz * b.zx, a.xx * b.xy + a.xy * b.yy + a.xz * b.zy,
          a.xx * b.xz + a.xy * b.yz + a.xz * b.zz, a.yx * b.xx + a.yy * b.yx + a.yz * b.zx,
          a.yx * b.xy + a.yy * b.yy + a.yz * b.zy, a.yx * b.xz + a.yy * b.yz + a.yz * b.zz,
          a.zx * b.xx + a.zy * b.yx + a.zz * b.zx, a.zx * b.xy + a.zy * b.yy + a.zz * b.zy,
          a.zx * b.xz + a.zy * b.yz + a.zz * b.zz};
}

/// a^-1; `det` is the determinant of a
template <class T>
Matrix3<T> inverse(const Matrix3<T>& a, T det) {
  const T s = T(1) / det;
  return {s * (a.yy * a.zz - a.yz * a.zy), s * (a.xz * a.zy - a.xy * a.zz), s * (a.xy * a.yz - a.xz * a.yy),
          s * (a.yz * a.zx - a.yx * a.zz), s * (a.xx * a.zz - a.xz * a.zx), s * (a.xz * a.yx - a.xx * a.yz),
          s * (a.yx * a.zy - a.yy * a.zx), s * (a.xy * a.zx - a.xx * a.zy), s * (a.xx * a.yy - a.xy * a.yx)};
}

/// a a^T
template <class T>
Symmetric3<T> left_cauchy_green(const Matrix3<T>& a) {
  return {a.xx * a.xx + a.xy * a.xy + a.xz * a.xz, a.yx * a.yx + a.yy * a.yy + a.yz * a.yz,
          a.zx * a.zx + a.zy * a.zy + a.zz * a.zz, a.yx * a.zx + a.yy * a.zy + a.yz * a.zz,
          a.xx * a.zx + a.xy * a.zy + a.xz * a.zz, a.xx * a.yx + a.xy * a.yy + a.xz * a.yz};
}

template <class T>
Symmetric3<T> symmetric_part(const Matrix3<T>& a) {
  const T half = T(0.5);
  return {a.xx, a.yy, a.zz, half * (a.yz + a.zy), half * (a.xz + a.zx), half * (a.xy + a.yx)};
}

template <class T>
T trace(const Symmetric3<T>& s) {
  return s.xx + s.yy + s.zz;
}

template <class T>
T determinant(const Symmetric3<T>& s) {
  return s.xx * (s.yy * s.zz - s.yz * s.yz) - s.xy * (s.xy * s.zz - s.yz * s.xz) + s.xz * (s.xy * s.yz - s.yy * s.xz);
}

/// s : s
template <class T>
T squared_norm(const Symmetric3<T>& s) {
  return s.xx * s.xx + s.yy * s.yy + s.zz * s.zz + T(2) * (s.yz * s.yz + s.xz * s.xz + s.xy * s.xy);
}

/// The tensor in lane `i`.
template <class T>
Symmetric3<ScalarOf<T>> lane(const Symmetric3<T>& s, int i) {
  return {lane(s.xx, i), lane(s.yy, i), lane(s.zz, i), lane(s.yz, i), lane(s.xz, i), lane(s.xy, i)};
}

template <class T>
Matrix3<ScalarOf<T>> lane(const Matrix3<T>& m, int i) {
  return {lane(m.xx, i), lane(m.xy, i), lane(m.xz, i), lane(m.yx, i), lane(m.yy, i),
          lane(m.yz, i), lane(m.zx, i), lane(m.zy, i), lane(m.zz, i)};
}

template <class T>
void set_lane(Symmetric3<T>& s, int i, const Symmetric3<ScalarOf<T>>& value) {
  set_lane(s.xx, i, value.xx);
  set_lane(s.yy, i, value.yy);
  set_lane(s.zz, i, value.zz);
  set_lane(s.yz, i, value.yz);
  set_lane(s.xz, i, value.xz);
  set_lane(s.xy, i, value.xy);
}

/// a s + b I
template <class T>
Symmetric3<T> scale_shift(const Symmetric3<T>& s, T a, T b) {
  return {a * s.xx + b, a * s.yy + b, a * s.zz + b, a * s.yz, a * s.xz, a * s.xy};
}

template <class T>
Symmetric3<T> sum(const Symmetric3<T>& a, const Symmetric3<T>& b) {
  return {a.xx + b.xx, a.yy + b.yy, a.zz + b.zz, a.yz + b.yz, a.xz + b.xz, a.xy + b.xy};
}

/// a s a^T
template <class T>
Symmetric3<T> congruence(const Matrix3<T>& a, const Symmetric3<T>& s) {
  const Matrix3<T> full = {s.xx, s.xy, s.xz, s.xy, s.yy, s.yz, s.xz, s.yz, s.zz};
  const Matrix3<T> m = product(a, full);
  return {m.xx * a.xx + m.xy * a.xy + m.xz * a.xz, m.yx * a.yx + m.yy * a.yy + m.yz * a.yz,
          m.zx * a.zx + m.zy * a.zy + m.zz * a.zz, m.yx * a.zx + m.yy * a.zy + m.yz * a.zz,
          m.xx * a.zx + m.xy * a.zy + m.xz * a.zz, m.xx * a.yx + m.xy * a.yy + m.xz * a.yz};
}

/// Q s Q^T with the orthogonal Q = (I - W/2)^-1 (I + W/2), W the skew part of `increment`
/// (Hughes & Winget 1980; method reference 10.1).
template <class T>
Symmetric3<T> rotate(const Symmetric3<T>& s, const Matrix3<T>& increment) {
  // Axial vector of W/2, and Q by Rodrigues' formula for the Cayley transform.
  const T quarter = T(0.25);
  const T a = quarter * (increment.zy - increment.yz);
  const T b = quarter * (increment.xz - increment.zx);
  const T c = quarter * (increment.yx - increment.xy);
  const T f = T(2) / (T(1) + a * a + b * b + c * c);
  const Matrix3<T> q = {T(1) - f * (b * b + c * c), f * (a * b - c), f * (a * c + b), f * (a * b + c),
                        T(1) - f * (a * a + c * c), f * (b * c - a), f * (a * c - b), f * (b * c + a),
                        T(1) - f * (a * a + b * b)};
  return congruence(q, s);
}

// --- planar -----------------------------------------------------------------------------------------------------

template <class T>
T determinant(const MatrixPlane<T>& a) {
  return (a.xx * a.zz - a.xz * a.zx) * a.yy;
}

template <class T>
MatrixPlane<T> product(const MatrixPlane<T>& a, const MatrixPlane<T>& b) {
  return {a.xx * b.xx + a.xz * b.zx, a.xx * b.xz + a.xz * b.zz, a.zx * b.xx + a.zz * b.zx, a.zx * b.xz + a.zz * b.zz,
          a.yy * b.yy};
}

template <class T>
MatrixPlane<T> inverse(const MatrixPlane<T>& a, T det) {
  const T s = a.yy / det;
  return {s * a.zz, -s * a.xz, -s * a.zx, s * a.xx, T(1) / a.yy};
}

template <class T>
SymmetricPlane<T> left_cauchy_green(const MatrixPlane<T>& a) {
  return {a.xx * a.xx + a.xz * a.xz, a.zx * a.zx + a.zz * a.zz, a.xx * a.zx + a.xz * a.zz, a.yy * a.yy};
}

template <class T>
SymmetricPlane<T> symmetric_part(const MatrixPlane<T>& a) {
  return {a.xx, a.zz, T(0.5) * (a.xz + a.zx), a.yy};
}

template <class T>
T trace(const SymmetricPlane<T>& s) {
  return s.xx + s.zz + s.yy;
}

template <class T>
T determinant(const SymmetricPlane<T>& s) {
  return (s.xx * s.zz - s.xz * s.xz) * s.yy;
}

template <class T>
T squared_norm(const SymmetricPlane<T>& s) {
  return s.xx * s.xx + s.zz * s.zz + s.yy * s.yy + T(2) * (s.xz * s.xz);
}

template <class T>
SymmetricPlane<ScalarOf<T>> lane(const SymmetricPlane<T>& s, int i) {
  return {lane(s.xx, i), lane(s.zz, i), lane(s.xz, i), lane(s.yy, i)};
}

template <class T>
void set_lane(SymmetricPlane<T>& s, int i, const SymmetricPlane<ScalarOf<T>>& value) {
  set_lane(s.xx, i, value.xx);
  set_lane(s.zz, i, value.zz);
  set_lane(s.xz, i, value.xz);
  set_lane(s.yy, i, value.yy);
}

template <class T>
SymmetricPlane<T> scale_shift(const SymmetricPlane<T>& s, T a, T b) {
  return {a * s.xx + b, a * s.zz + b, a * s.xz, a * s.yy + b};
}

template <class T>
SymmetricPlane<T> sum(const SymmetricPlane<T>& a, const SymmetricPlane<T>& b) {
  return {a.xx + b.xx, a.zz + b.zz, a.xz + b.xz, a.yy + b.yy};
}

template <class T>
SymmetricPlane<T> congruence(const MatrixPlane<T>& a, const SymmetricPlane<T>& s) {
  const T xx = a.xx * s.xx + a.xz * s.xz, xz = a.xx * s.xz + a.xz * s.zz;
  const T zx = a.zx * s.xx + a.zz * s.xz, zz = a.zx * s.xz + a.zz * s.zz;
  return {xx * a.xx + xz * a.xz, zx * a.zx + zz * a.zz, xx * a.zx + xz * a.zz, a.yy * s.yy * a.yy};
}

template <class T>
SymmetricPlane<T> rotate(const SymmetricPlane<T>& s, const MatrixPlane<T>& increment) {
  const T b = T(0.25) * (increment.xz - increment.zx);
  const T f = T(2) / (T(1) + b * b);
  const T cosine = T(1) - f * b * b;
  const T sine = f * b;  // Q = [cosine sine; -sine cosine] in (x, z)
  const T xx = cosine * s.xx + sine * s.xz;
  const T xz = cosine * s.xz + sine * s.zz;
  const T zx = cosine * s.xz - sine * s.xx;
  const T zz = cosine * s.zz - sine * s.xz;
  return {xx * cosine + xz * sine, zz * cosine - zx * sine, xz * cosine - xx * sine, s.yy};
}

// --- all components, whatever the geometry stores ---------------------------------------------------------------

template <class T>
const Matrix3<T>& full(const Matrix3<T>& m) {
  return m;
}
template <class T>
Matrix3<T> full(const MatrixPlane<T>& m) {
  return {m.xx, T(0), m.xz, T(0), m.yy, T(0), m.zx, T(0), m.zz};
}
template <class T>
const Symmetric3<T>& full(const Symmetric3<T>& s) {
  return s;
}
template <class T>
Symmetric3<T> full(const SymmetricPlane<T>& s) {
  return {s.xx, s.yy, s.zz, T(0), s.xz, T(0)};
}

}  // namespace mpm
