// One increment of deformation, the input of a law, and the defaults of what a law declares.
#pragma once

#include "mpm/math/tensor.hpp"

namespace mpm {

/// Deformation from the start to the end of an increment. The references are valid during the call only.
template <class T, class Matrix>
struct Increment {
  const Matrix& du;  ///< grad v dt
  const Matrix& df;  ///< exp(du): F = df F_old
  const Matrix& f;   ///< deformation gradient at the end
  T j_old;           ///< det F at the start
  T j;               ///< det F at the end
  T dt;              ///< [s]
};

/// Defaults of the constants and functions that law.hpp asks for; a law derives from this and hides those that it
/// defines itself.
struct LawTraits {
  static constexpr int kHistory = 0;         ///< number of history scalars per particle, all zero at the start
  static constexpr int kPlasticStrain = -1;  ///< index of the equivalent plastic strain [-], or -1
  static constexpr int kPlasticWork = -1;    ///< index of the dissipated work [J/kg], or -1
  static constexpr int kTemperature = -1;    ///< index of temperature minus reference temperature [K], or -1
  static constexpr int kHardening = -1;      ///< index of what initial_hardening() gives, or -1
  /// True if only J of the deformation gradient matters, so that it is stored as a pure change of volume. A fluid
  /// shears without end, and det F of its whole deformation would be a small difference of large numbers.
  static constexpr bool kForgetsShape = false;
  /// True for a law of soil: grains that rub, whose flow sheds noise (calm() in scene/method_section.cpp).
  static constexpr bool kSoil = false;
  /// True if particles of a cell that flow may share one stress (mechanics/stress_average.hpp): the law has a plastic
  /// strain, keeps the stress or finds it from J, and its elastic_energy() does not ask for F.
  static constexpr bool kAveragesStress = false;
  /// True if such a law finds the pressure from J. Its particles then share in tension, too: it does not open as soil.
  static constexpr bool kPressureFromVolume = false;
  /// Largest kinematic viscosity for any motion at the present J [m^2/s].
  template <class T>
  T diffusivity(T) const {
    return T(0);
  }
  /// The part of the dissipated work that elastic_energy() includes, as heat; the stored energy is elastic_energy()
  /// minus this part.
  double heat_fraction() const { return 0.0; }
  /// The history scalar kHardening of a particle that starts under this Cauchy stress [Pa].
  double initial_hardening(const Symmetric3<double>&) const { return 0.0; }
  /// Temperature to which the temperature in history is relative [K].
  double reference_temperature() const { return 0.0; }
};

}  // namespace mpm
