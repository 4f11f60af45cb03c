// uGIMP whose box follows the diagonal of F: hat functions averaged over a box with edges along the axes and half-width
// w |F_kk|. Boxes continue to tile a body that is stretched or compressed along the axes, where those of uGIMP overlap
// or leave gaps. Weak: shear is not seen; rotation shrinks the box (F_kk is the cosine of the angle), so it suits
// bodies that hardly turn; beyond a cell's length the box stops growing, and gaps open again. Source: the contiguous
// particles of Bardenhagen & Kober (2004); values and gradients as in shape/ugimp.hpp, at the particle's own
// half-width. The bounds on the half-width were chosen here.
#pragma once

#include "mpm/shape/ugimp.hpp"

namespace mpm {

/// Values and gradients at the three nodes nearest-1, nearest, nearest+1.
template <class T>
struct UgimpStretch : Ugimp<T> {
  static constexpr bool kStretches = true;
  static constexpr ShapeKind kKind = ShapeKind::ugimp_stretch;
  static constexpr const char *kName = "ugimp_stretch", *kOtherName = nullptr;
  static constexpr Follows kFollows = Follows::stretch;
  static constexpr bool kTakesImplicit = false;

  /// Least half-width [cells]. At 1/100 the function differs from the hat only within a hundredth of a cell of each
  /// node; below it, differences of nearly equal numbers cost digits of the gradient.
  static constexpr double kLeastHalf = 0.01;

  struct Axis {
    T half, inverse_cell;
    /// `w`: half the undeformed box in cells, (0, 1/2]; `per_cell` [1/m].
    Axis(double w, double per_cell) : half(w), inverse_cell(per_cell) {}
  };

  /// Half the box in cells, in [kLeastHalf, 1/2]. `stretch`: F_kk of this axis.
  static T half(T stretch, const Axis& axis) { return min(max(axis.half * abs(stretch), T(kLeastHalf)), T(0.5)); }

  /// `offset`: particle minus its nearest node, in cells, in [-1/2, 1/2]; `half`: the result of half().
  UgimpStretch(T offset, T half, const Axis& axis) : Ugimp<T>(offset, box(half, axis)) {}

 private:
  static typename Ugimp<T>::Axis box(T half, const Axis& axis) {
    const T scale = T(0.25) / half;
    return {half, scale, (scale + scale) * axis.inverse_cell};
  }
};

}  // namespace mpm
