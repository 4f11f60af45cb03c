// Pressure of a solid under shock: the Mie-Grueneisen equation of state about a Hugoniot with shock speed C0 + S u_p,
// where u_p is the particle speed behind the shock. With eta = 1 - J and the specific internal energy e,
//
//   compression   p = rho0 C0^2 eta (1 - gamma0 eta/2) / (1 - S eta)^2 + gamma0 rho0 e
//   tension       p = rho0 C0^2 eta + gamma0 rho0 e
//
// On the Hugoniot, where e = p eta / (2 rho0), the pressure is rho0 C0^2 eta / (1 - S eta)^2. gamma rho is constant,
// gamma0 rho0.
//
// The formula has a pole at S eta = 1. Beyond S eta = kLargestCompression it is continued with its slope there, so that
// every J > 0 has a finite pressure and wave speed. Up to that point the law is the published one: the Hugoniot up to a
// particle speed of 4 C0/S, for steel 7 km/s and 1000 GPa.
//
// Weak: tension is unlimited (no spall); phase changes enter only where gamma0 and S are fitted across one. Source:
// method reference 10.3; Nairn & Guilkey (2015), Table I.
#pragma once

#include <algorithm>

#include "mpm/material/definition.hpp"
#include "mpm/math/lanes.hpp"

namespace mpm {

class MieGrueneisen {
 public:
  static constexpr double kLargestCompression = 0.8;  ///< S eta up to which the formula is used

  /// `density`: initial [kg/m^3]
  MieGrueneisen(const MieGrueneisenDefinition& d, double density)
      : stiffness_(density * d.sound_speed * d.sound_speed),
        slope_(d.hugoniot_slope),
        gamma_(d.gamma0),
        coupling_(d.gamma0 * density),
        volume_(1.0 / density),
        largest_(d.hugoniot_slope > 0.0 ? std::min(kLargestCompression / d.hugoniot_slope, 1.0) : 1.0) {}

  /// p [Pa] at J and specific internal energy [J/kg].
  template <class T>
  T pressure(T j, T energy) const {
    return cold_pressure(j) + T(coupling_) * energy;
  }

  /// Advances `pressure` [Pa] and `energy` [J/kg] from `j_old` to `j` with added `heat` [J/kg]:
  ///   e = e_old - (p_old + p)/2 (J - J_old)/rho0 + heat.
  /// Since p is linear in e, both are found in closed form. Second order in the change of J.
  template <class T>
  void advance(T j_old, T j, T heat, T& pressure, T& energy) const {
    const T half = T(0.5) * (j - j_old);
    const T known = energy + heat - pressure * half * T(volume_);
    pressure = (cold_pressure(j) + T(coupling_) * known) / (T(1) + T(gamma_) * half);
    energy = known - pressure * half * T(volume_);
  }

  /// Part of the pressure that an internal energy [J/kg] makes, at any J [Pa].
  double thermal_pressure(double energy) const { return coupling_ * energy; }

  /// T / T_old = exp(gamma0 (J_old - J)) of a change of volume without heat.
  template <class T>
  T isentropic_heating(T j_old, T j) const {
    return exp(T(gamma_) * (j_old - j));
  }

  /// Adiabatic bulk modulus -J dp/dJ [Pa] at J under `pressure`. At least 0: far in tension the isentrope falls again.
  template <class T>
  T bulk(T j, T pressure) const {
    const T modulus = j * (cold_slope(within(T(1) - j)) + T(gamma_) * pressure);
    return select(modulus < T(0), T(0), modulus);
  }

  /// Internal energy [J/kg] at J, from the pressure.
  double energy(double j, double pressure) const { return (pressure - cold_pressure(j)) / coupling_; }

 private:
  /// eta, limited to where the formula holds; 0 in tension.
  template <class T>
  T within(T eta) const {
    return max(min(eta, T(largest_)), T(0));
  }
  /// dp/d(eta) at constant energy [Pa].
  template <class T>
  T cold_slope(T eta) const {
    const T inverse = T(1) / (T(1) - T(slope_) * eta);
    return T(stiffness_) * (T(1) + T(slope_ - gamma_) * eta) * inverse * inverse * inverse;
  }
  /// p at e = 0 [Pa]: the formula, continued linearly beyond its ends.
  template <class T>
  T cold_pressure(T j) const {
    const T eta = T(1) - j, inner = within(eta);
    const T inverse = T(1) / (T(1) - T(slope_) * inner);
    const T formula = T(stiffness_) * inner * (T(1) - T(0.5 * gamma_) * inner) * inverse * inverse;
    return formula + cold_slope(inner) * (eta - inner);
  }

  double stiffness_;  ///< rho0 C0^2 [Pa]
  double slope_, gamma_;
  double coupling_;  ///< gamma0 rho0 [kg/m^3]
  double volume_;    ///< 1 / rho0 [m^3/kg]
  double largest_;   ///< eta up to which the formula is used
};

}  // namespace mpm
