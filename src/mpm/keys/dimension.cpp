#include "mpm/keys/dimension.hpp"

#include <fmt/format.h>

#include <array>

#include "mpm/math/constants.hpp"

namespace mpm {
namespace {

struct DimensionText {
  Dimension dimension;
  const char* noun;
  const char* example;
  const char* unit;
};
const std::array kDimensions = {
    DimensionText{kPlain, "a number without a unit", "0.3", ""},
    DimensionText{kLength, "a length", "10 mm", "m"},
    DimensionText{kArea, "an area", "1 cm^2", "m^2"},
    DimensionText{kMass, "a mass", "2 kg", "kg"},
    DimensionText{kTime, "a time", "0.2 s", "s"},
    DimensionText{kAngle, "an angle", "35 deg", "rad"},
    DimensionText{kRate, "a rate", "5 1/s", "1/s"},
    DimensionText{kAngularRate, "a rotation rate", "10 deg/s", "rad/s"},
    DimensionText{kVelocity, "a velocity", "1.7 km/s", "m/s"},
    DimensionText{kAcceleration, "an acceleration", "9.81 m/s^2", "m/s^2"},
    DimensionText{kAngularAcceleration, "a rotational acceleration", "90 deg/s^2", "rad/s^2"},
    DimensionText{kDensity, "a density", "1600 kg/m^3", "kg/m^3"},
    DimensionText{kPressure, "a pressure", "5 kPa", "Pa"},
    DimensionText{kToughness, "a fracture toughness", "2 MPa m^0.5", "Pa m^0.5"},
    DimensionText{kForce, "a force", "3 N", "N"},
    DimensionText{kEnergy, "an energy", "3 J", "J"},
    DimensionText{kPower, "a power", "3 W", "W"},
    DimensionText{kViscosity, "a viscosity", "1 Pa s", "Pa s"},
    DimensionText{kTemperature, "a temperature", "293 K", "K"},
    DimensionText{kSurfaceEnergy, "an energy over area", "8 J/m^2", "J/m^2"},
    DimensionText{kStiffness, "a pressure over length", "2 MPa/mm", "Pa/m"},
    DimensionText{kInertia, "a moment of inertia", "0.1 kg m^2", "kg m^2"},
    DimensionText{{0, 1, -3, 0, -1}, "a conductance of heat", "2000 W/(m^2 K)", "W/(m^2 K)"},
    DimensionText{{2, 1, -2, 0, -1}, "a heat capacity of a body", "12 J/K", "J/K"},
    DimensionText{{1, -1, 1, 0, 0}, "a speed over energy over area", "0.1 m^3/(J s)", "m^3/(J s)"},
    DimensionText{{-2, 0, 0, 0, 0}, "a number over area", "100 1/m^2", "1/m^2"},
    DimensionText{kHeatCapacity, "a heat capacity", "450 J/(kg K)", "J/(kg K)"},
};

std::string base_units(const Dimension& dimension) {
  std::string text;
  const auto add = [&text](const char* name, double exponent) {
    if (exponent == 0.0) return;
    if (!text.empty()) text += ' ';
    text += exponent == 1.0 ? std::string(name) : fmt::format("{}^{:g}", name, exponent);
  };
  add("m", dimension.length);
  add("kg", dimension.mass);
  add("s", dimension.time);
  add("rad", dimension.angle);
  add("K", dimension.temperature);
  return text;
}

}  // namespace

std::string describe(const Dimension& dimension) {
  for (const DimensionText& known : kDimensions) {
    if (known.dimension == dimension) return known.noun;
  }
  return "a quantity in " + base_units(dimension);
}

std::string example(const Dimension& dimension) {
  for (const DimensionText& known : kDimensions) {
    if (known.dimension == dimension) return known.example;
  }
  return "1 " + base_units(dimension);
}

std::string quantity_text(double value, const Dimension& dimension) {
  if (dimension == kAngle) return value == 0.0 ? "0" : fmt::format("{:g} deg", value / kPi * 180.0);
  std::string unit = base_units(dimension);
  for (const DimensionText& known : kDimensions) {
    if (known.dimension == dimension) unit = known.unit;
  }
  return value == 0.0 || unit.empty() ? fmt::format("{:g}", value) : fmt::format("{:g} {}", value, unit);
}

}  // namespace mpm
