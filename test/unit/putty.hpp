// A law as a user adds it: all that a new law needs stands in this file (material/add_user_law.hpp).
#pragma once

#include "mpm/material/add_user_law.hpp"
#include "mpm/material/linear_elastic.hpp"

namespace mpm::test {

/// Clay that shears at sqrt(J2) = k.
class Putty : public LawDefaults {
 public:
  static constexpr Matter kMatter = Matter::soil;
  static constexpr bool kRateDependent = false, kStiffnessOfPressure = false, kForgetsShape = false;
  static constexpr bool kAveragesStress = true;
  static constexpr StressSource kStressFrom = StressSource::stress;
  static constexpr ImplicitSteps kImplicit = ImplicitSteps::refused;
  static constexpr int kHistory = 2, kPlasticStrain = 0, kPlasticWork = 1;

  Putty(const UserLawDefinition& d, double density)
      : density_(density),
        bulk_(d.elasticity.bulk()),
        shear_(d.elasticity.shear()),
        strength_(d.constant("strength")) {}
  template <class T, class Matrix, class Symmetric>
  void update(const Increment<T, Matrix>& step, Symmetric& tau, T* history) const {
    const Symmetric before = scale_shift(tau, T(density_) / step.j_old, T(0));
    Symmetric cauchy = LinearElastic::stress_rate_update(before, step.du, bulk_, shear_);
    const T mean = T(1.0 / 3.0) * trace(cauchy);
    const Symmetric deviator = scale_shift(cauchy, T(1), -mean);
    const T root = sqrt(T(0.5) * squared_norm(deviator)), beyond = max(root - T(strength_), T(0));
    history[0] += beyond / T(shear_);
    history[1] += beyond * T(strength_ / (shear_ * density_)) * step.j;
    cauchy = scale_shift(deviator, min(T(strength_) / max(root, T(1e-30)), T(1)), mean);
    tau = scale_shift(cauchy, step.j / T(density_), T(0));
  }
  double elastic_energy(const Matrix3<double>&, const Symmetric3<double>& tau, double j) const {
    return LinearElastic::stress_energy(scale_shift(tau, density_ / j, 0.0), bulk_, shear_) * j / density_;
  }
  double wave_speed(const Matrix3<double>&, const Symmetric3<double>& tau, double j) const {
    return LinearElastic::tangent_wave_speed(tau, j, bulk_, shear_, density_, 0.0);
  }
  Symmetric3<double> elastic_strain(const StressedPoint& at) const {
    return LinearElastic::stress_strain(at.cauchy, bulk_, shear_);
  }
  double density() const { return density_; }

 private:
  double density_, bulk_, shear_, strength_;
};
inline const bool kAdded = add_user_law<Putty>("putty", {{"strength", kPressure, kPositive}});

}  // namespace mpm::test
