// Ideal gas without viscosity: p = p0 (T/T0) / J, with p0 the pressure at the material's density and T0. Adiabatic: the
// temperature follows T = T_old (J_old/J)^(g-1) exactly, so p J^g stays what it was whatever the steps; isothermal: T
// is kept. Only J of the deformation gradient is kept. It is under pressure from the start and fills what holds it:
// without walls, tools or other material around it, it flies apart. Weak: no heat conduction, and no dissipation in a
// shock: the method's own alone gives it its entropy. Energy counts from the start at T0. Source: method
// reference 10.8.
#pragma once

#include <cmath>

#include "mpm/material/definition.hpp"
#include "mpm/material/increment.hpp"

namespace mpm {

class IdealGas : public LawTraits {
 public:
  static constexpr int kHistory = 1;
  static constexpr int kTemperature = 0;
  static constexpr bool kForgetsShape = true;

  IdealGas(const IdealGasDefinition& d, double density)
      : density_(density),
        temperature_(d.temperature),
        specific_pressure_(d.pressure / density),
        ratio_(d.heat_capacity_ratio),
        adiabatic_(d.process == GasProcess::adiabatic) {}

  template <class T, class Matrix, class Symmetric>
  void update(const Increment<T, Matrix>& step, Symmetric& tau, T* const* history, int p) const {
    T& excess = history[kTemperature][p];
    if (adiabatic_) {
      const T temperature = (T(temperature_) + excess) * std::pow(step.j_old / step.j, T(ratio_ - 1.0));
      excess = temperature - T(temperature_);
    }
    // tau/rho0 = -p J / rho0
    const T pressure = T(specific_pressure_) * (T(1) + excess / T(temperature_));
    tau = scale_shift(tau, T(0), -pressure);
  }

  /// Adiabatic: internal energy c_v (T - T0). Isothermal: free energy, -(p J / rho0) ln J.
  template <class Matrix, class Symmetric>
  double elastic_energy(const Matrix&, const Symmetric& tau, double j) const {
    const double pressure = -trace(tau) / 3.0;
    return adiabatic_ ? (pressure - specific_pressure_) / (ratio_ - 1.0) : -pressure * std::log(j);
  }

  /// c^2 = g p / rho, with g = 1 when isothermal.
  double wave_speed(const Matrix3<double>&, const Symmetric3<double>& tau, double) const {
    return std::sqrt((adiabatic_ ? ratio_ : 1.0) * -trace(tau) / 3.0);
  }
  double density() const { return density_; }
  double reference_temperature() const { return temperature_; }

 private:
  double density_, temperature_;
  double specific_pressure_;  ///< p0 / rho0 [J/kg]
  double ratio_;
  bool adiabatic_;
};

}  // namespace mpm
