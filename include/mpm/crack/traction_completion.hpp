// A law of tractions from the numbers that a scene gives of it: the others follow from those that suffice.
// Source: crack reference 5.5, its table; NairnMPM's manual, Traction Laws.
#pragma once

#include <optional>

#include "mpm/crack/traction_law_definition.hpp"

namespace mpm {

/// Up to this part of its opening a triangular law is elastic if nothing is said: so its work comes closest to a cubic
/// law's.
inline constexpr double kTriangularElasticPart = 0.225926299;

/// One direction of a law. What is not given is left out.
struct GivenTraction {
  std::optional<double> toughness;     ///< G_c [J/m^2]
  std::optional<double> strength;      ///< sigma [Pa]
  std::optional<double> opening;       ///< u_c, at failure [m]
  std::optional<double> stiffness;     ///< k, of the elastic part [Pa/m]
  std::optional<double> elastic;       ///< u_e, up to which it is elastic [m]
  std::optional<double> elastic_part;  ///< the same over u_c [1]
};

/// One direction of a trilinear law: (0, 0), (elastic, strength), (elastic_2, strength_2), (opening, 0).
struct GivenTrilinear {
  std::optional<double> strength, elastic;      ///< first corner [Pa], [m]
  std::optional<double> strength_2, elastic_2;  ///< second corner [Pa], [m]
  std::optional<double> opening;                ///< at failure [m]
  std::optional<double> toughness;              ///< [J/m^2]
  std::optional<double> stiffness;              ///< in place of one number of the first corner [Pa/m]
};

/// Completes a law from exactly two of toughness, strength and opening, and at most one of stiffness, elastic and
/// elastic_part.
/// @throws CrackError for too few or too many numbers, and for those that no curve has
TractionMode complete_triangular(const GivenTraction& given);
/// Completes a law from exactly two of toughness, strength and opening. @throws CrackError as above
TractionMode complete_cubic(const GivenTraction& given);
/// Completes a law from toughness or opening, and two of strength, stiffness and one elastic opening.
/// @throws CrackError as above
TractionMode complete_exponential(const GivenTraction& given, double decay);
/// Completes a law from five of the six numbers. @throws CrackError as above
TractionMode complete_trilinear(const GivenTrilinear& given);

}  // namespace mpm
