// The geometries that the kernels are compiled for: the number of axes, which world axes they are, and how a particle's
// tensors lie in structure-of-arrays storage. An out-of-plane policy is stated here and nowhere else.
//
// In every geometry the first kDim x kDim stored components of the deformation gradient are its rows in the grid's
// axes. Storage is any type that gives component c of particle p as a[c][p]: arrays of numbers, or views of them as
// registers.
#pragma once

#include <type_traits>

#include "mpm/math/geometry_kind.hpp"
#include "mpm/math/tensor.hpp"

namespace mpm {

/// Three dimensions.
struct Solid {
  static constexpr bool kHoop = false;
  static constexpr int kDim = 3;
  static constexpr int kMatrix = 9;     ///< stored components of the deformation gradient
  static constexpr int kSymmetric = 6;  ///< stored components of a stress
  template <class T>
  using Matrix = Matrix3<T>;
  template <class T>
  using Symmetric = Symmetric3<T>;

  template <class Arrays>
  static auto load_matrix(const Arrays& a, int p) {
    using T = std::decay_t<decltype(a[0][p])>;
    return Matrix3<T>{a[0][p], a[1][p], a[2][p], a[3][p], a[4][p], a[5][p], a[6][p], a[7][p], a[8][p]};
  }
  template <class T, class Arrays>
  static void store_matrix(const Matrix3<T>& m, const Arrays& a, int p) {
    a[0][p] = m.xx, a[1][p] = m.xy, a[2][p] = m.xz;
    a[3][p] = m.yx, a[4][p] = m.yy, a[5][p] = m.yz;
    a[6][p] = m.zx, a[7][p] = m.zy, a[8][p] = m.zz;
  }
  template <class Arrays>
  static auto load_symmetric(const Arrays& a, int p) {
    using T = std::decay_t<decltype(a[0][p])>;
    return Symmetric3<T>{a[0][p], a[1][p], a[2][p], a[3][p], a[4][p], a[5][p]};
  }
  template <class T, class Arrays>
  static void store_symmetric(const Symmetric3<T>& s, const Arrays& a, int p) {
    a[0][p] = s.xx, a[1][p] = s.yy, a[2][p] = s.zz, a[3][p] = s.yz, a[4][p] = s.xz, a[5][p] = s.xy;
  }
  /// Velocity gradient from d v_i / d x_j, row by row.
  template <class T>
  static Matrix3<T> gradient(const T (&l)[3][3]) {
    return {l[0][0], l[0][1], l[0][2], l[1][0], l[1][1], l[1][2], l[2][0], l[2][1], l[2][2]};
  }
  /// Deformation gradient of a pure change of volume.
  template <class T>
  static Matrix3<T> dilatation(T j) {
    const T root = inverse_cbrt(j), edge = j * root * root;
    return {edge, T(0), T(0), T(0), edge, T(0), T(0), T(0), edge};
  }
  /// Column j of the stress: the traction on a face whose normal is axis j.
  template <class T>
  static void column(const Symmetric3<T>& s, int j, T (&c)[3]) {
    if (j == 0) {
      c[0] = s.xx, c[1] = s.xy, c[2] = s.xz;
    } else if (j == 1) {
      c[0] = s.xy, c[1] = s.yy, c[2] = s.yz;
    } else {
      c[0] = s.xz, c[1] = s.yz, c[2] = s.zz;
    }
  }
};

/// Two dimensions, x and z; no strain along y.
struct PlaneStrain {
  static constexpr bool kHoop = false;
  static constexpr int kDim = 2;
  static constexpr int kMatrix = 4;
  static constexpr int kSymmetric = 4;
  template <class T>
  using Matrix = MatrixPlane<T>;
  template <class T>
  using Symmetric = SymmetricPlane<T>;

