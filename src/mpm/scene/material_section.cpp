// materials: density, a law and its constants.
#include <fmt/format.h>

#include <array>

#include "mpm/scene/sections.hpp"

namespace mpm {
namespace {

const std::vector<std::string> kLaws = {"linear_elastic", "neo_hookean", "drucker_prager", "mohr_coulomb"};

const std::vector<Later>& later_laws() {
  static const std::string solid = "use linear_elastic or neo_hookean";
  static const std::vector<Later> laws = {{"von_mises", solid},
                                          {"j2", solid},
                                          {"johnson_cook", solid},
                                          {"viscoelastic", solid},
                                          {"ideal_gas", "use neo_hookean"},
                                          {"newtonian", "use neo_hookean"},
                                          {"rigid", "a rigid body is not a material: write it under rigid_bodies"}};
  return laws;
}

const std::vector<Later>& later_keys() {
  static const std::string thermal = "leave it out: a run is mechanical";
  static const std::vector<Later> keys = {
      {"thermal_expansion", thermal}, {"conductivity", thermal}, {"heat_capacity", thermal},
      {"diffusion", thermal},         {"biot", thermal},         {"toughness", "leave it out: bodies are whole"}};
  return keys;
}

Elasticity read_elasticity(const Map& map) {
  return {map.at("young").number(kPressure), map.at("poisson").number(kPlain)};
}

/// What the laws of soil have in common.
template <class SoilDefinition>
SoilDefinition read_soil(const Map& map) {
  SoilDefinition law;
  law.elasticity = read_elasticity(map);
  law.friction_angle = map.at("friction_angle").number(kAngle);
  if (const auto dilation = map.find("dilation_angle")) law.dilation_angle = dilation->number(kAngle);
  if (const auto cohesion = map.find("cohesion")) law.cohesion = cohesion->number(kPressure);
  if (const auto cutoff = map.find("tension_cutoff")) law.tension_cutoff = cutoff->non_negative(kPressure);
  return law;
}

DruckerPragerDefinition read_drucker_prager(const Map& map, Scene& scene) {
  auto law = read_soil<DruckerPragerDefinition>(map);
  if (const auto match = map.find("match")) {
    static constexpr std::array kMatches = {ConeMatch::compression, ConeMatch::extension, ConeMatch::plane_strain};
    law.match = kMatches.at(match->choice({"compression", "extension", "plane_strain"}));
  } else {
    scene.choices.emplace_back(map.value().path() + ".match",
                               "compression: the cone passes through Mohr-Coulomb's triaxial compression");
  }
  return law;
}

/// A refused constant belongs to the key that it was read from; the check's text begins with the constant's name.
[[noreturn]] void fail(const Map& map, const std::string& text) {
  static constexpr std::array<std::array<const char*, 2>, 7> kConstants = {{{"density", "density"},
                                                                            {"Young's modulus", "young"},
                                                                            {"Poisson's ratio", "poisson"},
                                                                            {"friction angle", "friction_angle"},
                                                                            {"dilation angle", "dilation_angle"},
                                                                            {"cohesion", "cohesion"},
                                                                            {"tension cut-off", "tension_cutoff"}}};
  const std::size_t colon = text.find(": ");
  const std::string what = colon == std::string::npos ? text : text.substr(colon + 2);
  for (const auto& [constant, key] : kConstants) {
    if (what.rfind(constant, 0) == 0 && map.value().node()[key]) map.at(key).fail(what);
  }
  map.fail(what);
}

MaterialDefinition read_material(const Value& value, Scene& scene) {
  static const std::vector<std::vector<std::string>> kKeys = {
      {},
      {},
      {"friction_angle", "dilation_angle", "cohesion", "tension_cutoff", "match"},
      {"friction_angle", "dilation_angle", "cohesion", "tension_cutoff"},
  };
  std::vector<std::string> keys = {"name", "density", "law", "young", "poisson"};
  // The law decides which keys there are; a law that cannot be read is told by choice() below.
  const YAML::Node law_node = value.is_map() ? value.node()["law"] : YAML::Node();
  if (value.is_map() && law_node && law_node.IsScalar()) {
    const std::size_t law = value.child(law_node, "law").choice(kLaws, later_laws());
    keys.insert(keys.end(), kKeys[law].begin(), kKeys[law].end());
  }
  const Map map(value, keys, later_keys());
  MaterialDefinition material;
  material.name = map.at("name").name();
  material.density = map.at("density").number(kDensity);
  switch (map.at("law").choice(kLaws, later_laws())) {
    case 0:
      material.law = LinearElasticDefinition{read_elasticity(map)};
      break;
    case 1:
      material.law = NeoHookeanDefinition{read_elasticity(map)};
      break;
    case 2:
      material.law = read_drucker_prager(map, scene);
      break;
    default:
      material.law = read_soil<MohrCoulombDefinition>(map);
  }
  try {
    check(material);
  } catch (const MaterialError& error) {
    fail(map, error.what());
  }
  return material;
}

}  // namespace

void read_materials(const Map& root, Scene& scene) {
  for (const Value& value : root.at("materials").elements()) {
    MaterialDefinition material = read_material(value, scene);
    for (const MaterialDefinition& other : scene.definition.materials) {
      if (other.name == material.name)
        value.fail(fmt::format("a second material '{}'; give each its own name", material.name));
    }
    scene.definition.materials.push_back(std::move(material));
  }
}

}  // namespace mpm
