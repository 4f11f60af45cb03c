// Quantities and unit systems. Factors: SI brochure (9th edition) and, for inch and pound, NIST SP 811 appendix B.
#include "mpm/yaml/units.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace mpm {
namespace units_test {

// Round-off of a few operations.
constexpr double kRoundOff = 1e-14;

void expect_si(const std::string& text, const Dimension& dimension, double expected) {
  EXPECT_NEAR(parse_quantity(text, dimension), expected, kRoundOff * std::abs(expected)) << text;
}

std::string refusal(const std::string& text, const Dimension& dimension) {
  try {
    parse_quantity(text, dimension);
  } catch (const UnitError& error) {
    return error.what();
  }
  return "";
}

TEST(Units, QuantitiesBecomeSi) {
  expect_si("2300 MPa", kPressure, 2.3e9);
  expect_si("5kPa", kPressure, 5e3);
  expect_si("1 psi", kPressure, 6894.757293168361);
  expect_si("35 deg", kAngle, 35.0 * M_PI / 180.0);
  expect_si("10 mm", kLength, 0.01);
  expect_si("1 in", kLength, 0.0254);
  expect_si("0.2 s", kTime, 0.2);
  expect_si("3 us", kTime, 3e-6);
  expect_si("1.7 km/s", kVelocity, 1700.0);
  expect_si("2.7 g/cm^3", kDensity, 2700.0);
  expect_si("9.81 m/s^2", kAcceleration, 9.81);
  expect_si("1600 kg/m3", kDensity, 1600.0);
  expect_si("9.81 m s^-2", kAcceleration, 9.81);
  expect_si("5 kg/(m*s^2)", kPressure, 5.0);
  expect_si("5 kg/m/s^2", kPressure, 5.0);
  expect_si("4 N/mm^2", kPressure, 4e6);
  expect_si("20 1/s", kRate, 20.0);
  expect_si("20 /s", kRate, 20.0);
  expect_si("90 deg/s", kAngularRate, M_PI / 2.0);
  expect_si("30 %", kPlain, 0.3);
  expect_si("293.15 K", kTemperature, 293.15);
  expect_si("1e-3 Pa s", kViscosity, 1e-3);
  expect_si("2 kg/(m*s)", kViscosity, 2.0);
  expect_si("1 cP", kViscosity, 1e-3);  // viscosity of water
  expect_si("2 P", kViscosity, 0.2);
  expect_si("3 uJ", kEnergy, 3e-6);
  expect_si("5 nW", {2, 1, -3}, 5e-9);
  expect_si("-1e-3 m", kLength, -1e-3);
  expect_si("+2", kPlain, 2.0);
}

// Nairn, GIMP notes, tables 7.1 and 7.3: a fracture toughness of 1 MPa sqrt(m) is 1e6 N/m^(3/2).
TEST(Units, RootsAreHalfExponents) {
  constexpr Dimension kToughness{-0.5, 1, -2};
  for (const char* text : {"1 MPa m^0.5", "1 MPa*m^0.5", "1 MPa sqrt(m)", "1MPa√m", "1 MPa √(m)", "1 MN/m^1.5",
                           "1 N/(mm sqrt(m))*1", "1 MPa m/√m"}) {
    expect_si(text, kToughness, text == std::string("1 N/(mm sqrt(m))*1") ? 1e3 : 1e6);
  }
  expect_si("2 sqrt(MPa^2 mm)", kToughness, 2e6 * std::sqrt(1e-3));
  expect_si("4 sqrt(m^2)", kLength, 4.0);
  // A plain number in mm-g-s: 1 g^1 mm^-1/2 s^-2.
  EXPECT_NEAR(parse_quantity("1", kToughness, parse_unit_system("mm-g-s")), 1e-3 / std::sqrt(1e-3), kRoundOff);
  EXPECT_EQ(refusal("1 MPa m^0.5", kPressure),
            "'1 MPa m^0.5' is a fracture toughness, but a pressure is expected; write one such as 5 kPa");
  EXPECT_EQ(refusal("1 m^1.5", kLength),
            "'1 m^1.5' is a quantity in m^1.5, but a length is expected; write one such as 10 mm");
}

TEST(Units, PlainNumbersAreInTheSceneSystem) {
  // Nairn, GIMP notes, tables 7.1 and 7.3: mm-g-s has force in uN, pressure in Pa; mm-t-s has pressure in MPa; cm-g-us
  // has pressure in 100 GPa (Mbar), velocity in 10 km/s.
  const auto si = [](const char* system, const Dimension& dimension) {
    return parse_quantity("1", dimension, parse_unit_system(system));
  };
  EXPECT_NEAR(si("mm-g-s", kPressure), 1.0, kRoundOff);
  EXPECT_NEAR(si("mm-g-sec", kDensity), 1e6, 1e6 * kRoundOff);
  EXPECT_NEAR(si("mm-t-s", kPressure), 1e6, 1e6 * kRoundOff);
  EXPECT_NEAR(si("mm-t-s", kDensity), 1e12, 1e12 * kRoundOff);
  EXPECT_NEAR(si("cm-g-us", kPressure), 1e11, 1e11 * kRoundOff);
  EXPECT_NEAR(si("cm-g-us", kVelocity), 1e4, 1e4 * kRoundOff);
  EXPECT_NEAR(si("cm-g-s", kPressure), 0.1, kRoundOff);
  EXPECT_EQ(si("m-kg-s", kPressure), 1.0);
  EXPECT_EQ(si("mm-g-s", kAngle), 1.0);
  EXPECT_EQ(si("mm-g-s", kTemperature), 1.0);
  EXPECT_NEAR(si("mm-g-s", kViscosity), 1.0, kRoundOff);
  // A written unit does not depend on the system.
  EXPECT_NEAR(parse_quantity("2 m", kLength, parse_unit_system("mm-g-s")), 2.0, kRoundOff);
}

TEST(Units, AWrongDimensionNamesWhatWasExpected) {
  EXPECT_EQ(refusal("2 m", kPressure), "'2 m' is a length, but a pressure is expected; write one such as 5 kPa");
  EXPECT_EQ(refusal("35 deg", kPlain),
            "'35 deg' is an angle, but a number without a unit is expected; write one such as 0.3");
  EXPECT_EQ(refusal("20", kTemperature), "");
  EXPECT_EQ(refusal("20 m", kTemperature),
            "'20 m' is a length, but a temperature is expected; write one such as 293 K");
  EXPECT_EQ(refusal("2 K", kPressure), "'2 K' is a temperature, but a pressure is expected; write one such as 5 kPa");
  EXPECT_EQ(refusal("2 m^2/s", kTime),
            "'2 m^2/s' is a quantity in m^2 s^-1, but a time is expected; write one such as 0.2 s");
}

TEST(Units, WhatIsNotAQuantityIsRefused) {
  EXPECT_EQ(refusal("3 MPaa", kPressure), "unknown unit 'MPaa'; did you mean 'MPa'?");
  EXPECT_EQ(refusal("fast", kVelocity), "'fast' is not a number; write a velocity, such as 1.7 km/s");
  for (const char* bad : {"",       " ",    "nan",           "inf",           "1e400", "3 m^x",      "3 m^99",
                          "3 (m",   "3 m)", "3 **m",         "3 ((((((((((m", "3 m/",  "3 m^0.3",    "3 m^nan",
                          "3 sqrt", "3 √",  "3 √√√√√√√√√√m", "0x10",          "1,5",   "5 m m^-1 m^"}) {
    EXPECT_NE(refusal(bad, kLength), "") << bad;
  }
}

// Suggestions must not lead astray by powers of ten.
TEST(Units, AnotherCaseSuggestsTheUnitThatIsMeant) {
  const std::vector<std::array<const char*, 2>> meant = {{"KPa", "did you mean 'kPa'?"},
                                                         {"KPA", "did you mean 'kPa'?"},
                                                         {"mpa", "did you mean 'MPa' or 'mPa'?"},
                                                         {"gpa", "did you mean 'GPa'?"},
                                                         {"Cm", "did you mean 'cm'?"},
                                                         {"MM", "did you mean 'mm'?"},
                                                         {"mM", "did you mean 'mm'?"},
                                                         {"Mm", "did you mean 'mm'?"},
                                                         {"KG", "did you mean 'kg'?"},
                                                         {"mS", "did you mean 'ms'?"},
                                                         {"Ms", "did you mean 'ms'?"},
                                                         {"Deg", "did you mean 'deg'?"},
                                                         {"meters", "write 'm'"},
                                                         {"degC", "the number plus 273.15"},
                                                         {"deq", "did you mean 'deg'?"},
                                                         {"µm", "(U+00B5); write 'u' in its place: 'um'"},
                                                         {"μm", "(U+03BC); write 'u' in its place: 'um'"},
                                                         {"kg/m³", "(U+00B3); write '^3' in its place: 'kg/m^3'"},
                                                         {"°", "(U+00B0); write 'deg' in its place: 'deg'"},
                                                         {"°C", "the number plus 273.15"},
                                                         {"\u00a0kPa", "type the space anew: 'kPa'"}};
  for (const auto& [unit, advice] : meant) {
    const std::string text = refusal(std::string("20 ") + unit, kPressure);
    EXPECT_EQ(text.find("unknown unit '" + std::string(unit) + "'"), 0U) << text;
    EXPECT_NE(text.find(advice), std::string::npos) << text;
  }
  // No prefix is dropped: psi for kpsi would be off by 1000.
  EXPECT_EQ(refusal("3 Kpsi", kPressure).find("did you mean"), std::string::npos);
  // Units that differ from another in case alone are both there.
  expect_si("1 mPa s", kViscosity, 1e-3);
  expect_si("2 Mg", kMass, 2000.0);
  expect_si("2 MJ", kEnergy, 2e6);
  expect_si("2 kHz", kRate, 2000.0);
  EXPECT_NEAR(parse_unit("MW").factor, 1e6, 1e-8);
}

TEST(Units, BadSystemsAreRefused) {
  EXPECT_THROW(parse_unit_system("legacy"), UnitError);
  EXPECT_THROW(parse_unit_system("g-mm-s"), UnitError);
  EXPECT_THROW(parse_unit_system("mm-g"), UnitError);
  EXPECT_THROW(parse_unit_system("mm-g-s-s"), UnitError);
  EXPECT_THROW(make_unit_system("mm", "g", "fortnight"), UnitError);
}

// Found by the fuzz test: exponents that exceed every integer type, and powers of powers.
TEST(Units, ExponentsStaySmall) {
  const std::string small = "has an exponent that is not a small whole number or a half";
  for (const char* text : {"m^10", "m^-2147483648", "m^99999999999999999999"}) {
    EXPECT_THROW(parse_unit(text), UnitError) << text;
  }
  EXPECT_NE(refusal("1 m^-2147483648", kLength).find(small), std::string::npos);
  EXPECT_EQ(parse_unit("(m^9)^9").dimension.length, 81);
  EXPECT_THROW(parse_unit("((((m^9)^9)^9)^9)^9"), UnitError);
}

}  // namespace units_test
}  // namespace mpm
