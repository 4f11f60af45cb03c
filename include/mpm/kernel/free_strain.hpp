// Free strain of a register of particles: that of heat and moisture, which brings no stress where nothing holds the
// material. F = F_law (1 + e), with e alike along all axes (in a plane and on a line along those across it, too): the
// law sees F_law and its increments, and stress is turned from the law's volume to that of the particle. Exact at any
// strain, for every law and geometry; of the exponential of the increment, as many terms as of any other.
//
// The law's determinant takes part, so that its J is that of the stressed part; what a run reports as J is the whole.
// Weak: isotropic alone; a survey of wave speeds sees the whole J. Source: method reference 10.1 (thermal strain off
// the increment); the multiplicative split, R. Vujosevic, V. A. Lubarda (2002), Theor. Appl. Mech. 28-29, 379-399.
#pragma once

#include "mpm/kernel/kernels.hpp"
#include "mpm/kernel/wide.hpp"
#include "mpm/math/tensor.hpp"

namespace mpm {

template <class T>
class FreeStrain {
  using W = Wide<T>;

 public:
  template <class Matrix, class Symmetric>
  struct Parts {
    Matrix f;
    Symmetric tau;
    W growth;  ///< logarithmic growth of the increment along each axis
  };

  /// The parts of F and tau that the law sees.
  template <class Matrix, class Symmetric>
  static Parts<Matrix, Symmetric> parts(const mpm_kernel::SetView<T>& set, int p, int lanes, Matrix f, Symmetric tau) {
    return FreeStrain(set, p, lanes).stressed(f, tau);
  }
  /// An increment of the whole deformation less that which brings no stress.
  template <class Matrix>
  static Matrix less_growth(const mpm_kernel::SetView<T>& set, int p, int lanes, Matrix du) {
    const W growth = FreeStrain(set, p, lanes).growth_;
    du.xx = du.xx - growth;
    du.yy = du.yy - growth;
    du.zz = du.zz - growth;
    return du;
  }
  /// The whole F and tau from what they were and what the law has made of its parts, as changes: so that round-off does
  /// not gather where nothing grows.
  template <class Matrix, class Symmetric>
  static Parts<Matrix, Symmetric> whole(const mpm_kernel::SetView<T>& set, int p, int lanes, Matrix f, Symmetric tau,
                                        Matrix law_f, Symmetric law_tau) {
    const FreeStrain free(set, p, lanes);
    const auto was = free.stressed(f, tau);
    const W ratio = W(1.0) + free.grown_, volume = free.now_ * free.now_ * free.now_;
    const Symmetric change = sum(law_tau, scale_shift(was.tau, W(-1.0), W(0.0)));
    return {sum_of(scaled(f, ratio), scaled(difference(law_f, was.f), free.now_)),
            sum(scale_shift(tau, ratio * ratio * ratio, W(0.0)), scale_shift(change, volume, W(0.0))), free.growth_};
  }

 private:
  FreeStrain(const mpm_kernel::SetView<T>& set, int p, int lanes) {
    const W e_before(W::B::place(set.strained_free + p, lanes, 0.0, 1.0, 0.0));
    const W e_now(W::B::place(set.free_strain + p, lanes, 0.0, 1.0, 0.0));
    before_ = W(1.0) + e_before;
    now_ = W(1.0) + e_now;
    // ln((1 + x) / (1 - x)) = 2 (x + x^3 / 3 + x^5 / 5 ...); what is left out is x^7, and x half of the growth.
    grown_ = (e_now - e_before) / before_;
    const W x = grown_ / (W(2.0) + grown_), xx = x * x;
    growth_ = W(2.0) * x * (W(1.0) + xx * (W(1.0 / 3.0) + W(0.2) * xx));
  }
  template <class Matrix, class Symmetric>
  Parts<Matrix, Symmetric> stressed(const Matrix& f, const Symmetric& tau) const {
    const W shrink = W(1.0) / before_;
    return {scaled(f, shrink), scale_shift(tau, shrink * shrink * shrink, W(0.0)), growth_};
  }
  template <class Combine>
  static Matrix3<W> each(const Matrix3<W>& a, const Matrix3<W>& b, Combine&& of) {
    return {of(a.xx, b.xx), of(a.xy, b.xy), of(a.xz, b.xz), of(a.yx, b.yx), of(a.yy, b.yy),
            of(a.yz, b.yz), of(a.zx, b.zx), of(a.zy, b.zy), of(a.zz, b.zz)};
  }
  template <class Combine>
  static MatrixPlane<W> each(const MatrixPlane<W>& a, const MatrixPlane<W>& b, Combine&& of) {
    return {of(a.xx, b.xx), of(a.xz, b.xz), of(a.zx, b.zx), of(a.zz, b.zz), of(a.yy, b.yy)};
  }
  template <class Matrix>
  static Matrix scaled(const Matrix& m, W by) {
    return each(m, m, [by](W c, W) { return c * by; });
  }
  template <class Matrix>
  static Matrix sum_of(const Matrix& a, const Matrix& b) {
    return each(a, b, [](W one, W other) { return one + other; });
  }
  template <class Matrix>
  static Matrix difference(const Matrix& a, const Matrix& b) {
    return each(a, b, [](W one, W other) { return one - other; });
  }

  W before_, now_;    ///< 1 + e: when the stress was last computed, and now
  W grown_, growth_;  ///< now / before - 1, and ln(now / before)
};

}  // namespace mpm
