// One increment of deformation as a law sees it, and what a law has unless it says otherwise.
#pragma once

#include "mpm/math/tensor.hpp"

namespace mpm {

/// From the state at its start to the one at its end. References live as long as the call.
template <class T, class Matrix>
struct Increment {
  const Matrix& du;  ///< grad v dt
  const Matrix& df;  ///< exp(du): F = df F_old
  const Matrix& f;   ///< deformation gradient at the end
  T j_old;           ///< det F at the start
  T j;               ///< det F at the end
  T dt;              ///< [s]
};

/// Defaults of the constants and functions that law.hpp asks for; a law derives from this and hides what it has.
struct LawTraits {
  static constexpr int kHistory = 0;         ///< scalars of history a particle, all zero at the start
  static constexpr int kPlasticStrain = -1;  ///< which of them is the equivalent plastic strain [-]
  static constexpr int kPlasticWork = -1;    ///< which of them is the dissipated work [J/kg]
  static constexpr int kTemperature = -1;    ///< which of them is the temperature less the reference one [K]
  /// Whether only J of the deformation gradient matters, so that it is kept as a pure change of volume: a fluid shears
  /// without end, and det F of what it has gone through would be a small difference of large numbers.
  static constexpr bool kForgetsShape = false;
  /// Largest kinematic viscosity for any motion, of the present J [m^2/s].
  template <class T>
  T diffusivity(T) const {
    return T(0);
  }
  /// Part of the dissipated work that elastic_energy() holds too, as heat: what is stored is elastic_energy() less it.
  double heat_fraction() const { return 0.0; }
  /// Temperature that history counts from [K].
  double reference_temperature() const { return 0.0; }
};

}  // namespace mpm
