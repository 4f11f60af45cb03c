// One increment of deformation, the input of a law; what a law says of itself, and the defaults of what only some laws
// have.
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

enum class Matter { solid, soil, liquid, gas };

/// The variables from which a law computes its stress: it advances the one that it had; finds the pressure from J and
/// advances the deviator; or finds all from J, or from F.
enum class StressSource { stress, volume_and_stress, volume, deformation };
constexpr bool finds_pressure(StressSource source) {
  return source == StressSource::volume_and_stress || source == StressSource::volume;
}

/// Implicit steps (implicit/soil_law.hpp): a law that has none of its own is refused, and `method: auto` takes those in
/// which forces on tools were measured.
enum class ImplicitSteps { refused, possible, measured };

/// Facts about a law, for those who ask: a constant kMatter, kRateDependent and so on of each law. None has a default,
/// so that a law which does not say it does not compile.
struct LawTraits {
  /// Soil is grains that rub, whose flow sheds noise (calm() in sections/method_section.cpp).
  Matter matter;
  bool rate_dependent;         ///< stress depends on the rate of strain
  bool stiffness_of_pressure;  ///< stiffness follows the pressure, so that it has none of its own
  /// Only J of the deformation gradient matters, so that it is stored as a pure change of volume. A fluid shears
  /// without end, and det F of its whole deformation would be a small difference of large numbers.
  bool forgets_shape;
  /// Particles of a cell that flow may share one stress (mechanics/stress_average.hpp): the law has a plastic strain,
  /// keeps the stress or finds it from J, and its elastic_energy() does not ask for F.
  bool averages_stress;
  /// Particles of a law that finds its pressure from J share in tension, too: it does not open as soil.
  StressSource stress_from;
  ImplicitSteps implicit;
  bool flows;            ///< deforms without end: fluids, and what has a plastic strain
  bool own_temperature;  ///< has a temperature in its history
  bool listed = true;    ///< one of the library's own, whose figures stand in its pages

  bool fluid() const { return matter == Matter::liquid || matter == Matter::gas; }
};

template <class OneLaw>
constexpr LawTraits kTraitsOf{
    OneLaw::kMatter,
    OneLaw::kRateDependent,
    OneLaw::kStiffnessOfPressure,
    OneLaw::kForgetsShape,
    OneLaw::kAveragesStress,
    OneLaw::kStressFrom,
    OneLaw::kImplicit,
    OneLaw::kPlasticStrain >= 0 || OneLaw::kMatter == Matter::liquid || OneLaw::kMatter == Matter::gas,
    OneLaw::kTemperature >= 0};

/// State at which a law is asked for the elastic part of a strain.
struct StressedPoint {
  Symmetric3<double> cauchy;  ///< [Pa]
  Symmetric3<double> tau;     ///< Kirchhoff stress over initial density [J/kg]
  Symmetric3<double> total;   ///< logarithmic strain of F
  double j;
};

/// Defaults of the constants and functions that law.hpp asks for and that not all laws have; a law derives from this
/// and hides those that it defines itself.
struct LawDefaults {
  static constexpr int kHistory = 0;         ///< number of history scalars per particle, all zero at the start
  static constexpr int kPlasticStrain = -1;  ///< index of the equivalent plastic strain [-], or -1
  static constexpr int kPlasticWork = -1;    ///< index of the dissipated work [J/kg], or -1
  static constexpr int kTemperature = -1;    ///< index of temperature minus reference temperature [K], or -1
  static constexpr int kHardening = -1;      ///< index of what initial_hardening() gives, or -1
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
  /// Elastic part of the strain, logarithmic; of laws that do not flow all of it.
  Symmetric3<double> elastic_strain(const StressedPoint& at) const { return at.total; }
  /// Heat capacity at constant volume of a law with a temperature [J/(kg K)].
  double heat_capacity() const { return 0.0; }
  /// Follows heat from outside, by which the temperature of a law that has one rises by `by` [K] at volume ratio `j`:
  /// writes the other scalars of history and returns by how much the mean of tau changes [J/kg].
  double warm(double /*by*/, double /*j*/, double* /*history*/) const { return 0.0; }
  /// Temperature to which the temperature in history is relative [K].
  double reference_temperature() const { return 0.0; }
};

}  // namespace mpm
