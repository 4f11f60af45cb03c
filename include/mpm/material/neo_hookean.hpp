// Compressible neo-Hookean solid. W = K/2 [(J^2 - 1)/2 - ln J] + G/2 (I1 J^(-2/3) - 3), so sigma = K/2 (J - 1/J) I + G
// J^(-5/3) dev B. Weak in extreme stretch: with K and G alone it does not lock. Source: Nairn & Guilkey (2015) eq.
// (64); method reference 10.2.
#pragma once

#include <cmath>

#include "mpm/material/definition.hpp"
#include "mpm/material/increment.hpp"
#include "mpm/material/isochoric.hpp"

namespace mpm {

class NeoHookean : public LawDefaults {
 public:
  static constexpr Matter kMatter = Matter::solid;
  static constexpr bool kRateDependent = false;
  static constexpr bool kStiffnessOfPressure = false;
  static constexpr bool kForgetsShape = false;
  static constexpr bool kAveragesStress = false;
  static constexpr StressSource kStressFrom = StressSource::deformation;
  static constexpr ImplicitSteps kImplicit = ImplicitSteps::refused;
  NeoHookean(const NeoHookeanDefinition& d, double density)
      : density_(density), bulk_(d.elasticity.bulk()), shear_(d.elasticity.shear()) {}

  template <class T, class Matrix, class Symmetric>
  void update(const Increment<T, Matrix>& step, Symmetric& tau, T*) const {
    const Symmetric b = left_cauchy_green(step.f);
    const T j = step.j;
    const T root = inverse_cbrt(j);
    const T deviatoric = T(shear_ / density_) * root * root;          // J sigma = G J^-2/3 dev B
    const T volumetric = T(0.5 * bulk_ / density_) * (j * j - T(1));  //         + K/2 (J^2-1) I
    tau = scale_shift(b, deviatoric, volumetric - T(1.0 / 3.0) * deviatoric * trace(b));
  }

  template <class Matrix, class Symmetric>
  double elastic_energy(const Matrix& f, const Symmetric&, double j) const {
    const double invariant = trace(left_cauchy_green(f)) / std::pow(j, 2.0 / 3.0);
    return (volume_energy(j, bulk_) + 0.5 * shear_ * (invariant - 3.0)) / density_;
  }

  /// Upper bound of the speed of small waves on the present state [m/s], exact without deviatoric stretch.
  template <class T, class Matrix, class Symmetric>
  T wave_speed(const Matrix& f, const Symmetric&, T j) const {
    const T root = inverse_cbrt(j), square = root * root;
    const Symmetric gb = scale_shift(left_cauchy_green(f), T(shear_) * square * square * root, T(0));
    return sqrt(stiffest_wave(gb, volume_stiffness(j, bulk_)) * j * T(1.0 / density_));
  }
  double density() const { return density_; }

  /// Stored energy per initial volume of all laws with this pressure: K/2 [(J^2 - 1)/2 - ln J] [Pa].
  static double volume_energy(double j, double bulk) { return 0.5 * bulk * (0.5 * (j * j - 1.0) - std::log(j)); }
  /// Contribution of this pressure to rho c^2 along a wave [Pa].
  template <class T>
  static T volume_stiffness(T j, double bulk) {
    return T(0.5 * bulk) * (j + T(1) / j);
  }

 private:
  double density_, bulk_, shear_;
};

}  // namespace mpm
