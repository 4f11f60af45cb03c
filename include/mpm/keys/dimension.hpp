// The dimension of a number in a scene, and how it is spoken of.
#pragma once

#include <string>

namespace mpm {

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
inline constexpr Dimension kPower{2, 1, -3, 0};
inline constexpr Dimension kPressure{-1, 1, -2, 0};
inline constexpr Dimension kViscosity{-1, 1, -1, 0};
inline constexpr Dimension kTemperature{0, 0, 0, 0, 1};
inline constexpr Dimension kHeatCapacity{2, 0, -2, 0, -1};
inline constexpr Dimension kPerKelvin{0, 0, 0, 0, -1};
inline constexpr Dimension kPerPascal{1, -1, 2, 0, 0};
inline constexpr Dimension kInertia{2, 1, 0, 0};
inline constexpr Dimension kTorque{2, 1, -2, 0};
inline constexpr Dimension kStiffness{-2, 1, -2, 0};     ///< traction over displacement
inline constexpr Dimension kToughness{-0.5, 1, -2, 0};   ///< toughness of fracture, K
inline constexpr Dimension kSurfaceEnergy{0, 1, -2, 0};  ///< energy over area, J and G

/// A dimension in words: "a pressure", "a length"; for a dimension without a name "a quantity in m^2/s".
std::string describe(const Dimension& dimension);
/// An example of a quantity of this dimension: "5 kPa".
std::string example(const Dimension& dimension);
/// A number [SI] with its unit: "5000 Pa"; an angle in degrees. 0 and numbers without dimension have none.
std::string quantity_text(double value, const Dimension& dimension);

}  // namespace mpm
