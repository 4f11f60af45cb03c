// fracture: the constants of materials for the growth of cracks, which stand among the other constants of a material,
// and the rules of growth.
#include <fmt/format.h>

#include "mpm/scene/sections.hpp"

namespace mpm {
namespace {

constexpr Dimension kSpeedGain{1, -1, 1, 0};  // speed over energy of a surface

/// A word of `names`, or its place among them, which is its number in the manual.
template <class Names>
std::size_t read_numbered(const Value& value, const Names& names) {
  const std::string text = value.text();
  if (text.size() == 1 && text[0] >= '0' && static_cast<std::size_t>(text[0] - '0') < names.size()) {
    return static_cast<std::size_t>(text[0] - '0');
  }
  return value.choice({names.begin(), names.end()});
}

}  // namespace

GrowthRule read_growth_rule(const Value& value, const std::vector<TractionLawDefinition>& laws, bool alternate) {
  const Map map(value, {"criterion", "direction", "traction"});
  GrowthRule rule;
  const Value criterion = map.at("criterion");
  rule.criterion = static_cast<FractureCriterion>(read_numbered(criterion, kFractureCriterionNames));
  if (alternate &&
      (rule.criterion == FractureCriterion::steady_state || rule.criterion == FractureCriterion::energy_balance)) {
    criterion.fail(fmt::format(
        "{} sets when a tip is looked at next, which the alternate rule cannot; write it in growth, or another here",
        kFractureCriterionNames[static_cast<std::size_t>(rule.criterion)]));
  }
  if (const auto direction = map.find("direction")) {
    rule.direction = static_cast<GrowthDirection>(read_numbered(*direction, kGrowthDirectionNames));
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
  const Map map(*section,
                {"k_ic", "k_iic", "exponents", "j_ic", "opening_ic", "opening_iic", "speed", "start_time", "longest",
                 "way", "surface_energy", "plastic_part", "gain", "growth", "alternate", "keeps_tips"});
  if (const auto growth = map.find("growth")) read.growth = read_growth_rule(*growth, cracks.laws, false);
  if (const auto alternate = map.find("alternate")) read.alternate = read_growth_rule(*alternate, cracks.laws, true);
  const auto positive = [&](const char* key, const Dimension& dimension, double& to) {
    if (const auto value = map.find(key)) to = value->positive(dimension);
  };
  positive("k_ic", kToughness, read.k_ic);
  positive("k_iic", kToughness, read.k_iic);
  positive("j_ic", kSurfaceEnergy, read.j_ic);
  positive("opening_ic", kLength, read.opening_ic);
  positive("opening_iic", kLength, read.opening_iic);
  positive("longest", kLength, read.longest);
  positive("surface_energy", kSurfaceEnergy, read.surface_energy);
  positive("gain", kSpeedGain, read.gain);
  if (const auto exponents = map.find("exponents")) {
    const std::vector<Value> pair = exponents->elements();
    if (pair.size() != 2) exponents->fail("write two, of K_I and of K_II, such as [2, 2]");
    read.k_exponent = pair[0].positive(kPlain);
    read.k_ii_exponent = pair[1].positive(kPlain);
  }
  const FractureCriterion criterion = (read.growth ? *read.growth : cracks.growth).criterion;
  if (criterion == FractureCriterion::energy_balance) {
    positive("speed", kPlain, read.speed);
    if (read.speed > 1.0) map.at("speed").fail("with energy_balance a part of the speed of waves; 1 at most");
  } else {
    positive("speed", kVelocity, read.speed);
  }
  if (const auto start = map.find("start_time")) read.start_time = start->non_negative(kTime);
  if (const auto way = map.find("way")) {
    const Vec2 vector = read_plane_vector(*way, kPlain);
    if (!(vector.norm() > 0.0)) way->fail("a way has a length; write a vector such as [1, 0.5], or leave it out");
    read.way = {vector.x(), vector.y()};
  }
  if (const auto part = map.find("plastic_part")) read.plastic_part = part->non_negative(kPlain);
  if (const auto keeps = map.find("keeps_tips")) read.keeps_tips = keeps->truth();
  return read;
}

}  // namespace mpm
