// Growth of the tips of cracks: when a tip is looked at, how far its way is free, and what changes when it grows.
#include <algorithm>

#include "mpm/crack/around_point.hpp"
#include "mpm/crack/chain.hpp"
#include "mpm/crack/crack_tips.hpp"
#include "mpm/crack/crossing.hpp"
#include "mpm/math/constants.hpp"

namespace mpm {
namespace {

constexpr double kBeyond = 0.25;       ///< part of a cell, ahead of growth and beside it, where other cracks are seen
constexpr double kLongestPart = 0.75;  ///< part of a growth, which growth_points() divides above that [cells]

/// Segments at an end of a line that are `length` long together.
int segments_at_end(const std::vector<Vec2>& line, int end, double length) {
  const int all = static_cast<int>(line.size()) - 1;
  int count = 0;
  for (double sum = 0.0; count < all && sum < length; ++count) {
    const int k = end == 0 ? count : all - 1 - count;
    sum += (line[k + 1] - line[k]).norm();
  }
  return count;
}

}  // namespace

bool CrackTips::stopped(const CrackTip& tip) const { return cracks_[tip.crack].chain.end(tip.end) != CrackEnd::tip; }

bool CrackTips::may_grow(const CrackTip& tip) const {
  const bool known = tip.material >= 0 && settings_.materials[tip.material].constants.growth.has_value();
  return (settings_.growth.criterion != FractureCriterion::none || known || tip.material < 0) && !stopped(tip);
}

bool CrackTips::growth_due(double time) const {
  return std::any_of(tips_.begin(), tips_.end(),
                     [&](const CrackTip& tip) { return may_grow(tip) && time >= tip.next_look; });
}

void CrackTips::find_growing(std::vector<Vec2>& places) const {
  places.clear();
  for (const CrackTip& tip : tips_) {
    if (may_grow(tip)) places.push_back(place_of(tip));
  }
}

void CrackTips::find_growing(std::vector<FacesOfGrowth>& faces) const {
  faces.clear();
  const GridLayout& layout = parts_.fields.front()->layout;
  const double length = std::min(settings_.length, kLongestPart) * std::max(layout.cell(0), layout.cell(1));
  for (const CrackTip& tip : tips_) {
    if (!may_grow(tip)) continue;
    const GrowthRule *first = &settings_.growth, *second = &settings_.alternate;
    if (tip.material >= 0) {
      const FractureConstants& constants = settings_.materials[tip.material].constants;
      if (constants.growth) first = &*constants.growth;
      if (constants.alternate) second = &*constants.alternate;
    }
    for (const GrowthRule* rule : {first, second}) {
      const int law = rule->criterion == FractureCriterion::none ? -1 : tractions_.law_of(law_of_growth(tip, *rule));
      if (law >= 0) faces.push_back({tip.crack, tip.end, law, length});
    }
  }
}

const std::string& CrackTips::law_of_growth(const CrackTip& tip, const GrowthRule& rule) const {
  const std::string& own = cracks_[tip.crack].definition.traction_of_growth;
  return own.empty() ? rule.traction : own;
}

void CrackTips::find_energies(double time) {
  energies_.reset();
  const bool asked = by_balance_ && std::any_of(tips_.begin(), tips_.end(), [&](const CrackTip& tip) {
                       return may_grow(tip) && time >= tip.next_look && time >= tip.growth.due();
                     });
  if (asked) energies_ = settings_.energies();
  area_before_ = grown_area_;
}

void CrackTips::grow(double time, double dt) {
  for (CrackTip& tip : tips_) grow(tip, time, dt);
}

bool CrackTips::has_material(int crack, const Vec2& place) const {
  bool found = false;
  for (const int first : chosen_.groups(crack)) {
    each_hat(parts_.fields[first]->layout, place, [&](const std::array<int, 2>& node, double) {
      chosen_.each_field(first, node, [&](int field, NodeRef ref) {
        found = found || parts_.fields[field]->carries(ref.block, ref.node);
      });
    });
  }
  return found;
}

CrackTips::Way CrackTips::find_way(const CrackTip& tip, const Vec2& direction) const {
  const Vec2 place = place_of(tip);
  const GridLayout& layout = parts_.fields.front()->layout;
  const Vec2 cells(layout.cell(0), layout.cell(1));
  Way way;
  way.points = growth_points(place, direction, settings_.length, cells);
  const Vec2 seen = way.points.back() + kBeyond * cell_along(direction, cells) * direction;
  double nearest = 2.0;  // meeting nearest so far, in parts of the way
  for (std::size_t c = 0; c < cracks_.size(); ++c) {
    if (!cracks_[c].felt || !divide_one_body(tip.crack, static_cast<int>(c))) continue;
    const bool own = static_cast<int>(c) == tip.crack;
    const std::vector<Vec2>& line = cracks_[c].chain.line();
    const double cell = layout.smallest_cell();
    const int left_out = own ? segments_at_end(line, tip.end, 2.0 * kBeyond * cell) : 0;
    const Vec2* from = line.data() + (tip.end == 0 ? left_out : 0);
    const int points = static_cast<int>(line.size()) - left_out;
    if (points < 2) continue;
    const LineApproach met = find_approach(from, points, place, seen, kMet * cell, kBeyond * cell);
    if (!met.found || met.along >= nearest) continue;
    nearest = met.along;
    way.stop = own ? "it has met its own crack" : "it has met crack '" + cracks_[c].definition.name + "'";
    way.points.clear();
    if ((met.place - place).norm() > kMet * cell) way.points.push_back(met.place);
  }
  for (const Vec2& point : way.points) {
    for (int k = 0; k < 2; ++k) {
      const double cell = layout.in_cells(k, point[k]);
      if (cell >= 0.0 && cell <= layout.last_node(k)) continue;
      return {{}, "it has left the grid"};
    }
  }
  if (!way.points.empty() && !has_material(tip.crack, way.points.back())) return {{}, "it has left the material"};
  return way;
}

void CrackTips::grow(CrackTip& tip, double time, double dt) {
  Crack& crack = cracks_[tip.crack];
  Chain& chain = crack.chain;
  if (stopped(tip) || time < tip.next_look || tip.material < 0) return;
  const FractureMaterial& material = settings_.materials[tip.material];
  const double cell = parts_.fields.front()->layout.smallest_cell();
  tip.next_look = time + look_interval(dt, settings_.time_factor, cell, material.wave_speed);
  const TipRules rules = [&] {
    TipRules made = tip_rules(settings_.growth, settings_.alternate, material.constants,
                              material.elastic.value_or(ElasticConstants{}));
    made.longest = crack.definition.longest;
    made.longest_open = crack.definition.longest_open;
    return made;
  }();
  if (rules.first.criterion == FractureCriterion::none) return;
  TipState state;
  state.time = time;
  if (tip.status == ContourStatus::complete) state.j = tip.j;
  state.k = tip.k;
  state.normal_opening = tip.opening;
  state.shear_opening = tip.slip;
  state.direction = chain.direction(tip.end);
  state.initial_direction = tip.start_direction;
  state.length = chain.length();
  state.grown_area = area_before_;
  state.energies = energies_;
  state.open_length = chain.open_length([&](int point) { return tractions_.law_at(tip.crack, point) < 0; });
  const GrowthDecision decision = tip.growth.look(state, rules);
  tip.why = decision.reason;
  if (decision.released != 0.0) tip.energy_release = decision.released;
  if (decision.lacks_j && tip.status == ContourStatus::holds_other_tip) {
    chain.set_end(tip.end, CrackEnd::none);
    tip.why = describe(tip.status);
    return;
  }
  if (!decision.grows) {
    if (tip.running > 0.0 && time - tip.last_growth > 2.0 * settings_.length * cell / tip.running) tip.running = 0.0;
    return;
  }
  const Way way = find_way(tip, decision.direction);
  if (!way.stop.empty()) tip.why = way.stop;
  if (!way.points.empty()) {
    const GrowthRule& rule = decision.alternate ? rules.alternate : rules.first;
    lengthen(tip, state, decision, way.points, rule, dt);
  }
  if (!way.stop.empty()) chain.set_end(tip.end, CrackEnd::none);
}

void CrackTips::lengthen(CrackTip& tip, const TipState& state, const GrowthDecision& decision,
                         const std::vector<Vec2>& points, const GrowthRule& rule, double dt) {
  Crack& crack = cracks_[tip.crack];
  const double time = state.time;
  std::vector<Vec2> line{place_of(tip)};
  line.insert(line.end(), points.begin(), points.end());
  double length = 0.0;
  for (std::size_t k = 1; k < line.size(); ++k) {
    const double part = (line[k] - line[k - 1]).norm();
    length += part;
    grown_area_ += part * (axisymmetric(parts_.geometry) ? kPi * (line[k - 1][0] + line[k][0]) : parts_.across);
  }
  tip.growth.grown(state, decision, length);
  tip.speed = time > tip.last_growth ? length / (time - tip.last_growth) : 0.0;
  tip.running = decision.speed;
  if (decision.speed > 0.0) tip.speed = decision.speed;
  tip.last_growth = time;
  tip.released = tip.j + tip.zone;
  tip.angle = decision.angle;
  if (tip.growths == 0) tip.first_angle = decision.angle;
  ++tip.growths;
  tip.grown += length;
  tip.by_alternate = decision.alternate;
  if (tip.end == 0) std::reverse(line.begin(), line.end());
  jumps_.add(tip.crack, std::move(line));
  crack.chain.grow(tip.end, points);
  if (heating_ != nullptr && tip.j > 0.0) {
    const double wave_speed = settings_.materials[tip.material].wave_speed;
    const double thickness = crack.definition.thickness > 0.0 ? crack.definition.thickness : parts_.across;
    const double front = axisymmetric(parts_.geometry) ? 2.0 * kPi * points.back()[0] : thickness;
    heating_->released(static_cast<int>(&tip - tips_.data()), tip.j, front, length,
                       heated_steps(length, wave_speed, dt));
  }
  tractions_.grow(tip.crack, tip.end, static_cast<int>(points.size()), tractions_.law_of(law_of_growth(tip, rule)));
}

}  // namespace mpm
