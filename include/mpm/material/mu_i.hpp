// Dry grain that flows: mu(I) rheology. Shear stress over pressure rises with the rate,
//   sqrt(J2) = mu(I) p,  mu(I) = mu_s + (mu_2 - mu_s) / (I_0 / I + 1),  I = rate d / sqrt(p / rho_s),
// with the plastic shear rate sqrt(2 D:D), the grains' diameter d and density rho_s; below mu_s p the grain is elastic,
// in rate form (linear_elastic.hpp). Flow keeps the volume, so pressure is that of the elastic predictor and the return
// is radial. The stress at the end of a step meets the law at the rate of the step (implicit, stable at any step):
// with the shear strain y, S = sqrt(J2) of the predictor - mu_s p and b = I_0 dt sqrt(p / rho_s) / d,
//   S - G y = (mu_2 - mu_s) p y / (y + b),   the positive root of G y^2 + (G b + (mu_2 - mu_s) p - S) y - S b = 0.
// Grain without pressure carries nothing; opened grain closes before it carries pressure (opening.hpp).
//
// Weak: no cohesion, no dilation, no memory of preparation; the surface is a round cone, which is mu = sin(phi) where
// the flow is plane, and more than that angle in triaxial compression; the rheology is ill-posed for very small and
// very large I (T. Barker et al. (2015), J. Fluid Mech. 779, 794-818), which the elastic part regularises; plastic work
// is computed with the stress at the end of a step.
// Source: P. Jop, Y. Forterre, O. Pouliquen (2006), Nature 441, 727-730; in rate form, with the same quadratic: S.
// Dunatunga, K. Kamrin (2015), J. Fluid Mech. 779, 483-513.
#pragma once

#include <limits>

#include "mpm/material/linear_elastic.hpp"
#include "mpm/material/opening.hpp"

namespace mpm {

class MuI : public LawDefaults {
 public:
  static constexpr Matter kMatter = Matter::soil;
  static constexpr bool kRateDependent = true;
  static constexpr bool kStiffnessOfPressure = false;
  static constexpr bool kForgetsShape = false;
  static constexpr bool kAveragesStress = true;
  static constexpr StressSource kStressFrom = StressSource::stress;
  static constexpr ImplicitSteps kImplicit = ImplicitSteps::possible;
  static constexpr int kHistory = 3;
  static constexpr int kPlasticStrain = 0;
  static constexpr int kOpening = 1;  ///< logarithmic volume by which the grain has opened
  static constexpr int kPlasticWork = 2;

  MuI(const MuIDefinition& d, double density);

  template <class T, class Matrix, class Symmetric>
  void update(const Increment<T, Matrix>& step, Symmetric& tau, T* history) const {
    const T to_tau = step.j * T(1.0 / density_);
    const Symmetric previous = scale_shift(tau, T(density_) / step.j_old, T(0));
    const Symmetric trial = LinearElastic::stress_rate_update(previous, step.du, bulk_, shear_);
    const T trial_mean = T(1.0 / 3.0) * trace(trial);
    Symmetric deviator = scale_shift(trial, T(1), -trial_mean);
    const T mean = close_opening(trial_mean, bulk_, history[kOpening]);
    const T pressure = max(-mean, T(0));
    const T j2 = T(0.5) * squared_norm(deviator), least = T(static_friction_) * pressure;
    const auto shears = j2 > least * least;
    if (any(shears)) {
      const T root_j2 = sqrt(j2);
      const T strain = select(shears, shear_strain(root_j2 - least, pressure, step.dt), T(0));
      const T left = root_j2 - T(shear_) * strain;
      deviator = scale_shift(deviator, max(left, T(0)) / max(root_j2, T(std::numeric_limits<float>::min())), T(0));
      history[kPlasticStrain] += strain;
      history[kPlasticWork] += left * strain * to_tau;
    }
    history[kOpening] += T(1.0 / bulk_) * max(mean, T(0));
    tau = scale_shift(deviator, to_tau, -pressure * to_tau);
  }

  template <class Matrix, class Symmetric>
  double elastic_energy(const Matrix&, const Symmetric& tau, double j) const {
    return LinearElastic::stress_energy(scale_shift(tau, density_ / j, 0.0), bulk_, shear_) * j / density_;
  }

  template <class T, class Matrix, class Symmetric>
  T wave_speed(const Matrix&, const Symmetric& tau, T j) const {
    return soil_wave_speed(tau, j, bulk_, shear_, density_, flow_);
  }
  Symmetric3<double> elastic_strain(const StressedPoint& at) const {
    return LinearElastic::stress_strain(at.cauchy, bulk_, shear_);
  }
  double density() const { return density_; }

 private:
  /// Shear strain of a step of `dt` [s] that leaves of `excess`, sqrt(J2) beyond mu_s p [Pa], what the rate takes.
  template <class T>
  T shear_strain(T excess, T pressure, T dt) const {
    const T b = T(reference_) * dt * sqrt(pressure), product = T(4.0 * shear_) * max(excess, T(0)) * b;
    const T half = T(shear_) * b + T(friction_rise_) * pressure - excess;
    const T root = sqrt(half * half + product);
    // Two forms of the same root, each without a difference of large numbers where it is used.
    const T slow = T(2) * excess * b / max(root + half, T(std::numeric_limits<float>::min()));
    return select(half > T(0), slow, T(0.5 / shear_) * (root - half));
  }

  double density_, bulk_, shear_;
  double static_friction_, friction_rise_;  ///< mu_s and mu_2 - mu_s
  double reference_;                        ///< I_0 / (d sqrt(rho_s)), the rate for I_0 over sqrt(p) [1/(s sqrt(Pa))]
  double flow_;                             ///< largest contribution of plastic flow to rho c^2 [Pa]
};

}  // namespace mpm
