// materials, law: norsand.
#include <fmt/format.h>

#include "mpm/sections/sections.hpp"

namespace mpm {
namespace {

/// Void ratio of a relative density between the densest and the loosest.
double void_ratio_of(const Value& density, const Map& map, Scene& scene) {
  const double loosest = map.at("e_max").positive(kPlain), densest = map.at("e_min").positive(kPlain);
  if (!(densest < loosest)) {
    map.at("e_min").fail(
        fmt::format("{:g} is not below e_max, {:g}: sand is densest at the least void ratio", densest, loosest));
  }
  const double part = density.number(kPlain, kPart);
  const double value = loosest - part * (loosest - densest);
  scene.choices.emplace_back(map.value().path() + ".relative_density", fmt::format("a void ratio of {:.4g}", value));
  return value;
}

}  // namespace

void complete_law(const Map& map, Scene& scene, NorSandDefinition& law) {
  const auto density = map.find("relative_density");
  for (const char* key : {"e_max", "e_min"}) {
    const auto bound = map.find(key);
    if (bound && !density) bound->fail("goes with relative_density; leave it out beside void_ratio");
  }
  if (density) law.void_ratio = void_ratio_of(*density, map, scene);
}

}  // namespace mpm
