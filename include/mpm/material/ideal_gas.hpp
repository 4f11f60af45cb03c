// Ideal gas without viscosity: p = p0 (T/T0) / J, with p0 the pressure at the material's density and T0. Adiabatic: the
// temperature follows T = T_old (J_old/J)^(g-1) exactly, so p J^g is constant for any steps. Isothermal: T is constant.
// Of the deformation gradient only J is stored. Stress is the pressure above an ambient one that acts from outside and
// is not modelled; without it the gas is under its whole pressure from the start and flies apart where nothing holds
// it. Weak: pressure acts on every unevenness of the particles' positions and does work there that the energy, a
// function of volume, does not include. Sound in a closed box is stable with the ambient pressure subtracted and grows
// without end otherwise; gas that a piston compresses strongly becomes unstable in either case. No heat conduction, and
// no dissipation in a shock beyond that of the method itself. Energy is relative to the start at T0. Source: method
// reference 10.8.
#pragma once

#include <cmath>

#include "mpm/material/definition.hpp"
#include "mpm/material/increment.hpp"

namespace mpm {

class IdealGas : public LawDefaults {
 public:
  static constexpr Matter kMatter = Matter::gas;
  static constexpr bool kRateDependent = false;
  static constexpr bool kStiffnessOfPressure = true;
  static constexpr bool kForgetsShape = true;
  static constexpr bool kAveragesStress = false;
  static constexpr StressSource kStressFrom = StressSource::volume;
  static constexpr ImplicitSteps kImplicit = ImplicitSteps::refused;
  static constexpr int kHistory = 1;
  static constexpr int kTemperature = 0;

  IdealGas(const IdealGasDefinition& d, double density)
      : density_(density),
        temperature_(d.temperature),
        specific_pressure_(d.pressure / density),
        ratio_(d.heat_capacity_ratio),
        adiabatic_(d.process == GasProcess::adiabatic),
        specific_ambient_(d.ambient / density),
        capacity_(d.pressure / (density * d.temperature * (d.heat_capacity_ratio - 1.0))) {}

  template <class T, class Matrix, class Symmetric>
  void update(const Increment<T, Matrix>& step, Symmetric& tau, T* history) const {
    T& excess = history[kTemperature];
    if (adiabatic_) {
      const T temperature = (T(temperature_) + excess) * pow(step.j_old / step.j, T(ratio_ - 1.0));
      excess = temperature - T(temperature_);
    }
    // tau/rho0 = -(p - ambient) J / rho0
    const T pressure = T(specific_pressure_) + T(specific_pressure_ / temperature_) * excess;
    tau = Symmetric::isotropic(T(specific_ambient_) * step.j - pressure);
  }

  /// Adiabatic: internal energy c_v (T - T0). Isothermal: free energy, -(p J / rho0) ln J. In both, minus the work done
  /// against the ambient pressure.
  template <class Matrix, class Symmetric>
  double elastic_energy(const Matrix&, const Symmetric& tau, double j) const {
    const double pressure = whole_pressure(tau, j);
    const double inner = adiabatic_ ? (pressure - specific_pressure_) / (ratio_ - 1.0) : -pressure * std::log(j);
    return inner + specific_ambient_ * (j - 1.0);
  }

  /// c^2 = g p / rho, with g = 1 when isothermal.
  template <class T, class Matrix, class Symmetric>
  T wave_speed(const Matrix&, const Symmetric& tau, T j) const {
    return sqrt(T(adiabatic_ ? ratio_ : 1.0) * whole_pressure(tau, j));
  }
  /// tau/rho0 = -p J/rho0, in which p J is that of T alone.
  double warm(double by, double /*j*/, double* /*history*/) const { return -specific_pressure_ / temperature_ * by; }
  double heat_capacity() const { return capacity_; }
  double density() const { return density_; }
  double reference_temperature() const { return temperature_; }

 private:
  /// p J / rho0 [J/kg]
  template <class T, class Symmetric>
  T whole_pressure(const Symmetric& tau, T j) const {
    return T(specific_ambient_) * j - T(1.0 / 3.0) * trace(tau);
  }

  double density_, temperature_;
  double specific_pressure_;  ///< p0 / rho0 [J/kg]
  double ratio_;
  bool adiabatic_;
  double specific_ambient_;  ///< ambient pressure / rho0 [J/kg]
  double capacity_;          ///< [J/(kg K)]
};

}  // namespace mpm
