// The deforming domain of a particle: a segment, a parallelogram or a parallelepiped about the particle, given by its
// half vectors d_k = F R_k, column k of F times half the undeformed edge along axis k (Nairn & Guilkey (2015) eq. (31)
// with erratum 10 of the method reference; 2.5 there). In the plane, components 0 and 1 are x and z: formulas in (x, y)
// hold unchanged, and the determinant of d has the sign of det F.
#pragma once

namespace mpm {

/// Largest distance of a domain's points from the particle along an axis [cells]. A larger domain is shrunk as a whole,
/// so that it stays within the surroundings of a particle that the kernels hold in cache.
constexpr double kDomainReach = 1.5 - 1e-4;

/// Reciprocal vectors r, with d_k . r_j = 1 for k = j and 0 otherwise: gradients of the coordinates that run from -1 to
/// 1 over the domain [1/length of d]. Not finite for a domain without volume; the code that updates F ensures J > 0.
template <class T, int Dim>
void reciprocal(const T (&d)[Dim][Dim], T (&r)[Dim][Dim]) {
  static_assert(1 <= Dim && Dim <= 3, "a domain of one, two or three dimensions");
  if constexpr (Dim == 1) {
    r[0][0] = T(1) / d[0][0];
  } else if constexpr (Dim == 2) {
    const T scale = T(1) / (d[0][0] * d[1][1] - d[0][1] * d[1][0]);
    r[0][0] = scale * d[1][1];
    r[0][1] = -scale * d[1][0];
    r[1][0] = -scale * d[0][1];
    r[1][1] = scale * d[0][0];
  } else {
    for (int k = 0; k < 3; ++k) {
      const T(&a)[3] = d[(k + 1) % 3], (&b)[3] = d[(k + 2) % 3];
      for (int c = 0; c < 3; ++c) r[k][c] = a[(c + 1) % 3] * b[(c + 2) % 3] - a[(c + 2) % 3] * b[(c + 1) % 3];
    }
    const T scale = T(1) / (d[0][0] * r[0][0] + d[0][1] * r[0][1] + d[0][2] * r[0][2]);
    for (auto& vector : r) {
      for (T& component : vector) component *= scale;
    }
  }
}

}  // namespace mpm
