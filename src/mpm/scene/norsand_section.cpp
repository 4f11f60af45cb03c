// materials, law: norsand.
#include <fmt/format.h>

#include "mpm/scene/sections.hpp"

namespace mpm {
namespace {

/// Reads a void ratio, itself or by a relative density between the densest and the loosest.
double read_void_ratio(const Map& map, Scene& scene) {
  const auto voids = map.find("void_ratio"), density = map.find("relative_density");
  if (voids.has_value() == density.has_value()) map.fail("write exactly one of void_ratio and relative_density");
  if (voids) {
    for (const char* key : {"e_max", "e_min"}) {
      if (const auto bound = map.find(key)) bound->fail("goes with relative_density; leave it out beside void_ratio");
    }
    return voids->number(kPlain);
  }
  const double loosest = map.at("e_max").positive(kPlain), densest = map.at("e_min").positive(kPlain);
  if (!(densest < loosest)) {
    map.at("e_min").fail(
        fmt::format("{:g} is not below e_max, {:g}: sand is densest at the least void ratio", densest, loosest));
  }
  const double part = density->number(kPlain);
  if (!(part >= 0.0 && part <= 1.0)) {
    density->fail(fmt::format("relative density is {:g}; it must lie from 0, at e_max, to 1, at e_min", part));
  }
  const double value = loosest - part * (loosest - densest);
  scene.choices.emplace_back(map.value().path() + ".relative_density", fmt::format("a void ratio of {:.4g}", value));
  return value;
}

}  // namespace

LawDefinition read_norsand(const Map& map, Scene& scene) {
  NorSandDefinition law;
  law.gamma = map.at("gamma").number(kPlain);
  law.lambda = map.at("lambda").number(kPlain);
  if (const auto exponent = map.find("critical_exponent")) law.critical_exponent = exponent->positive(kPlain);
  law.slope = map.at("M").number(kPlain);
  law.coupling = map.at("N").number(kPlain);
  law.dilatancy = map.at("chi").number(kPlain);
  law.hardening = map.at("H").number(kPlain);
  if (const auto of_state = map.find("H_psi")) law.hardening_of_state = of_state->number(kPlain);
  law.shear_modulus = map.at("shear_modulus").number(kPressure);
  if (const auto exponent = map.find("shear_exponent")) law.shear_exponent = exponent->number(kPlain);
  if (const auto poisson = map.find("poisson")) law.poisson = poisson->number(kPlain);
  law.void_ratio = read_void_ratio(map, scene);
  if (const auto ratio = map.find("overconsolidation_ratio")) law.overconsolidation = ratio->number(kPlain);
  if (const auto least = map.find("least_pressure")) law.least_pressure = least->number(kPressure);
  const auto choose = [&](const char* key, const std::string& value) {
    if (!map.find(key)) scene.choices.emplace_back(map.value().path() + "." + key, value);
  };
  choose("shear_exponent", fmt::format("{:g}: G grows with the root of the pressure", law.shear_exponent));
  choose("poisson", fmt::format("{:g}: that of most published constants", law.poisson));
  choose("overconsolidation_ratio", "1: the sand has carried no more than its initial stress");
  choose("least_pressure", fmt::format("{:g} Pa: the weight of some 7 mm of sand", law.least_pressure));
  return law;
}

}  // namespace mpm
