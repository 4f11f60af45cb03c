#include "mpm/crack/tip_growth.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mpm/crack/fracture_criterion.hpp"

namespace mpm {
namespace {

void refuse_broken_tip(const TipState& tip) {
  const auto refuse = [&tip](const char* what) {
    throw FractureError(
        fmt::format("{} of a crack's tip is not a number at t = {:g} s: look for what broke near the tip before that "
                    "time, or take a shorter step",
                    what, tip.time));
  };
  if (tip.j && !std::isfinite(*tip.j)) refuse("J");
  if (tip.j && !(std::isfinite(tip.k.one) && std::isfinite(tip.k.two))) refuse("the stress intensity");
  if (!(std::isfinite(tip.normal_opening) && std::isfinite(tip.shear_opening))) refuse("the opening");
  if (!(tip.direction.allFinite() && tip.direction.norm() > 0.0)) refuse("the direction");
}

Vec2 direction_turned(const Vec2& direction, double angle) { return Eigen::Rotation2Dd(angle) * direction; }

double angle_between_directions(const Vec2& from, const Vec2& to) {
  return std::atan2(from.x() * to.y() - from.y() * to.x(), from.dot(to));
}

bool criterion_sets_speed(FractureCriterion criterion) {
  return criterion == FractureCriterion::steady_state || criterion == FractureCriterion::energy_balance;
}

StressIntensity opening_intensity(const StressIntensity& k) { return {std::max(k.one, 0.0), k.two}; }

/// True if a criterion is exceeded, of those that compare a measure with the material's and remember nothing.
bool criterion_exceeded(FractureCriterion criterion, const TipState& tip, const TipRules& rules) {
  const FractureConstants& constants = rules.constants;
  const StressIntensity k = opening_intensity(tip.k);
  switch (criterion) {
    case FractureCriterion::hoop_stress:
      return hoop_equivalent(k) > constants.k_ic;
    case FractureCriterion::energy_density:
      return density_equivalent(k, rules.elastic.kappa()) > constants.k_ic;
    case FractureCriterion::elliptical:
      return elliptical_measure(k, constants) > 1.0;
    case FractureCriterion::opening:
      return (constants.opening_iic > 0.0 && std::abs(tip.shear_opening) > constants.opening_iic) ||
             (constants.opening_ic > 0.0 && tip.normal_opening > constants.opening_ic);
    case FractureCriterion::release_rate:
      return *tip.j >= constants.j_ic;
    default:
      return false;
  }
}

double angle_by_criterion(FractureCriterion criterion, const TipState& tip, const FractureConstants& constants,
                          double kappa) {
  const StressIntensity k = opening_intensity(tip.k);
  switch (criterion) {
    case FractureCriterion::hoop_stress:
    case FractureCriterion::elliptical:
      return hoop_angle(k.one, k.two);
    case FractureCriterion::energy_density:
      return density_angle(k.one, k.two, kappa);
    case FractureCriterion::steady_state: {
      const Vec2 way(constants.way[0], constants.way[1]);
      return way.norm() > 0.0 ? angle_between_directions(tip.direction, way) : 0.0;
    }
    default:
      return 0.0;
  }
}

}  // namespace

TipRules tip_rules(const GrowthRule& first, const GrowthRule& alternate, const FractureConstants& constants,
                   const ElasticConstants& elastic) {
  TipRules rules;
  rules.first = constants.growth.value_or(first);
  rules.alternate = constants.alternate.value_or(alternate);
  rules.constants = constants;
  rules.elastic = elastic;
  return rules;
}

double growth_angle(const GrowthRule& rule, const TipState& tip, const FractureConstants& constants, double kappa) {
  const double normal = std::max(tip.normal_opening, 0.0);
  switch (rule.direction) {
    case GrowthDirection::by_criterion:
      return angle_by_criterion(rule.criterion, tip, constants, kappa);
    case GrowthDirection::self_similar:
      return 0.0;
    case GrowthDirection::normal_to_opening:
      return normal > 0.0 || tip.shear_opening != 0.0 ? std::atan2(-tip.shear_opening, normal) : 0.0;
    case GrowthDirection::hoop_of_opening:
      return hoop_angle(normal, tip.shear_opening);
    case GrowthDirection::initial:
      return angle_between_directions(tip.direction, tip.initial_direction);
  }
  return 0.0;
}

double look_interval(double step, double factor, double cell, double wave_speed) {
  return std::max(step, factor * cell / wave_speed);
}

GrowthDecision TipGrowth::look(const TipState& tip, const TipRules& rules) {
  refuse_broken_tip(tip);
  GrowthDecision decision;
  decision.direction = tip.direction.normalized();
  if ((rules.longest > 0.0 && tip.length >= rules.longest) ||
      (rules.longest_open > 0.0 && tip.open_length >= rules.longest_open)) {
    decision.reason = "the crack is as long as it may become";
    return decision;
  }
  const GrowthRule* rule = &rules.first;
  const GrowthDecision first = judge(rules.first, tip, rules);
  decision.grows = first.grows;
  decision.reason = first.reason;
  decision.speed = first.speed;
  decision.released = first.released;
  decision.lacks_j = first.lacks_j;
  if (!first.grows && !first_has_grown_ && rules.alternate.criterion != FractureCriterion::none) {
    const GrowthDecision second = judge(rules.alternate, tip, rules);
    decision.lacks_j = first.lacks_j && second.lacks_j;
    if (second.grows) {
      decision.grows = decision.alternate = true;
      decision.reason = second.reason;
      decision.speed = 0.0;
      rule = &rules.alternate;
    }
  }
  if (!decision.grows) return decision;
  decision.angle = growth_angle(*rule, tip, rules.constants, rules.elastic.kappa());
  decision.direction = direction_turned(decision.direction, decision.angle);
  return decision;
}

GrowthDecision TipGrowth::judge(const GrowthRule& rule, const TipState& tip, const TipRules& rules) {
  GrowthDecision decision;
  if (rule.criterion == FractureCriterion::none) {
    decision.reason = "no criterion is given";
  } else if (criterion_sets_speed(rule.criterion)) {
    if (tip.time < due_) {
      decision.reason = "the tip is as far as its speed takes it";
      return decision;
    }
    if (rule.criterion == FractureCriterion::steady_state) {
      judge_steady(tip, rules.constants, decision);
    } else {
      judge_balance(tip, rules, decision);
    }
    if (!decision.grows) due_ = -kInfinity;  // forgets what was missed while it rested
  } else if (rule.criterion != FractureCriterion::opening && !tip.j) {
    decision.lacks_j = true;
    decision.reason = "J could not be found";
  } else {
    decision.grows = criterion_exceeded(rule.criterion, tip, rules);
    decision.reason = decision.grows ? "the criterion is exceeded" : "the criterion is not reached";
  }
  return decision;
}

void TipGrowth::judge_steady(const TipState& tip, const FractureConstants& constants, GrowthDecision& decision) {
  if (constants.longest > 0.0 && tip.length >= constants.longest) {
    decision.reason = "steady growth has reached its longest length";
    return;
  }
  const bool by_time = constants.start_time >= 0.0;
  if (!started_) started_ = by_time ? tip.time >= constants.start_time : tip.j && *tip.j >= constants.j_ic;
  decision.grows = started_;
  decision.lacks_j = !started_ && !by_time && !tip.j;
  decision.speed = started_ ? constants.speed : 0.0;
  decision.reason = started_ ? "steady growth" : (by_time ? "before the start of growth" : "J has not reached j_ic");
}

void TipGrowth::judge_balance(const TipState& tip, const TipRules& rules, GrowthDecision& decision) {
  if (!tip.energies) {
    throw FractureError(
        fmt::format("criterion 'energy_balance' was asked without the energies of the body at t = {:g} s", tip.time));
  }
  if (!balance_.known() && !(tip.j && *tip.j >= rules.constants.j_ic)) {
    decision.lacks_j = !tip.j;
    decision.reason = "J has not reached j_ic";
    return;
  }
  const EnergyBalance::Speed now =
      balance_.look(tip.grown_area, *tip.energies, rules.constants, rules.elastic.dilatational_speed());
  decision.grows = now.grows;
  decision.released = now.released;
  decision.speed = now.speed;
  decision.reason = now.grows ? "the balance of energy" : "less energy is released than the faces take";
}

void TipGrowth::grown(const TipState& tip, const GrowthDecision& decision, double length) {
  if (!decision.alternate) first_has_grown_ = true;
  if (decision.speed > 0.0) {
    const double interval = length / decision.speed;
    const double was_due = std::isfinite(due_) ? std::max(due_, tip.time - interval) : tip.time;
    due_ = was_due + interval;
  }
  if (tip.energies && decision.speed > 0.0) balance_.grown(tip.grown_area, *tip.energies);
}

void TipGrowth::serialise(StateArchive& archive) {
  archive.value("first has grown", first_has_grown_);
  archive.value("started", started_);
  archive.value("due", due_);
  const StateArchive::Group group(archive, "balance");
  balance_.serialise(archive);
}

}  // namespace mpm
