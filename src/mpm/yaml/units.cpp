#include "mpm/yaml/units.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <string_view>

#include "mpm/math/constants.hpp"
#include "mpm/math/nearest.hpp"
#include "mpm/math/odd_characters.hpp"

namespace mpm {
namespace {

struct NamedUnit {
  const char* name;
  Unit unit;
};

// Inch, foot, pound, ounce, pound-force: international definitions (NIST SP 811, appendix B).
constexpr double kPound = 0.45359237;
constexpr double kPoundForce = kPound * 9.80665;
constexpr double kInch = 0.0254;

const std::array kUnits = {
    NamedUnit{"m", {1.0, kLength}},
    NamedUnit{"km", {1e3, kLength}},
    NamedUnit{"cm", {1e-2, kLength}},
    NamedUnit{"mm", {1e-3, kLength}},
    NamedUnit{"um", {1e-6, kLength}},
    NamedUnit{"microns", {1e-6, kLength}},
    NamedUnit{"nm", {1e-9, kLength}},
    NamedUnit{"in", {kInch, kLength}},
    NamedUnit{"ft", {12.0 * kInch, kLength}},
    NamedUnit{"kg", {1.0, kMass}},
    NamedUnit{"g", {1e-3, kMass}},
    NamedUnit{"mg", {1e-6, kMass}},
    NamedUnit{"Mg", {1e3, kMass}},
    NamedUnit{"t", {1e3, kMass}},
    NamedUnit{"lb", {kPound, kMass}},
    NamedUnit{"lbs", {kPound, kMass}},
    NamedUnit{"oz", {kPound / 16.0, kMass}},
    NamedUnit{"s", {1.0, kTime}},
    NamedUnit{"sec", {1.0, kTime}},
    NamedUnit{"ms", {1e-3, kTime}},
    NamedUnit{"msec", {1e-3, kTime}},
    NamedUnit{"us", {1e-6, kTime}},
    NamedUnit{"microsec", {1e-6, kTime}},
    NamedUnit{"ns", {1e-9, kTime}},
    NamedUnit{"min", {60.0, kTime}},
    NamedUnit{"Hz", {1.0, kRate}},
    NamedUnit{"kHz", {1e3, kRate}},
    NamedUnit{"rad", {1.0, kAngle}},
    NamedUnit{"deg", {kPi / 180.0, kAngle}},
    NamedUnit{"rpm", {kPi / 30.0, kAngularRate}},
    NamedUnit{"N", {1.0, kForce}},
    NamedUnit{"kN", {1e3, kForce}},
    NamedUnit{"MN", {1e6, kForce}},
    NamedUnit{"mN", {1e-3, kForce}},
    NamedUnit{"uN", {1e-6, kForce}},
    NamedUnit{"dyn", {1e-5, kForce}},
    NamedUnit{"lbf", {kPoundForce, kForce}},
    NamedUnit{"Pa", {1.0, kPressure}},
    NamedUnit{"kPa", {1e3, kPressure}},
    NamedUnit{"MPa", {1e6, kPressure}},
    NamedUnit{"GPa", {1e9, kPressure}},
    NamedUnit{"mPa", {1e-3, kPressure}},
    NamedUnit{"bar", {1e5, kPressure}},
    NamedUnit{"Ba", {0.1, kPressure}},
    NamedUnit{"psi", {kPoundForce / (kInch * kInch), kPressure}},
    NamedUnit{"J", {1.0, kEnergy}},
    NamedUnit{"kJ", {1e3, kEnergy}},
    NamedUnit{"MJ", {1e6, kEnergy}},
    NamedUnit{"mJ", {1e-3, kEnergy}},
    NamedUnit{"uJ", {1e-6, kEnergy}},
    NamedUnit{"nJ", {1e-9, kEnergy}},
    NamedUnit{"erg", {1e-7, kEnergy}},
    NamedUnit{"W", {1.0, kPower}},
    NamedUnit{"kW", {1e3, kPower}},
    NamedUnit{"MW", {1e6, kPower}},
    NamedUnit{"mW", {1e-3, kPower}},
    NamedUnit{"uW", {1e-6, kPower}},
    NamedUnit{"nW", {1e-9, kPower}},
    NamedUnit{"P", {0.1, kViscosity}},
    NamedUnit{"cP", {1e-3, kViscosity}},
    NamedUnit{"K", {1.0, kTemperature}},
    NamedUnit{"%", {0.01, kPlain}},
};

/// Name that people write for a unit that has another one here.
struct OtherName {
  const char* name;
  const char* advice;
};
constexpr std::array<OtherName, 23> kOtherNames = {{{"meter", "write 'm'"},
                                                    {"meters", "write 'm'"},
                                                    {"metre", "write 'm'"},
                                                    {"metres", "write 'm'"},
                                                    {"second", "write 's'"},
                                                    {"seconds", "write 's'"},
                                                    {"h", "write minutes, 'min'"},
                                                    {"hr", "write minutes, 'min'"},
                                                    {"hour", "write minutes, 'min'"},
                                                    {"hours", "write minutes, 'min'"},
                                                    {"degree", "write 'deg'"},
                                                    {"degrees", "write 'deg'"},
                                                    {"newton", "write 'N'"},
                                                    {"pascal", "write 'Pa'"},
                                                    {"gram", "write 'g'"},
                                                    {"kilogram", "write 'kg'"},
                                                    {"ton", "write 't', which is 1000 kg"},
                                                    {"tonne", "write 't'"},
                                                    {"inch", "write 'in'"},
                                                    {"ksi", "write psi, 1000 times as many"},
                                                    {"C", "write kelvins, 'K': the number plus 273.15"},
                                                    {"degC", "write kelvins, 'K': the number plus 273.15"},
                                                    {"celsius", "write kelvins, 'K': the number plus 273.15"}}};

bool same_but_for_case(const std::string& a, const std::string& b) {
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](char x, char y) { return lower(x) == lower(y); });
}

