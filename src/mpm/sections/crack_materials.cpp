// fracture: the constants of materials for the growth of cracks, which stand among the other constants of a material,
// and the rules of growth.
#include <fmt/format.h>

#include "mpm/crack/crack_keys.hpp"
#include "mpm/sections/sections.hpp"

namespace mpm {
GrowthRule read_growth_rule(const Value& value, const std::vector<TractionLawDefinition>& laws, bool alternate) {
  GrowthRule rule;
  const Map map = read_keys(value, growth_keys(), rule);
  if (alternate &&
      (rule.criterion == FractureCriterion::steady_state || rule.criterion == FractureCriterion::energy_balance)) {
    map.at("criterion")
        .fail(fmt::format("{} sets when a tip is looked at next, which the alternate rule cannot; write it in growth, "
                          "or another here",
                          kFractureCriterionNames[static_cast<std::size_t>(rule.criterion)]));
  }
  if (const auto traction = map.find("traction")) rule.traction = read_traction_name(*traction, laws);
  return rule;
}

void add_fracture_keys(const Value& material, const Map& root, std::vector<std::string>& keys) {
  if (!root.find("cracks") && material.is_map() && material.node()["fracture"]) {
    material.child(key_node(material.node(), "fracture"), "fracture")
        .fail("its constants are of cracks, and the scene has none; add cracks: {list: [...]}, or leave it out");
  }
  keys.emplace_back("fracture");
}

FractureConstants read_fracture_constants(const Map& material, const CracksDefinition& cracks) {
  FractureConstants read;
  const auto section = material.find("fracture");
  if (!section) return read;
  const Map map = read_keys(*section, fracture_keys(), read);
  if (const auto growth = map.find("growth")) read.growth = read_growth_rule(*growth, cracks.laws, false);
  if (const auto alternate = map.find("alternate")) read.alternate = read_growth_rule(*alternate, cracks.laws, true);
  if (const auto exponents = map.find("exponents")) {
    const std::vector<Value> pair = exponents->elements();
    if (pair.size() != 2) exponents->fail("write two, of K_I and of K_II, such as [2, 2]");
    read.k_exponent = pair[0].positive(kPlain);
    read.k_ii_exponent = pair[1].positive(kPlain);
  }
  const FractureCriterion criterion = (read.growth ? *read.growth : cracks.growth).criterion;
  if (const auto speed = map.find("speed")) {
    const bool part = criterion == FractureCriterion::energy_balance;
    read.speed = part ? speed->number(kPlain, above_to(0.0, 1.0)) : speed->positive(kVelocity);
  }
  if (const auto way = map.find("way")) {
    const Vec2 vector = read_plane_vector(*way, kPlain);
    if (!(vector.norm() > 0.0)) way->fail("a way has a length; write a vector such as [1, 0.5], or leave it out");
    read.way = {vector.x(), vector.y()};
  }
  return read;
}

}  // namespace mpm
