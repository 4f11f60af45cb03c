// Units: quantities as text ("2300 MPa") and consistent unit systems.
#pragma once

#include <string>

#include "mpm/keys/dimension.hpp"
#include "mpm/math/error.hpp"

namespace mpm {

/// Thrown for a quantity, unit or unit system that is not understood, or has another dimension than expected.
class UnitError : public Error {
 public:
  using Error::Error;
};

/// A unit: factor to SI and dimension.
struct Unit {
  double factor = 1.0;
  Dimension dimension;
};
/// Parses a unit such as "MPa", "g/cm^3", "kg/(m*s^2)", "1/s", "MPa m^0.5", "MPa sqrt(m)", "MPa√m". @throws UnitError
/// naming the unknown part.
Unit parse_unit(const std::string& text);

/// The units of a scene's plain numbers, as factors to SI. Angles are always radians, temperatures kelvins.
struct UnitSystem {
  double length = 1.0;  ///< [m]
  double mass = 1.0;    ///< [kg]
  double time = 1.0;    ///< [s]
  std::string name = "si";
  double factor(const Dimension& dimension) const;
};
/// Parses "si", or a consistent system by its length, mass and time: "mm-g-s", "mm-t-s", "cm-g-us", … @throws UnitError
UnitSystem parse_unit_system(const std::string& name);
/// @throws UnitError when one of the three is not a length, a mass or a time.
UnitSystem make_unit_system(const std::string& length, const std::string& mass, const std::string& time);

/// True if `text` is a number, alone or followed by something that may be a unit; sets `value` and `rest`.
bool split_number(const std::string& text, double& value, std::string& rest);
/// Converts a plain number in `system`, or a number with a unit, to SI.
/// @throws UnitError when it is neither, is not finite, or has another dimension than expected.
double parse_quantity(const std::string& text, const Dimension& expected, const UnitSystem& system = {});

}  // namespace mpm