/// Advice on a name that is no unit. Names that are merely near are off by a power of ten as soon as
/// the letter that differs is a prefix, so only another case and a slip within a long name are taken as meant.
std::string advice_for(const std::string& name) {
  std::vector<std::string> meant, all;
  for (const NamedUnit& known : kUnits) {
    const std::string unit = known.name;
    all.push_back(unit);
    if (same_but_for_case(name, unit)) meant.push_back(unit);
  }
  for (const OtherName& other : kOtherNames) {
    if (meant.empty() && same_but_for_case(name, other.name)) return other.advice;
  }
  for (const std::string& unit : all) {
    if (meant.empty() && unit.size() >= 3 && name[0] == unit[0] && edit_distance(name, unit) == 1)
      return fmt::format("did you mean '{}'?", unit);
  }
  if (meant.empty()) return fmt::format("known units: {}", fmt::join(all, ", "));
  std::string text;
  for (const std::string& unit : meant) text += fmt::format("{}'{}'", text.empty() ? "" : " or ", unit);
  return fmt::format("did you mean {}?", text);
}

// product := factor { ['*' | ' ' | '/'] factor };  factor := [ '√' | 'sqrt' ] ( name | '1' | '(' product ')' ) [ ['^']
// number ], the number a multiple of a half
class UnitParser {
  static constexpr double kLargestExponent = 99.0;  ///< exponent of a base unit, so that factors stay finite

 public:
  explicit UnitParser(const std::string& text) : text_(text) {}

  Unit run() {
    Unit unit;
    skip_spaces();
    if (peek() != '/') unit = factor();  // "5 /s" is allowed
    unit = rest_of_product(unit);
    if (position_ != text_.size()) fail(fmt::format("'{}' is out of place", text_.substr(position_)));
    return unit;
  }

 private:
  Unit rest_of_product(Unit unit) {
    for (skip_spaces(); position_ < text_.size() && peek() != ')'; skip_spaces()) {
      const bool divide = peek() == '/';
      if (divide || peek() == '*') ++position_;
      unit = combine(unit, factor(), divide ? -1 : 1);
    }
    return unit;
  }

  Unit factor() {
    skip_spaces();
    for (const std::string_view root : {"√", "sqrt"}) {
      if (text_.compare(position_, root.size(), root) != 0) continue;
      position_ += root.size();
      if (++depth_ > kDeepest) fail("is nested too deep");
      const Unit squared = factor();
      --depth_;
      return combine(Unit{}, squared, 0.5);
    }
    Unit unit;
    if (peek() == '(') {
      if (++depth_ > kDeepest) fail("is nested too deep");
      ++position_;
      unit = rest_of_product(factor());
      if (peek() != ')') fail("lacks ')'");
      ++position_;
      --depth_;
    } else if (peek() == '1') {
      ++position_;
    } else {
      unit = named();
    }
    if (peek() == '^') {
      ++position_;
      unit = combine(Unit{}, unit, exponent());
    } else if (is_digit(peek()) && is_letter(text_[position_ - 1])) {
      unit = combine(Unit{}, unit, exponent());  // "m3"
    }
    return unit;
  }

  Unit named() {
    const std::size_t begin = position_;
    while (is_letter(peek()) || peek() == '%') ++position_;
    const std::string name = text_.substr(begin, position_ - begin);
    for (const NamedUnit& known : kUnits) {
      if (name == known.name) return known.unit;
    }
    if (name.empty()) fail("is not a unit; write one such as MPa, mm/s or kg/m^3");
    throw UnitError(fmt::format("unknown unit '{}'; {}", name, advice_for(name)));
  }

