// Weakly compressible Newtonian fluid: pressure by Tait's equation p = K/n (J^-n - 1), n = 7 for water, 1 for a linear
// law, and viscous stress 2 mu dev(d), where d is the rate of deformation over the step. Of the deformation gradient
// only J is stored. Without tension (a free surface) p is cut off at zero: spray expands freely, and carries pressure
// again only at its initial density. What has parted (J > 1) is liquid of its initial density with empty space around
// it, and viscous stress acts on the liquid's volume alone: else a drop that flies apart would get ever more viscous.
// Viscous work counts as dissipated. Weak: J of each particle is an integral of grad v and drifts from the particles'
// real spacing, which mechanics/volume_correction.hpp mends; a lower bulk modulus than the real one is usual, and the
// user must keep its Mach number small. Source: Monaghan (1994), J. Comput. Phys. 110 (Tait's form).
#pragma once

#include <cmath>

#include "mpm/material/definition.hpp"
#include "mpm/material/increment.hpp"

namespace mpm {

class NewtonianFluid : public LawDefaults {
 public:
  static constexpr Matter kMatter = Matter::liquid;
  static constexpr bool kRateDependent = true;
  static constexpr bool kStiffnessOfPressure = false;
  static constexpr bool kForgetsShape = true;
  static constexpr bool kAveragesStress = false;
  static constexpr StressSource kStressFrom = StressSource::volume;
  static constexpr ImplicitSteps kImplicit = ImplicitSteps::refused;
  static constexpr int kHistory = 1;
  static constexpr int kPlasticWork = 0;  ///< work of the viscous stress

  NewtonianFluid(const NewtonianFluidDefinition& d, double density)
      : density_(density), bulk_(d.bulk_modulus), exponent_(d.exponent), viscosity_(d.viscosity), tension_(d.tension) {
    if (d.exponent <= kMostProducts && d.exponent == std::floor(d.exponent))
      whole_exponent_ = static_cast<int>(d.exponent);
  }

  template <class T, class Matrix, class Symmetric>
  void update(const Increment<T, Matrix>& step, Symmetric& tau, T* history) const {
    const T inverse = T(1) / step.j;
    const T power = whole_exponent_ > 0 ? whole_power(inverse, whole_exponent_) : pow(inverse, T(exponent_));
    T pressure = T(bulk_ / exponent_) * (power - T(1));
    if (!tension_) pressure = max(pressure, T(0));
    const T volume = liquid(step.j) * T(1.0 / density_);  // [m^3/kg]
    if (viscosity_ == 0.0) {
      tau = Symmetric::isotropic(-pressure * volume);
      return;
    }
    const Symmetric strain = symmetric_part(step.du);
    const T twice_viscosity = T(2.0 * viscosity_) / step.dt;
    const T mean = T(1.0 / 3.0) * trace(strain);
    tau = scale_shift(strain, twice_viscosity * volume, -(twice_viscosity * mean + pressure) * volume);
    const T mean_volume = T(0.5 / density_) * (liquid(step.j_old) + liquid(step.j));
    history[kPlasticWork] += twice_viscosity * mean_volume * (squared_norm(strain) - T(3) * mean * mean);
  }

  /// -integral of p dJ from J = 1 [J/kg].
  template <class Matrix, class Symmetric>
  double elastic_energy(const Matrix&, const Symmetric&, double j) const {
    if (!tension_ && j > 1.0) return 0.0;
    const double logarithm = std::log(j), power = 1.0 - exponent_;
    const double expansion = power == 0.0 ? logarithm : std::expm1(power * logarithm) / power;
    return bulk_ / exponent_ * ((j - 1.0) - expansion) / density_;
  }

  /// Speed of pressure waves. Where tension is cut off there is none, and the speed at the fluid's initial density
  /// stands in, because the fluid may close again.
  template <class T, class Matrix, class Symmetric>
  T wave_speed(const Matrix&, const Symmetric&, T j) const {
    const T closed = liquid(j);
    const T power = whole_exponent_ == 1  ? T(1)
                    : whole_exponent_ > 1 ? whole_power(T(1) / closed, whole_exponent_ - 1)
                                          : pow(closed, T(1.0 - exponent_));
    return sqrt(T(bulk_ / density_) * power);
  }
  /// Diffusivity of longitudinal motion, the largest [m^2/s].
  template <class T>
  T diffusivity(T j) const {
    return T(4.0 / 3.0 * viscosity_ / density_) * liquid(j);
  }
  double density() const { return density_; }

 private:
  /// Volume of the liquid over its initial one.
  template <class T>
  T liquid(T j) const {
    return tension_ ? j : select(j > T(1), T(1), j);
  }

  static constexpr double kMostProducts = 64.0;  ///< largest exponent whose power is computed by products

  double density_, bulk_, exponent_, viscosity_;
  int whole_exponent_ = 0;  ///< the exponent if it is a whole number, else 0
  bool tension_;
};

}  // namespace mpm