  template <class Arrays>
  static auto load_matrix(const Arrays& a, int p) {
    using T = std::decay_t<decltype(a[0][p])>;
    return MatrixPlane<T>{a[0][p], a[1][p], a[2][p], a[3][p], T(1)};
  }
  template <class T, class Arrays>
  static void store_matrix(const MatrixPlane<T>& m, const Arrays& a, int p) {
    a[0][p] = m.xx, a[1][p] = m.xz, a[2][p] = m.zx, a[3][p] = m.zz;
  }
  template <class Arrays>
  static auto load_symmetric(const Arrays& a, int p) {
    using T = std::decay_t<decltype(a[0][p])>;
    return SymmetricPlane<T>{a[0][p], a[1][p], a[2][p], a[3][p]};
  }
  template <class T, class Arrays>
  static void store_symmetric(const SymmetricPlane<T>& s, const Arrays& a, int p) {
    a[0][p] = s.xx, a[1][p] = s.zz, a[2][p] = s.xz, a[3][p] = s.yy;
  }
  template <class T>
  static MatrixPlane<T> gradient(const T (&l)[2][2]) {
    return {l[0][0], l[0][1], l[1][0], l[1][1], T(0)};
  }
  template <class T>
  static MatrixPlane<T> dilatation(T j) {
    const T edge = sqrt(j);
    return {edge, T(0), T(0), edge, T(1)};
  }
  template <class T>
  static void column(const SymmetricPlane<T>& s, int j, T (&c)[2]) {
    if (j == 0) {
      c[0] = s.xx, c[1] = s.xz;
    } else {
      c[0] = s.xz, c[1] = s.zz;
    }
  }
};

/// Two dimensions, x and z; no stress along y: a thin plate with free faces. The law determines the strain along y
/// (material/plane_stress.hpp), which is stored beside the others.
struct PlaneStress : PlaneStrain {
  static constexpr int kMatrix = 5;

  template <class Arrays>
  static auto load_matrix(const Arrays& a, int p) {
    using T = std::decay_t<decltype(a[0][p])>;
    return MatrixPlane<T>{a[0][p], a[1][p], a[2][p], a[3][p], a[4][p]};
  }
  template <class T, class Arrays>
  static void store_matrix(const MatrixPlane<T>& m, const Arrays& a, int p) {
    PlaneStrain::store_matrix(m, a, p);
    a[4][p] = m.yy;
  }
};

/// Two dimensions, r = x and z, about the axis r = 0. Along the hoop direction, y, a particle is stretched by v_r / r,
/// which is stored beside the others; nothing moves or shears along it. Nairn & Guilkey (2015) eq. (10).
struct Axisymmetric : PlaneStress {
  /// The velocity gradient includes v_r / r, and the hoop stress has a force of its own.
  static constexpr bool kHoop = true;

  template <class T>
  static MatrixPlane<T> dilatation(T j) {
    const T root = inverse_cbrt(j), edge = j * root * root;
    return {edge, T(0), T(0), edge, edge};
  }
};

/// One dimension, x; no strain along y and z, whose stresses follow from the law: a column between smooth stiff walls.
/// For a bar with free sides use a material whose Poisson's ratio is 0.
struct Line {
  static constexpr bool kHoop = false;
  static constexpr int kDim = 1;
  static constexpr int kMatrix = 1;
  static constexpr int kSymmetric = 3;
  template <class T>
  using Matrix = MatrixPlane<T>;
  template <class T>
  using Symmetric = SymmetricPlane<T>;

  template <class Arrays>
  static auto load_matrix(const Arrays& a, int p) {
    using T = std::decay_t<decltype(a[0][p])>;
    return MatrixPlane<T>{a[0][p], T(0), T(0), T(1), T(1)};
  }
  template <class T, class Arrays>
  static void store_matrix(const MatrixPlane<T>& m, const Arrays& a, int p) {
    a[0][p] = m.xx;
  }
  template <class Arrays>
  static auto load_symmetric(const Arrays& a, int p) {
    using T = std::decay_t<decltype(a[0][p])>;
    return SymmetricPlane<T>{a[0][p], a[2][p], T(0), a[1][p]};
  }
  template <class T, class Arrays>
  static void store_symmetric(const SymmetricPlane<T>& s, const Arrays& a, int p) {
    a[0][p] = s.xx, a[1][p] = s.yy, a[2][p] = s.zz;
  }
  template <class T>
  static MatrixPlane<T> gradient(const T (&l)[1][1]) {
    return {l[0][0], T(0), T(0), T(0), T(0)};
  }
  template <class T>
  static MatrixPlane<T> dilatation(T j) {
    return {j, T(0), T(0), T(1), T(1)};
  }
  template <class T>
  static void column(const SymmetricPlane<T>& s, int, T (&c)[1]) {
    c[0] = s.xx;
  }
};

/// Calls visit(Line()), visit(PlaneStrain()), ... according to `kind` and returns its result.
template <class Visit>
decltype(auto) with_geometry(GeometryKind kind, Visit&& visit) {
  if (kind == GeometryKind::line) return visit(Line());
  if (kind == GeometryKind::plane_strain) return visit(PlaneStrain());
  if (kind == GeometryKind::plane_stress) return visit(PlaneStress());
  if (kind == GeometryKind::axisymmetric) return visit(Axisymmetric());
  return visit(Solid());
}

}  // namespace mpm
