// Metal: J2 (von Mises) plasticity with isotropic hardening at finite strain. The isochoric elastic left Cauchy-Green
// tensor b gives s = dev tau = G dev b; trial state by the increment, radial return of s to the Mises stress
//   sigma_y(a) = yield + H a + (saturation - yield) (1 - exp(-rate a))        (linear and Voce hardening).
// Pressure is that of neo_hookean.hpp, and below yield so is the whole law. Source: Simo & Hughes, Computational
// Inelasticity, box 9.1.
//
// Logarithmic strain is not used because this form needs no principal directions; it is exactly hyperelastic, so that
// closed elastic cycles leave no stress behind; and b follows from the stress, so that a particle stores no strain.
//
// Two things differ from box 9.1. tr b follows from det b = 1 (isochoric.hpp), where the box keeps that of the trial
// state, which grows without end under plastic flow. And the modulus of the return is such that plastic strain times
// Mises stress is the elastic energy released by flow (return_modulus()); for small elastic strain it is three times
// the box's G I1 / 3.
//
// Plastic work closes the energy balance to second order in the step while elastic strain is small. Weak: it yields on
// Kirchhoff stress (Cauchy stress at yield is sigma_y / J); no rate or temperature, no kinematic hardening.
#pragma once

#include <cmath>
#include <limits>

#include "mpm/material/definition.hpp"
#include "mpm/material/increment.hpp"
#include "mpm/material/isochoric.hpp"
#include "mpm/material/neo_hookean.hpp"

namespace mpm {

class J2Plasticity : public LawDefaults {
 public:
  static constexpr Matter kMatter = Matter::solid;
  static constexpr bool kRateDependent = false;
  static constexpr bool kStiffnessOfPressure = false;
  static constexpr bool kForgetsShape = false;
  static constexpr bool kAveragesStress = true;
  static constexpr StressSource kStressFrom = StressSource::volume_and_stress;
  static constexpr ImplicitSteps kImplicit = ImplicitSteps::possible;
  static constexpr int kHistory = 2;
  static constexpr int kPlasticStrain = 0;
  static constexpr int kPlasticWork = 1;

  J2Plasticity(const J2PlasticityDefinition& d, double density)
      : density_(density),
        bulk_(d.elasticity.bulk()),
        shear_(d.elasticity.shear()),
        yield_(d.yield_stress),
        hardening_(d.hardening_modulus),
        voce_(d.saturation_rate > 0.0 ? d.saturation_stress - d.yield_stress : 0.0),
        rate_(d.saturation_rate) {}

  template <class T, class Matrix, class Symmetric>
  void update(const Increment<T, Matrix>& step, Symmetric& tau, T* history) const {
    const Symmetric before = elastic_deviator<T>(tau);
    Symmetric deviator = stretch_isochoric(step.df, step.j / step.j_old, before, isochoric_excess(before));
    const T j2 = T(0.5) * squared_norm(deviator);
    // The exponential of Voce's part is evaluated only where the stress exceeds the strength without it.
    const T least = T(yield_) + T(hardening_) * history[kPlasticStrain];
    if (any(T(3.0 * shear_ * shear_) * j2 > least * least)) flow(j2, deviator, history);
    tau = scale_shift(deviator, T(shear_ / density_), T(0.5 * bulk_ / density_) * (step.j * step.j - T(1)));
  }

  template <class Matrix, class Symmetric>
  double elastic_energy(const Matrix&, const Symmetric& tau, double j) const {
    const double excess = isochoric_excess(elastic_deviator<double>(tau));
    return (NeoHookean::volume_energy(j, bulk_) + 1.5 * shear_ * excess) / density_;
  }

  /// Wave speed of the elastic response; plastic flow is slower.
  template <class T, class Matrix, class Symmetric>
  T wave_speed(const Matrix&, const Symmetric& tau, T j) const {
    const Symmetric deviator = elastic_deviator<T>(tau);
    const T modulus = T(shear_) / j;
    const Symmetric gb = scale_shift(deviator, modulus, modulus * (T(1) + isochoric_excess(deviator)));
    return sqrt(stiffest_wave(gb, NeoHookean::volume_stiffness(j, bulk_)) * j * T(1.0 / density_));
  }
  Symmetric3<double> elastic_strain(const StressedPoint& at) const {
    return isochoric_strain(at.tau, at.j, density_ / shear_);
  }
  double density() const { return density_; }
  /// sigma_y at a plastic strain [Pa].
  double yield_stress(double strain) const { return strength(strain, voce_part(strain)); }

 private:
  template <class T, class Symmetric>
  Symmetric elastic_deviator(const Symmetric& tau) const {
    const T scale = T(density_ / shear_);
    return scale_shift(tau, scale, T(-1.0 / 3.0) * scale * trace(tau));
  }

  /// Returns the deviator to the yield stress in the lanes where its Mises stress is larger.
  template <class T, class Symmetric>
  void flow(T j2, Symmetric& deviator, T* history) const {
    const T shear = T(shear_);
    T& strain = history[kPlasticStrain];
    const T mises = shear * sqrt(T(3) * j2);
    const T before = strength(strain, voce_part(strain));
    const auto flows = mises > before;
    if (!any(flows)) return;
    const T j3 = determinant(deviator);
    const T excess = isochoric_excess(j2, j3);
    const T modulus = return_modulus(shear, j2, j3, excess);
    const T plastic = plastic_increment(flows, mises, before, modulus, strain);
    const T after = mises - modulus * plastic;
    deviator = scale_shift(deviator, select(flows, after / mises, T(1)), T(0));
    strain += plastic;
    // The energy released by the return, minus the surplus that the trial step took up to get there: to second order in
    // the step, the mean Mises stress of the step times its plastic strain.
    const T released = T(1.5) * shear * (excess - isochoric_excess(deviator));
    const T work = T(1.0 / density_) * (released - T(0.5) * (mises - before) * plastic);
    history[kPlasticWork] += select(flows, work, T(0));
  }

  /// The remaining distance of Voce's part from saturation [Pa].
  template <class T>
  T voce_part(T strain) const {
    return voce_ > 0.0 ? T(voce_) * exp(T(-rate_) * strain) : T(0);
  }
  /// sigma_y [Pa]; `lacks` is voce_part().
  template <class T>
  T strength(T strain, T lacks) const {
    return T(yield_) + T(hardening_) * strain + (T(voce_) - lacks);
  }

  /// Root x of mises - modulus x = sigma_y(strain + x) where `flows` holds, 0 elsewhere; `before`: sigma_y(strain). The
  /// left side minus the right one decreases and is convex, so Newton's method approaches the root from below; without
  /// Voce's part one step suffices.
  template <class T, class Mask>
  T plastic_increment(const Mask& flows, T mises, T before, T modulus, T strain) const {
    const T least_slope = modulus + T(hardening_);
    if (voce_ == 0.0) return select(flows, (mises - before) / least_slope, T(0));
    constexpr int kSteps = 30;
    constexpr double kRoundOff = 64.0 * std::numeric_limits<ScalarOf<T>>::epsilon();
    T x = T(0);
    auto open = flows;
    for (int i = 0; i < kSteps; ++i) {
      const T total = strain + x, lacks = voce_part(total);
      const T excess = mises - modulus * x - strength(total, lacks);
      open = open & (excess > T(kRoundOff) * mises);
      if (!any(open)) break;
      x += select(open, excess / (least_slope + T(rate_) * lacks), T(0));
    }
    return x;
  }

  double density_, bulk_, shear_;
  double yield_, hardening_;
  double voce_;  ///< saturation minus yield stress [Pa]
  double rate_;
};

}  // namespace mpm
