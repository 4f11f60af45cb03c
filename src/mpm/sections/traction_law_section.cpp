// cracks.traction_laws: laws of the tractions between the faces of a crack, from the numbers that suffice.
// Source: crack reference 5.5.
#include <fmt/format.h>

#include <algorithm>

#include "mpm/crack/crack_error.hpp"
#include "mpm/crack/crack_keys.hpp"
#include "mpm/crack/traction_completion.hpp"
#include "mpm/crack/traction_law.hpp"
#include "mpm/math/nearest.hpp"
#include "mpm/sections/sections.hpp"

namespace mpm {
namespace {

/// Keys of one direction of a curve.
std::vector<std::string> curve_keys(TractionKind curve) {
  switch (curve) {
    case TractionKind::cubic:
      return {"strength", "toughness", "opening"};
    case TractionKind::trilinear:
      return {"strength", "elastic", "strength_2", "elastic_2", "opening", "toughness", "stiffness"};
    case TractionKind::exponential:
      return {"strength", "toughness", "opening", "stiffness", "elastic", "elastic_part", "decay"};
    case TractionKind::linear:
      return {"stiffness"};
    default:
      return {"strength", "toughness", "opening", "stiffness", "elastic", "elastic_part"};
  }
}

std::optional<double> read_part(const Map& map, const char* key, const Dimension& dimension) {
  const auto value = map.find(key);
  return value ? std::optional<double>(value->positive(dimension)) : std::nullopt;
}

TractionMode read_trilinear(const Map& map) {
  GivenTrilinear given;
  given.strength = read_part(map, "strength", kPressure);
  given.elastic = read_part(map, "elastic", kLength);
  given.strength_2 = read_part(map, "strength_2", kPressure);
  given.elastic_2 = read_part(map, "elastic_2", kLength);
  given.opening = read_part(map, "opening", kLength);
  given.toughness = read_part(map, "toughness", kSurfaceEnergy);
  given.stiffness = read_part(map, "stiffness", kStiffness);
  return complete_trilinear(given);
}

TractionMode read_curve(const Map& map, TractionKind curve) {
  GivenTraction given;
  given.strength = read_part(map, "strength", kPressure);
  given.toughness = read_part(map, "toughness", kSurfaceEnergy);
  given.opening = read_part(map, "opening", kLength);
  if (curve == TractionKind::cubic) return complete_cubic(given);
  given.stiffness = read_part(map, "stiffness", kStiffness);
  given.elastic = read_part(map, "elastic", kLength);
  given.elastic_part = read_part(map, "elastic_part", kPlain);
  if (curve == TractionKind::exponential) return complete_exponential(given, map.at("decay").positive(kPlain));
  return complete_triangular(given);
}

/// One direction. @throws SceneError also for numbers that are too many, too few, or make no law
TractionMode read_mode(const Value& value, TractionKind curve) {
  const Map map(value, curve_keys(curve));
  try {
    if (curve == TractionKind::trilinear) return read_trilinear(map);
    if (curve != TractionKind::linear) return read_curve(map, curve);
  } catch (const CrackError& error) {
    map.fail(error.what());
  }
  TractionMode mode;
  mode.stiffness = map.at("stiffness").non_negative(kStiffness);
  return mode;
}

}  // namespace

TractionLawDefinition read_traction_law(const Value& value) {
  TractionLawDefinition law;
  law.where = value.where();
  const Map map = read_keys(value, traction_law_keys(), law);
  const auto refuse_other = [&](std::initializer_list<const char*> keys, bool allowed, const char* of) {
    for (const char* key : keys) {
      if (const auto written = map.find(key); written && !allowed) {
        written->fail(fmt::format("it is of {}, and this law is {}; leave it out", of,
                                  kTractionKindNames[static_cast<std::size_t>(law.kind)]));
      }
    }
  };
  const bool pressure = law.kind == TractionKind::pressure, mixed = law.kind == TractionKind::mixed;
  const bool uncoupled = law.kind <= TractionKind::exponential;
  refuse_other({"pressure", "least_opening"}, pressure, "the law pressure");
  refuse_other({"normal", "shear"}, !pressure, "laws of the opening");
  refuse_other({"curve"}, mixed, "the law mixed");
  refuse_other({"mix"}, uncoupled, "laws whose directions know nothing of each other");
  if (pressure) {
    if (map.at("pressure"); law.pressure.uses_place())
      map.at("pressure").fail("it acts on all of a crack; write a function of t");
    return law;
  }
  TractionKind curve = uncoupled || law.kind == TractionKind::linear ? law.kind : TractionKind::triangular;
  if (const auto written = map.find("curve")) {
    law.curve = curve =
        static_cast<TractionKind>(written->choice({kTractionKindNames.begin(), kTractionKindNames.begin() + 4}));
  }
  law.normal = read_mode(map.at("normal"), curve);
  const auto shear = map.find("shear");
  law.shear = shear ? read_mode(*shear, curve) : law.normal;
  try {
    TractionLawDefinition nameless = law;
    nameless.where.clear();
    TractionLaw{nameless};
  } catch (const CrackError& error) {
    map.fail(error.what());
  }
  return law;
}

std::string read_traction_name(const Value& value, const std::vector<TractionLawDefinition>& laws) {
  std::string name = value.text();
  std::vector<std::string> known;
  for (const TractionLawDefinition& law : laws) known.push_back(law.name);
  if (known.empty()) value.fail(fmt::format("no law '{}'; write it in cracks.traction_laws", name));
  if (std::find(known.begin(), known.end(), name) == known.end()) {
    value.fail(fmt::format("no law '{}'; {}", name, suggest(name, known)));
  }
  return name;
}

}  // namespace mpm