  double exponent() {
    double value = 0.0;
    const char* end = text_.data() + text_.size();
    const auto [stop, error] = std::from_chars(text_.data() + position_, end, value, std::chars_format::fixed);
    if (error != std::errc() || !(std::abs(value) <= 9.0) || std::floor(2.0 * value) != 2.0 * value) {
      fail("has an exponent that is not a small whole number or a half");
    }
    position_ = static_cast<std::size_t>(stop - text_.data());
    return value;
  }

  Unit combine(const Unit& a, const Unit& b, double power) const {
    const Dimension& p = a.dimension;
    const Dimension& q = b.dimension;
    const Dimension d{p.length + power * q.length, p.mass + power * q.mass, p.time + power * q.time,
                      p.angle + power * q.angle, p.temperature + power * q.temperature};
    for (const double exponent : {d.length, d.mass, d.time, d.angle, d.temperature}) {
      if (std::abs(exponent) > kLargestExponent) fail("has exponents that are too large");
    }
    return {a.factor * std::pow(b.factor, power), d};
  }

  static constexpr int kDeepest = 8;  ///< brackets and roots in each other
  static bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }
  static bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
  char peek() const { return position_ < text_.size() ? text_[position_] : '\0'; }
  void skip_spaces() {
    while (peek() == ' ') ++position_;
  }
  [[noreturn]] void fail(const std::string& what) const { throw UnitError(fmt::format("unit '{}' {}", text_, what)); }

  const std::string& text_;
  std::size_t position_ = 0;
  int depth_ = 0;
};

double base_unit(const std::string& text, const Dimension& expected, const char* what) {
  const Unit unit = parse_unit(text);
  if (!(unit.dimension == expected)) {
    throw UnitError(fmt::format("'{}' is {}, not {}; a unit system is length-mass-time, as in mm-g-s", text,
                                describe(unit.dimension), what));
  }
  return unit.factor;
}

}  // namespace

Unit parse_unit(const std::string& text) {
  const std::string odd = odd_character(text);
  if (odd.empty()) return UnitParser(text).run();
  const std::string start = fmt::format("unknown unit '{}': {}", text, odd);
  if (text.find("°C") != std::string::npos) throw UnitError(start + "; " + advice_for("C"));
  std::string plain = with_plain_characters(text);
  plain.erase(0, plain.find_first_not_of(' '));
  try {
    UnitParser(plain).run();
  } catch (const UnitError&) {
    throw UnitError(start);
  }
  throw UnitError(fmt::format("{}: '{}'", start, plain));
}

double UnitSystem::factor(const Dimension& dimension) const {
  return std::pow(length, dimension.length) * std::pow(mass, dimension.mass) * std::pow(time, dimension.time);
}

UnitSystem make_unit_system(const std::string& length, const std::string& mass, const std::string& time) {
  UnitSystem system;
  system.length = base_unit(length, kLength, "a length");
  system.mass = base_unit(mass, kMass, "a mass");
  system.time = base_unit(time, kTime, "a time");
  system.name = fmt::format("{}-{}-{}", length, mass, time);
  return system;
}

UnitSystem parse_unit_system(const std::string& name) {
  if (name == "si") return {};
  const std::size_t first = name.find('-');
  const std::size_t second = first == std::string::npos ? first : name.find('-', first + 1);
  if (second == std::string::npos) {
    throw UnitError(
        fmt::format("unknown unit system '{}'; write si, or length-mass-time as in mm-g-s, mm-t-s, cm-g-us", name));
  }
  return make_unit_system(name.substr(0, first), name.substr(first + 1, second - first - 1), name.substr(second + 1));
}

bool split_number(const std::string& text, double& value, std::string& rest) {
  const std::size_t begin = text.find_first_not_of(' ');
  if (begin == std::string::npos) return false;
  const char* from = text.data() + begin + (text[begin] == '+' ? 1 : 0);
  const auto [stop, error] = std::from_chars(from, text.data() + text.size(), value);
  if (error != std::errc()) return false;
  rest = text.substr(static_cast<std::size_t>(stop - text.data()));
  rest.erase(0, rest.find_first_not_of(' '));
  return true;
}

double parse_quantity(const std::string& text, const Dimension& expected, const UnitSystem& system) {
  double value = 0.0;
  std::string rest;
  if (!split_number(text, value, rest)) {
    throw UnitError(
        fmt::format("'{}' is not a number; write {}, such as {}", text, describe(expected), example(expected)));
  }
  double factor = 1.0;
  if (rest.empty()) {
    factor = system.factor(expected);
  } else {
    const Unit unit = parse_unit(rest);
    if (!(unit.dimension == expected)) {
      throw UnitError(fmt::format("'{}' is {}, but {} is expected; write one such as {}", text,
                                  describe(unit.dimension), describe(expected), example(expected)));
    }
    factor = unit.factor;
  }
  if (!std::isfinite(value * factor)) {
    throw UnitError(
        fmt::format("'{}' is not a finite number; write {}, such as {}", text, describe(expected), example(expected)));
  }
  return value * factor;
}

}  // namespace mpm
