// Viscoelastic solid for foam and tissue, the standard linear solid at finite strain: the neo-Hookean solid of the
// long-term constants, parallel to one Maxwell branch, a spring of shear modulus G1 in series with a dashpot,
//
//   tau = K/2 (J^2 - 1) I + G dev B* + G1 dev b,   b stretched with the material, dev b' = -dev b / T
//
// with B* = J^(-2/3) F F^T and b isochoric (isochoric.hpp). Half of the relaxation of a step takes place before its
// stretch and half after it: second order in the step, stable for any step, and exact while strain is constant. Volume
// does not relax. b follows from the stress in excess of the long-term spring, so none is stored; the energy that the
// branch loses counts as dissipated. Weak: one relaxation time; isothermal. Source: Reese & Govindjee (1998), Int. J.
// Solids Struct. 35, for the decomposition; theirs relaxes logarithmic strain, which is the same to first order in the
// branch's strain.
#pragma once

#include "mpm/material/definition.hpp"
#include "mpm/material/increment.hpp"
#include "mpm/material/isochoric.hpp"
#include "mpm/material/neo_hookean.hpp"

namespace mpm {

class StandardLinearSolid : public LawDefaults {
 public:
  static constexpr Matter kMatter = Matter::solid;
  static constexpr bool kRateDependent = true;
  static constexpr bool kStiffnessOfPressure = false;
  static constexpr bool kForgetsShape = false;
  static constexpr bool kAveragesStress = false;
  static constexpr StressSource kStressFrom = StressSource::deformation;
  static constexpr ImplicitSteps kImplicit = ImplicitSteps::refused;
  static constexpr int kHistory = 1;
  static constexpr int kPlasticWork = 0;  ///< energy lost in the dashpot

  StandardLinearSolid(const StandardLinearSolidDefinition& d, double density)
      : density_(density),
        bulk_(d.elasticity.bulk()),
        shear_(d.elasticity.shear()),
        branch_(d.branch_modulus),
        relaxation_time_(d.relaxation_time) {}

  template <class T, class Matrix, class Symmetric>
  void update(const Increment<T, Matrix>& step, Symmetric& tau, T* history) const {
    const T ratio = step.j / step.j_old;
    const Matrix f_old = product(inverse(step.df, ratio), step.f);
    const T half = exp(T(-0.5 / relaxation_time_) * step.dt);
    Symmetric branch = branch_deviator(isochoric_deviator(f_old, step.j_old), tau);
    T lost = isochoric_excess(branch);
    branch = scale_shift(branch, half, T(0));
    const T relaxed = isochoric_excess(branch);
    branch = stretch_isochoric(step.df, ratio, branch, relaxed);
    lost += isochoric_excess(branch) - relaxed;
    branch = scale_shift(branch, half, T(0));
    lost -= isochoric_excess(branch);
    history[kPlasticWork] += T(1.5 * branch_ / density_) * lost;
    const T volumetric = T(0.5 * bulk_ / density_) * (step.j * step.j - T(1));
    tau = sum(scale_shift(isochoric_deviator(step.f, step.j), T(shear_ / density_), volumetric),
              scale_shift(branch, T(branch_ / density_), T(0)));
  }

  template <class Matrix, class Symmetric>
  double elastic_energy(const Matrix& f, const Symmetric& tau, double j) const {
    const Symmetric deviator = isochoric_deviator(f, j);
    const double shear = shear_ * isochoric_excess(deviator);
    const double branch = branch_ * isochoric_excess(branch_deviator(deviator, tau));
    return (NeoHookean::volume_energy(j, bulk_) + 1.5 * (shear + branch)) / density_;
  }

  /// Wave speed of the response without relaxation.
  template <class T, class Matrix, class Symmetric>
  T wave_speed(const Matrix& f, const Symmetric& tau, T j) const {
    const Symmetric strain = left_cauchy_green(f);
    const T root = inverse_cbrt(j), scale = root * root, mean = T(1.0 / 3.0) * scale * trace(strain);
    const T excess = isochoric_excess(branch_deviator(scale_shift(strain, scale, -mean), tau));
    // The deviators of the two springs add up to that of tau.
    const T inverse = T(1) / j, stress = T(density_) * inverse;
    const T means = (T(shear_) * mean + T(branch_) * (T(1) + excess)) * inverse;
    const Symmetric gb = scale_shift(tau, stress, means - T(1.0 / 3.0) * stress * trace(tau));
    return sqrt(stiffest_wave(gb, NeoHookean::volume_stiffness(j, bulk_)) * j * T(1.0 / density_));
  }
  double density() const { return density_; }

 private:
  template <class Symmetric>
  Symmetric branch_deviator(const Symmetric& long_term, const Symmetric& tau) const {
    using T = decltype(trace(tau));
    const T scale = T(density_ / branch_);
    return sum(scale_shift(tau, scale, T(-1.0 / 3.0) * scale * trace(tau)),
               scale_shift(long_term, T(-shear_ / branch_), T(0)));
  }

  double density_, bulk_, shear_;
  double branch_;           ///< G1 [Pa]
  double relaxation_time_;  ///< [s]
};

}  // namespace mpm
