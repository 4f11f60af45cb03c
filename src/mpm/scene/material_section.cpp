// materials: density, a law and its constants.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "mpm/material/user_law.hpp"
#include "mpm/scene/sections.hpp"

namespace mpm {

Elasticity read_elasticity(const Map& map) {
  return {map.at("young").number(kPressure), map.at("poisson").number(kPlain)};
}

namespace {

constexpr double kGlassInertial = 0.279;  // I_0 of glass beads, Jop, Forterre & Pouliquen (2006)
constexpr double kLeastPart = 0.01;       // part of clay's preconsolidation pressure
constexpr double kGrainFraction = 0.6;    // part of the volume of a heap, of the same

const std::vector<Later>& later_laws() {
  static const std::vector<Later> laws = {{"rigid", "a rigid body is not a material: write it under rigid_bodies"}};
  return laws;
}

const std::vector<Later>& later_keys() {
  static const std::vector<Later> keys = {{"toughness", "leave it out: bodies are whole"}};
  return keys;
}

LawDefinition read_linear_elastic(const Map& map, Scene&) { return LinearElasticDefinition{read_elasticity(map)}; }

LawDefinition read_neo_hookean(const Map& map, Scene&) { return NeoHookeanDefinition{read_elasticity(map)}; }

LawDefinition read_mu_i(const Map& map, Scene& scene) {
  MuIDefinition law;
  law.elasticity = read_elasticity(map);
  law.static_friction = map.at("mu_s").number(kPlain);
  law.limiting_friction = map.at("mu_2").number(kPlain);
  law.grain_diameter = map.at("grain_diameter").number(kLength);
  if (const auto reference = map.find("I_0")) {
    law.reference_inertial = reference->number(kPlain);
  } else {
    law.reference_inertial = kGlassInertial;
    scene.choices.emplace_back(map.value().path() + ".I_0", fmt::format("{:g}: glass beads", kGlassInertial));
  }
  if (const auto grain = map.find("grain_density")) {
    law.grain_density = grain->number(kDensity);
  } else {
    law.grain_density = map.at("density").positive(kDensity) / kGrainFraction;
    scene.choices.emplace_back(
        map.value().path() + ".grain_density",
        fmt::format("{:g} kg/m^3: grains take {:g} of the volume", law.grain_density, kGrainFraction));
  }
  return law;
}

LawDefinition read_cam_clay(const Map& map, Scene& scene) {
  CamClayDefinition law;
  law.lambda = map.at("lambda").number(kPlain);
  law.kappa = map.at("kappa").number(kPlain);
  law.slope = map.at("M").number(kPlain);
  law.void_ratio = map.at("void_ratio").number(kPlain);
  const auto shear = map.find("shear_modulus"), poisson = map.find("poisson");
  if (shear.has_value() == poisson.has_value()) map.fail("write exactly one of shear_modulus and poisson");
  if (shear) {
    law.shear_modulus = shear->positive(kPressure);
  } else {
    law.poisson = poisson->number(kPlain);
  }
  const auto consolidation = map.find("preconsolidation_pressure"), ratio = map.find("overconsolidation_ratio");
  if (consolidation.has_value() == ratio.has_value()) {
    map.fail("write exactly one of preconsolidation_pressure and overconsolidation_ratio");
  }
  if (consolidation) {
    law.consolidation = consolidation->positive(kPressure);
  } else {
    law.overconsolidation = ratio->number(kPlain);
  }
  if (const auto least = map.find("least_pressure")) {
    law.least_pressure = least->number(kPressure);
  } else if (consolidation) {
    law.least_pressure = kLeastPart * law.consolidation;
    scene.choices.emplace_back(
        map.value().path() + ".least_pressure",
        fmt::format("{:g} Pa: {:g} of the preconsolidation pressure", law.least_pressure, kLeastPart));
  } else {
    map.fail(
        "overconsolidation_ratio needs least_pressure, the pressure below which the clay stiffens no more: a "
        "hundredth of the pressures that matter");
  }
  return law;
}

LawDefinition read_j2_plasticity(const Map& map, Scene&) {
  J2PlasticityDefinition law;
  law.elasticity = read_elasticity(map);
  law.yield_stress = map.at("yield_stress").number(kPressure);
  if (const auto modulus = map.find("hardening_modulus")) law.hardening_modulus = modulus->number(kPressure);
  const auto stress = map.find("saturation_stress"), rate = map.find("saturation_rate");
  if (stress.has_value() != rate.has_value()) {
    map.fail("saturation_stress and saturation_rate go together; write both or neither");
  }
  if (stress) {
    law.saturation_stress = stress->number(kPressure);
    law.saturation_rate = rate->positive(kPlain);
  }
  return law;
}

LawDefinition read_newtonian_fluid(const Map& map, Scene& scene) {
  NewtonianFluidDefinition law;
  const auto bulk = map.find("bulk_modulus"), speed = map.find("sound_speed");
  if (bulk.has_value() == speed.has_value()) map.fail("write exactly one of bulk_modulus and sound_speed");
  if (bulk) {
    law.bulk_modulus = bulk->number(kPressure);
  } else {
    const double c = speed->positive(kVelocity);
    law.bulk_modulus = map.at("density").positive(kDensity) * c * c;
  }
  if (const auto exponent = map.find("exponent")) law.exponent = exponent->number(kPlain);
  if (const auto viscosity = map.find("viscosity")) law.viscosity = viscosity->number(kViscosity);
  if (const auto tension = map.find("tension")) {
    law.tension = tension->choice({"none", "allow"}) == 1;
  } else {
    scene.choices.emplace_back(map.value().path() + ".tension", "none: a free surface parts without resistance");
  }
  return law;
}

LawDefinition read_ideal_gas(const Map& map, Scene& scene) {
  IdealGasDefinition law;
  law.pressure = map.at("pressure").number(kPressure);
  law.temperature = map.at("temperature").number(kTemperature);
  if (const auto ratio = map.find("heat_capacity_ratio")) {
    law.heat_capacity_ratio = ratio->number(kPlain);
  } else {
    scene.choices.emplace_back(map.value().path() + ".heat_capacity_ratio", "1.4: air");
  }
  if (const auto process = map.find("process")) {
    static constexpr std::array kProcesses = {GasProcess::adiabatic, GasProcess::isothermal};
    law.process = kProcesses.at(process->choice({"adiabatic", "isothermal"}));
  } else {
    scene.choices.emplace_back(map.value().path() + ".process", "adiabatic: no heat leaves the gas");
  }
  if (const auto ambient = map.find("ambient_pressure")) law.ambient = ambient->number(kPressure);
  return law;
}

LawDefinition read_viscoelastic(const Map& map, Scene&) {
  return StandardLinearSolidDefinition{read_elasticity(map), map.at("branch_modulus").number(kPressure),
                                       map.at("relaxation_time").number(kTime)};
}

/// Reads heat: c_v, and the softening by temperature.
void read_heat(const Map& map, Scene& scene, JohnsonCookDefinition& law) {
  law.heat_capacity = map.at("heat_capacity").number(kHeatCapacity);
  if (const auto fraction = map.find("heat_fraction")) law.heat_fraction = fraction->number(kPlain);
  if (const auto reference = map.find("reference_temperature")) {
    law.reference_temperature = reference->number(kTemperature);
  } else {
    scene.choices.emplace_back(map.value().path() + ".reference_temperature", "293 K: the strength's A is of a room");
  }
  const auto exponent = map.find("m"), melting = map.find("melting_temperature");
  if (exponent.has_value() != melting.has_value()) {
    map.fail(
        "m and melting_temperature go together: strength falls from reference_temperature to melting_temperature; "
        "write both, or neither for a metal that heat neither softens nor melts");
  }
  if (exponent) {
    law.softening_exponent = exponent->number(kPlain);
    law.melting_temperature = melting->positive(kTemperature);
  } else {
    scene.choices.emplace_back(map.value().path() + ".melting_temperature",
                               "none: heat neither softens nor melts the material");
  }
}

LawDefinition read_johnson_cook(const Map& map, Scene& scene) {
  JohnsonCookDefinition law;
  law.shear_modulus = map.at("shear_modulus").number(kPressure);
  law.pressure = {map.at("C0").number(kVelocity), map.at("S").number(kPlain), map.at("gamma0").number(kPlain)};
  law.yield_stress = map.at("A").number(kPressure);
  const auto hardening = map.find("B"), exponent = map.find("n");
  if (hardening.has_value() != exponent.has_value()) map.fail("B and n go together; write both or neither");
  if (hardening) {
    law.hardening = hardening->number(kPressure);
    law.hardening_exponent = exponent->number(kPlain);
  }
  if (const auto sensitivity = map.find("C")) law.rate_sensitivity = sensitivity->number(kPlain);
  if (const auto rate = map.find("reference_rate")) {
    law.reference_rate = rate->number(kRate);
  } else if (law.rate_sensitivity > 0.0) {
    scene.choices.emplace_back(map.value().path() + ".reference_rate", "1 1/s: that of most published constants");
  }
  read_heat(map, scene, law);
  return law;
}

struct LawSection {
  const char* name;
  std::vector<std::string> keys;  ///< besides name, density and law
  LawDefinition (*read)(const Map&, Scene&);
};

const std::vector<LawSection>& law_sections() {
  static const std::vector<LawSection> sections = {
      {"linear_elastic", {"young", "poisson"}, read_linear_elastic},
      {"neo_hookean", {"young", "poisson"}, read_neo_hookean},
      {"drucker_prager",
       {"young", "poisson", "friction_angle", "dilation_angle", "dilation_limit", "dilation_rise", "cohesion",
        "tension_cutoff", "softening_slip", "residual_friction_angle", "residual_cohesion", "shear_band", "match"},
       read_drucker_prager},
      {"mohr_coulomb",
       {"young", "poisson", "friction_angle", "dilation_angle", "dilation_limit", "dilation_rise", "cohesion",
        "tension_cutoff", "softening_slip", "residual_friction_angle", "residual_cohesion", "shear_band"},
       read_mohr_coulomb},
      {"mu_i", {"young", "poisson", "mu_s", "mu_2", "I_0", "grain_diameter", "grain_density"}, read_mu_i},
      {"cam_clay",
       {"lambda", "kappa", "M", "void_ratio", "shear_modulus", "poisson", "preconsolidation_pressure",
        "overconsolidation_ratio", "least_pressure"},
       read_cam_clay},
      {"norsand",
       {"gamma", "lambda", "critical_exponent", "M", "N", "chi", "H", "H_psi", "shear_modulus", "shear_exponent",
        "poisson", "void_ratio", "relative_density", "e_max", "e_min", "overconsolidation_ratio", "least_pressure"},
       read_norsand},
      {"j2_plasticity",
       {"young", "poisson", "yield_stress", "hardening_modulus", "saturation_stress", "saturation_rate"},
       read_j2_plasticity},
      {"johnson_cook",
       {"shear_modulus", "C0", "S", "gamma0", "A", "B", "n", "C", "reference_rate", "m", "melting_temperature",
        "reference_temperature", "heat_capacity", "heat_fraction"},
       read_johnson_cook},
      {"viscoelastic", {"young", "poisson", "branch_modulus", "relaxation_time"}, read_viscoelastic},
      {"newtonian_fluid", {"bulk_modulus", "sound_speed", "exponent", "viscosity", "tension"}, read_newtonian_fluid},
      {"ideal_gas", {"pressure", "temperature", "heat_capacity_ratio", "process", "ambient_pressure"}, read_ideal_gas}};
  return sections;
}

/// Reads the constants of a law that a program has added.
LawDefinition read_user_law(const UserLawKind& kind, const Map& map) {
  UserLawDefinition law;
  law.kind = &kind;
  law.elasticity = read_elasticity(map);
  for (const UserConstant& constant : kind.constants) {
    const auto value = constant.otherwise ? map.find(constant.key) : map.at(constant.key);
    const Dimension dimension = constant.unit.empty() ? kPlain : parse_unit(constant.unit).dimension;
    law.constants.push_back(value ? value->number(dimension) : *constant.otherwise);
  }
  return law;
}

std::size_t law_number(const Value& law) {
  std::vector<std::string> names;
  for (const LawSection& section : law_sections()) names.emplace_back(section.name);
  for (const UserLawKind* kind : user_laws()) names.push_back(kind->name);
  return law.choice(names, later_laws());
}

std::vector<std::string> keys_of_law(std::size_t number) {
  const std::size_t listed = law_sections().size();
  if (number < listed) return law_sections()[number].keys;
  std::vector<std::string> keys = {"young", "poisson"};
  for (const UserConstant& constant : user_laws()[number - listed]->constants) keys.push_back(constant.key);
  return keys;
}

LawDefinition read_law(const Map& map, Scene& scene) {
  const std::size_t number = law_number(map.at("law")), listed = law_sections().size();
  if (number < listed) return law_sections()[number].read(map, scene);
  return read_user_law(*user_laws()[number - listed], map);
}

/// Reports a refused constant at the key that it was read from. The text of the check begins with the name of the
/// constant, which is the key, or the key with spaces, except for three.
[[noreturn]] void fail(const Map& map, const std::string& text) {
  const std::size_t colon = text.find(": ");
  const std::string what = colon == std::string::npos ? text : text.substr(colon + 2);
  for (const auto& entry : map.value().node()) {
    const std::string key = entry.first.Scalar();
    std::string constant = key;
    std::replace(constant.begin(), constant.end(), '_', ' ');
    if (key == "young") constant = "Young's modulus";
    if (key == "poisson") constant = "Poisson's ratio";
    if (key == "tension_cutoff") constant = "tension cut-off";
    for (const std::string& name : {constant, key}) {
      if (what.rfind(name + " is ", 0) == 0) map.at(key).fail(what);
    }
  }
  map.fail(what);
}

}  // namespace

Map material_map(const Value& value, const Map& root) {
  std::vector<std::string> keys = {"name", "density", "law"};
  // The law determines the keys. Without a law the keys of all laws are allowed, and the missing key `law` is reported
  // below.
  const YAML::Node law = value.is_map() ? value.node()["law"] : YAML::Node();
  if (value.is_map() && law && law.IsScalar()) {
    const std::vector<std::string> own = keys_of_law(law_number(value.child(law, "law")));
    keys.insert(keys.end(), own.begin(), own.end());
  } else if (value.is_map()) {
    for (const LawSection& section : law_sections()) keys.insert(keys.end(), section.keys.begin(), section.keys.end());
  }
  add_transport_keys(value, root, keys);
  add_fracture_keys(value, root, keys);
  return Map(value, keys, later_keys());
}

namespace {

MaterialDefinition read_material(const Map& map, Scene& scene) {
  MaterialDefinition material;
  material.name = map.at("name").name();
  material.density = map.at("density").number(kDensity);
  material.law = read_law(map, scene);
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
    MaterialDefinition material = read_material(material_map(value, root), scene);
    for (const MaterialDefinition& other : scene.definition.materials) {
      if (other.name == material.name)
        value.fail(fmt::format("a second material '{}'; give each its own name", material.name));
    }
    scene.definition.materials.push_back(std::move(material));
  }
}

}  // namespace mpm
