// materials: density, a law and its constants.
#include <fmt/format.h>

#include <functional>

#include "mpm/material/add_user_law.hpp"
#include "mpm/material/law_keys.hpp"
#include "mpm/sections/sections.hpp"

namespace mpm {

namespace {

constexpr double kGlassInertial = 0.279;  // I_0 of glass beads, Jop, Forterre & Pouliquen (2006)
constexpr double kLeastPart = 0.01;       // part of clay's preconsolidation pressure
constexpr double kGrainFraction = 0.6;    // part of the volume of a heap, of the same

const std::vector<Later> kLaterLaws = {{"rigid", "a rigid body is not a material: write it under rigid_bodies"}};
const std::vector<Later> kLaterKeys = {{"toughness", "leave it out: bodies are whole"}};

/// Reads keys that stand for a constant by another way, and chooses what follows from others; most laws have neither.
template <class Law>
void complete_law(const Map&, Scene&, Law&) {}

void complete_law(const Map& map, Scene& scene, MuIDefinition& law) {
  if (!map.find("I_0")) {
    law.reference_inertial = kGlassInertial;
    scene.choices.emplace_back(map.value().path() + ".I_0", fmt::format("{:g}: glass beads", kGlassInertial));
  }
  if (map.find("grain_density")) return;
  law.grain_density = map.at("density").positive(kDensity) / kGrainFraction;
  scene.choices.emplace_back(
      map.value().path() + ".grain_density",
      fmt::format("{:g} kg/m^3: grains take {:g} of the volume", law.grain_density, kGrainFraction));
}

void complete_law(const Map& map, Scene& scene, CamClayDefinition& law) {
  if (map.find("least_pressure")) return;
  if (law.consolidation == 0.0) {
    map.fail(
        "overconsolidation_ratio needs least_pressure, the pressure below which the clay stiffens no more: a "
        "hundredth of the pressures that matter");
  }
  law.least_pressure = kLeastPart * law.consolidation;
  scene.choices.emplace_back(
      map.value().path() + ".least_pressure",
      fmt::format("{:g} Pa: {:g} of the preconsolidation pressure", law.least_pressure, kLeastPart));
}

void complete_law(const Map& map, Scene&, NewtonianFluidDefinition& law) {
  const auto speed = map.find("sound_speed");
  if (!speed) return;
  const double c = speed->positive(kVelocity);
  law.bulk_modulus = map.at("density").positive(kDensity) * c * c;
}

void complete_law(const Map& map, Scene& scene, JohnsonCookDefinition& law) {
  if (law.rate_sensitivity > 0.0 && !map.find("reference_rate")) {
    scene.choices.emplace_back(map.value().path() + ".reference_rate", "1 1/s: that of most published constants");
  }
}

/// A law as a section of scenes.
struct LawSection {
  std::string name;
  std::vector<std::string> keys;  ///< besides name, density and law
  std::function<LawDefinition(const Map&, Scene&)> read;
};

template <class Law>
LawDefinition read_law(const Map& map, Scene& scene) {
  Law law;
  read_keys(map, law_keys<Law>(), law);
  complete_law(map, scene, law);
  tell_defaults(map, law_keys<Law>(), scene);
  return law;
}

LawDefinition read_user_law(const UserLawKind& kind, const Map& map, Scene& scene) {
  UserLawDefinition law = kind.fresh();
  read_keys(map, kind.keys, law);
  tell_defaults(map, kind.keys, scene);
  return law;
}

/// The laws of the list, then those that a program has added.
std::vector<LawSection> law_sections() {
  std::vector<LawSection> list;
  each_law([&](const auto& law) {
    using Law = std::decay_t<decltype(law)>;
    list.push_back({Law::kName, law_keys<Law>().names(), read_law<Law>});
  });
  for (const UserLawKind* kind : user_laws()) {
    list.push_back({kind->name, kind->keys.names(),
                    [kind](const Map& map, Scene& scene) { return read_user_law(*kind, map, scene); }});
  }
  return list;
}

LawSection find_section(const Value& law) {
  const std::vector<LawSection> sections = law_sections();
  std::vector<std::string> names;
  for (const LawSection& section : sections) names.push_back(section.name);
  return sections[law.choice(names, kLaterLaws)];
}

}  // namespace

Map material_map(const Value& value, const Map& root) {
  std::vector<std::string> keys = material_keys().names();
  // The law determines the keys. Without a law the keys of all laws are allowed, and the missing key `law` is reported
  // below.
  const YAML::Node law = value.is_map() ? value.node()["law"] : YAML::Node();
  if (value.is_map() && law && law.IsScalar()) {
    const LawSection section = find_section(value.child(law, "law"));
    keys.insert(keys.end(), section.keys.begin(), section.keys.end());
  } else if (value.is_map()) {
    for (const LawSection& section : law_sections()) keys.insert(keys.end(), section.keys.begin(), section.keys.end());
  }
  add_transport_keys(value, root, keys);
  add_fracture_keys(value, root, keys);
  return Map(value, keys, kLaterKeys);
}

namespace {

MaterialDefinition read_material(const Map& map, Scene& scene) {
  MaterialDefinition material;
  material.name = map.at("name").name();
  read_keys(map, material_keys(), material);
  material.law = find_section(map.at("law")).read(map, scene);
  if (const auto fault = material_fault(material)) map.fail(*fault);
  return material;
}

}  // namespace

void read_materials(const Map& root, Scene& scene) {
  for (const Value& value : root.at("materials").elements()) {
    MaterialDefinition material = read_material(material_map(value, root), scene);
    for (const MaterialDefinition& other : scene.definition.materials) {
      if (other.name == material.name)
        value.fail(fmt::format("a second material '{}'; give each its own name", material.name));
    }
    scene.definition.materials.push_back(std::move(material));
  }
}

}  // namespace mpm
