// Shape functions of axisymmetric scenes that are products of a radial function and a planar one along the axis of
// symmetry: Dirac, uGIMP and uGIMP that stretches. Each is the planar class with an additional radial(): values,
// gradients and the hoop function, which gives v_r / r of a particle and the force of its hoop stress.
//
// Domains fitted to the axis: uGIMP's box is cut off at r = 0; a box that stretches is shrunk about its particle until
// it touches the axis, as CPDI's domains are. Whole domains reach across the axis: S and T then grow without bound as
// the particle approaches it. Weak: as the planar functions; in addition Dirac's T = N / r grows without bound near the
// axis. Source: Nairn & Guilkey (2015) eq. (14) ff., (17)-(29); method reference 3.1-3.3.
#pragma once

#include "mpm/shape/axis_rules.hpp"
#include "mpm/shape/dirac.hpp"
#include "mpm/shape/radial_box.hpp"
#include "mpm/shape/ugimp_stretch.hpp"

namespace mpm {

template <class T>
struct AxisymmetricDirac : Dirac<T> {
  static constexpr bool kAxisymmetric = true;
  using Dirac<T>::Dirac;

  struct Radial {
    T s[3], g[3], t[3];
  };
  /// `offset`: particle minus its nearest node; `node`: radius of that node, both in cells. A point has no box to fit.
  static Radial radial(T offset, T node, T /*half*/, T inverse_cell, const AxisRules&) {
    const Dirac<T> plane(offset, typename Dirac<T>::Axis(inverse_cell));
    const T per_radius = inverse_cell / max(node + offset, T(kLeastRadius));
    Radial result;
    for (int n = 0; n < 3; ++n)
      result.s[n] = plane.s[n], result.g[n] = plane.g[n], result.t[n] = plane.s[n] * per_radius;
    return result;
  }

 private:
  static constexpr double kLeastRadius = 1e-9;  ///< [cells]
};

template <class T>
struct AxisymmetricUgimp : Ugimp<T> {
  static constexpr bool kAxisymmetric = true;
  using Ugimp<T>::Ugimp;

  /// As above; `half` is the half-width of the box [cells].
  static RadialBox<T> radial(T offset, T node, T half, T inverse_cell, const AxisRules& rules) {
    const bool planar = rules.functions == AxisFunctions::planar;
    T below = offset - half;
    if (rules.domains == AxisDomains::fitted && !planar) below = max(below, -node);
    return {offset, node, below, offset + half, inverse_cell, planar};
  }
};

template <class T>
struct AxisymmetricUgimpStretch : UgimpStretch<T> {
  static constexpr bool kAxisymmetric = true;
  using UgimpStretch<T>::UgimpStretch;

  static RadialBox<T> radial(T offset, T node, T half, T inverse_cell, const AxisRules& rules) {
    if (rules.domains == AxisDomains::fitted && rules.functions == AxisFunctions::weighted) {
      half = max(min(half, node + offset), T(kLeastHalf));
    }
    return AxisymmetricUgimp<T>::radial(offset, node, half, inverse_cell, rules);
  }

 private:
  static constexpr double kLeastHalf = 1e-3;  ///< [cells]; for a particle almost on the axis
};

}  // namespace mpm
