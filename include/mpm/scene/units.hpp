// Units: quantities as text ("2300 MPa"), consistent unit systems, and the dimension that a key expects.
#pragma once

#include <string>

#include "mpm/math/error.hpp"

namespace mpm {

/// Thrown for a quantity, unit or unit system that is not understood, or has another dimension than expected.
class UnitError : public Error {
 public:
  using Error::Error;
};

/// Exponents of the base dimensions, whole numbers and halves (a toughness is in MPa m^0.5). Angle is one of them, so
/// that degrees are refused where a plain number is expected.
struct Dimension {
  double length = 0;
  double mass = 0;
  double time = 0;
  double angle = 0;
  double temperature = 0;
  friend bool operator==(const Dimension& a, const Dimension& b) {
    return a.length == b.length && a.mass == b.mass && a.time == b.time && a.angle == b.angle &&
           a.temperature == b.temperature;
  }
};

inline constexpr Dimension kPlain{};
inline constexpr Dimension kLength{1, 0, 0, 0};
inline constexpr Dimension kArea{2, 0, 0, 0};
inline constexpr Dimension kMass{0, 1, 0, 0};
inline constexpr Dimension kTime{0, 0, 1, 0};
inline constexpr Dimension kAngle{0, 0, 0, 1};
inline constexpr Dimension kRate{0, 0, -1, 0};
inline constexpr Dimension kAngularRate{0, 0, -1, 1};
inline constexpr Dimension kAngularAcceleration{0, 0, -2, 1};
inline constexpr Dimension kVelocity{1, 0, -1, 0};
inline constexpr Dimension kAcceleration{1, 0, -2, 0};
inline constexpr Dimension kDensity{-3, 1, 0, 0};
inline constexpr Dimension kForce{1, 1, -2, 0};
inline constexpr Dimension kEnergy{2, 1, -2, 0};
inline constexpr Dimension kPressure{-1, 1, -2, 0};
inline constexpr Dimension kViscosity{-1, 1, -1, 0};
inline constexpr Dimension kTemperature{0, 0, 0, 0, 1};
inline constexpr Dimension kHeatCapacity{2, 0, -2, 0, -1};
inline constexpr Dimension kPerKelvin{0, 0, 0, 0, -1};
inline constexpr Dimension kPerPascal{1, -1, 2, 0, 0};
inline constexpr Dimension kToughness{-0.5, 1, -2, 0};   ///< toughness of fracture, K
inline constexpr Dimension kSurfaceEnergy{0, 1, -2, 0};  ///< energy over area, J and G

/// A dimension in words: "a pressure", "a length"; for a dimension without a name "a quantity in m^2/s".
std::string describe(const Dimension& dimension);
/// An example of a quantity of this dimension: "5 kPa".
std::string example(const Dimension& dimension);

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
