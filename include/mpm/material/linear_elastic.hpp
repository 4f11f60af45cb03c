// Linear elasticity in rate form: Cauchy stress is rotated with the step (Hughes & Winget 1980) and increased by C :
// sym(grad v) dt. Weak at large elastic strain: hypoelasticity dissipates or creates energy around closed paths, and
// simple shear follows G sin(gamma) (exact-solutions 4). Source: method reference 10.1.
#pragma once

#include "mpm/material/definition.hpp"
#include "mpm/material/increment.hpp"
#include "mpm/math/tensor.hpp"

namespace mpm {

class LinearElastic : public LawDefaults {
 public:
  static constexpr Matter kMatter = Matter::solid;
  static constexpr bool kRateDependent = false;
  static constexpr bool kStiffnessOfPressure = false;
  static constexpr bool kForgetsShape = false;
  static constexpr bool kAveragesStress = false;
  static constexpr StressSource kStressFrom = StressSource::stress;
  static constexpr ImplicitSteps kImplicit = ImplicitSteps::refused;
  LinearElastic(const LinearElasticDefinition& d, double density)
      : density_(density), bulk_(d.elasticity.bulk()), shear_(d.elasticity.shear()) {}

  /// Advances Cauchy stress over one increment `du` = grad v dt.
  template <class Matrix, class Symmetric>
  static Symmetric stress_rate_update(const Symmetric& cauchy, const Matrix& du, double bulk, double shear) {
    using T = decltype(trace(cauchy));
    const Symmetric strain = symmetric_part(du);
    // Half of the increment is added before the rotation and half after it, which is second order in the step.
    const Symmetric half = scale_shift(strain, T(shear), T(0.5 * (bulk - 2.0 / 3.0 * shear)) * trace(strain));
    return sum(rotate(sum(cauchy, half), du), half);
  }

  /// Law interface (law.hpp): advances the specific Kirchhoff stress tau/rho0.
  template <class T, class Matrix, class Symmetric>
  void update(const Increment<T, Matrix>& step, Symmetric& tau, T*) const {
    const Symmetric cauchy = scale_shift(tau, T(density_) / step.j_old, T(0));
    tau = scale_shift(stress_rate_update(cauchy, step.du, bulk_, shear_), step.j * T(1.0 / density_), T(0));
  }

  /// Stored energy per unit mass [J/kg] of a Cauchy stress: small-strain complementary energy.
  template <class Matrix, class Symmetric>
  double elastic_energy(const Matrix&, const Symmetric& tau, double j) const {
    return stress_energy(scale_shift(tau, density_ / j, 0.0), bulk_, shear_) * j / density_;
  }
  template <class Symmetric>
  static double stress_energy(const Symmetric& cauchy, double bulk, double shear) {
    const double pressure = trace(cauchy) / 3.0;
    const double deviator2 = squared_norm(scale_shift(cauchy, 1.0, -pressure));
    return pressure * pressure / (2.0 * bulk) + deviator2 / (4.0 * shear);
  }

  /// Strain of a Cauchy stress [Pa].
  static Symmetric3<double> stress_strain(const Symmetric3<double>& cauchy, double bulk, double shear) {
    const double mean = trace(cauchy) / 3.0;
    return scale_shift(cauchy, 0.5 / shear, mean * (1.0 / (3.0 * bulk) - 0.5 / shear));
  }

  template <class T, class Matrix, class Symmetric>
  T wave_speed(const Matrix&, const Symmetric& tau, T j) const {
    return tangent_wave_speed(tau, j, bulk_, shear_, density_, T(0));
  }
  /// Upper bound of the speed of small waves [m/s]: longitudinal ones, which the present stress does not affect
  /// (Jaumann rate of Cauchy stress), or transverse ones, with at most G + (s1 - s3)/2, where s1 - s3 <= sqrt(2) |dev
  /// s|. `flow`: a further contribution to rho c^2 [Pa].
  template <class T, class Symmetric>
  static T tangent_wave_speed(const Symmetric& tau, T j, double bulk, double shear, double density, T flow) {
    const T deviator = sqrt(squared_norm(scale_shift(tau, T(1), T(-1.0 / 3.0) * trace(tau)))) * T(density) / j;
    const T along = T(bulk + 4.0 / 3.0 * shear), across = T(shear) + T(1.0 / kRoot2) * deviator;
    // select() instead of max(), so that NaN is passed on.
    return sqrt((select(across <= along, along, across) + flow) * j * T(1.0 / density));
  }
  double density() const { return density_; }

 private:
  static constexpr double kRoot2 = 1.4142135623730951;

  double density_, bulk_, shear_;
};

}  // namespace mpm
