// Growth of a tip and its direction: the criteria and directions of crack reference 5.2 and 5.3 as a tip meets them,
// the alternate rule, and growth at a set speed.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "kept_numbers.hpp"
#include "mpm/crack/fracture_criterion.hpp"
#include "mpm/crack/tip_growth.hpp"
#include "mpm/math/constants.hpp"

namespace mpm::test {
namespace crack_growth_test {

using C = FractureCriterion;
using D = GrowthDirection;

constexpr double kDegree = kPi / 180.0;

/// E = 2500 MPa, nu = 0.33 of crack reference 5.2.
constexpr ElasticConstants kPolymer{2.5e9, 0.33, 1200.0, false};

TipRules rules_of(C criterion, D direction = D::by_criterion) {
  TipRules rules;
  rules.first = {criterion, direction, ""};
  rules.constants.k_ic = 1e6;
  rules.constants.k_iic = 2e6;
  rules.constants.j_ic = 100.0;
  rules.constants.opening_ic = 1e-5;
  rules.constants.opening_iic = 3e-5;
  rules.elastic = kPolymer;
  return rules;
}

TipState tip_with(double k_one, double k_two) {
  TipState tip;
  tip.k = {k_one, k_two};
  tip.j = release_rate(tip.k, kPolymer);
  tip.direction = Vec2(0.6, 0.8);
  return tip;
}

bool grows(C criterion, const TipState& tip) { return TipGrowth().look(tip, rules_of(criterion)).grows; }

// --- criteria -------------------------------------------------------------------------------------------------------

TEST(CrackGrowth, ByHoopStress) {
  EXPECT_FALSE(grows(C::hoop_stress, tip_with(0.999e6, 0.0)));
  EXPECT_TRUE(grows(C::hoop_stress, tip_with(1.001e6, 0.0)));
  EXPECT_FALSE(grows(C::hoop_stress, tip_with(0.0, -0.865e6)));  // pure shear grows at 0.8660 K_Ic (reference 5.2)
  EXPECT_TRUE(grows(C::hoop_stress, tip_with(0.0, -0.867e6)));
  // Closed faces: only the shear counts, and the wing starts at 70.53 degrees (reference 7.11).
  EXPECT_FALSE(grows(C::hoop_stress, tip_with(-5e6, 0.0)));
  EXPECT_FALSE(grows(C::hoop_stress, tip_with(-1e6, 0.865e6)));
  const GrowthDecision wing = TipGrowth().look(tip_with(-1e6, 0.867e6), rules_of(C::hoop_stress));
  EXPECT_TRUE(wing.grows);
  EXPECT_NEAR(wing.angle, -70.5288 * kDegree, 1e-4 * kDegree);
}

TEST(CrackGrowth, ByEnergyDensity) {
  EXPECT_FALSE(grows(C::energy_density, tip_with(0.999e6, 0.0)));
  EXPECT_TRUE(grows(C::energy_density, tip_with(1.001e6, 0.0)));
  EXPECT_FALSE(grows(C::energy_density, tip_with(-5e6, 0.0)));
  const GrowthDecision mixed = TipGrowth().look(tip_with(1e6, 1e6), rules_of(C::energy_density));
  EXPECT_TRUE(mixed.grows);
  EXPECT_NEAR(mixed.angle, -53.01 * kDegree, 0.0051 * kDegree);  // the table of reference 5.2
}

TEST(CrackGrowth, ByEllipse) {
  // (K_I / 1)^2 + (K_II / 2)^2 > 1 [MPa sqrt(m)]: 0.6, 0.8 in its halves.
  EXPECT_FALSE(grows(C::elliptical, tip_with(0.599e6, 1.6e6)));
  EXPECT_TRUE(grows(C::elliptical, tip_with(0.601e6, 1.6e6)));
  EXPECT_TRUE(grows(C::elliptical, tip_with(0.601e6, -1.6e6)));
  EXPECT_FALSE(grows(C::elliptical, tip_with(-3e6, 1.99e6)));  // a negative K_I counts as 0
  EXPECT_TRUE(grows(C::elliptical, tip_with(-3e6, 2.01e6)));
  const GrowthDecision decision = TipGrowth().look(tip_with(2e6, 1e6), rules_of(C::elliptical));
  EXPECT_NEAR(decision.angle, -40.208 * kDegree, 0.0005 * kDegree);  // the hoop angle of ratio 1/2
}

TEST(CrackGrowth, ByOpening) {
  TipState tip;  // it needs no J
  const auto grows_with = [&tip](double normal, double shear, const TipRules& rules) {
    tip.normal_opening = normal;
    tip.shear_opening = shear;
    return TipGrowth().look(tip, rules).grows;
  };
  TipRules rules = rules_of(C::opening);
  EXPECT_FALSE(grows_with(0.99e-5, 2.99e-5, rules));
  EXPECT_TRUE(grows_with(1.01e-5, 0.0, rules));
  EXPECT_TRUE(grows_with(0.0, 3.01e-5, rules));
  EXPECT_TRUE(grows_with(0.0, -3.01e-5, rules));
  EXPECT_FALSE(grows_with(-2e-5, 0.0, rules));  // faces that lap over each other are not open
  rules.constants.opening_ic = 0.0;             // a limit that is not given does not count
  EXPECT_FALSE(grows_with(1.0, 0.0, rules));
  rules.constants.opening_iic = 0.0;
  rules.constants.opening_ic = 1e-5;
  EXPECT_FALSE(grows_with(0.0, 1.0, rules));
}

TEST(CrackGrowth, ByReleaseRate) {
  TipState tip;
  tip.j = 99.9;
  EXPECT_FALSE(grows(C::release_rate, tip));
  tip.j = 100.0;
  EXPECT_TRUE(grows(C::release_rate, tip));
}

TEST(CrackGrowth, NotWithoutJ) {
  TipState tip = tip_with(5e6, 5e6);
  tip.j.reset();
  for (const C criterion : {C::none, C::hoop_stress, C::energy_density, C::elliptical, C::release_rate}) {
    EXPECT_FALSE(grows(criterion, tip));
  }
  const GrowthDecision decision = TipGrowth().look(tip, rules_of(C::hoop_stress));
  EXPECT_STREQ(decision.reason, "J could not be found");
  EXPECT_EQ(decision.direction, tip.direction);
}

TEST(CrackGrowth, RefusesWhatIsNotANumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  TipState tip = tip_with(1e6, 0.0);
  tip.j = nan;
  EXPECT_THROW(grows(C::release_rate, tip), FractureError);
  tip = tip_with(1e6, nan);
  EXPECT_THROW(grows(C::hoop_stress, tip), FractureError);
  tip = tip_with(1e6, 0.0);
  tip.shear_opening = nan;
  EXPECT_THROW(grows(C::opening, tip), FractureError);
  tip = tip_with(1e6, 0.0);
  tip.direction = Vec2::Zero();
  EXPECT_THROW(grows(C::hoop_stress, tip), FractureError);
  TipRules rules = rules_of(C::energy_balance);
  rules.constants.speed = 0.1;
  EXPECT_THROW(TipGrowth().look(tip_with(1e6, 0.0), rules), FractureError);  // without energies
}

// --- directions -----------------------------------------------------------------------------------------------------

TEST(CrackGrowth, Directions) {
  TipState tip = tip_with(1e6, 1e6);  // hoop angle -53.13 degrees: cosine 3/5, sine -4/5 (reference 5.2)
  tip.initial_direction = Vec2(0.0, 1.0);
  tip.normal_opening = 4e-6;
  tip.shear_opening = 3e-6;
  const auto direction = [&tip](D which) { return TipGrowth().look(tip, rules_of(C::hoop_stress, which)).direction; };
  const Vec2 ahead(0.6, 0.8), left(-0.8, 0.6);
  EXPECT_LT((direction(D::by_criterion) - (0.6 * ahead - 0.8 * left)).norm(), 1e-12);
  EXPECT_LT((direction(D::self_similar) - ahead).norm(), 1e-15);
  // (d_z, -d_x) / |d| for the opening d = 4 left + 3 ahead = (-1.4, 4.8), by hand.
  EXPECT_LT((direction(D::normal_to_opening) - Vec2(4.8, 1.4) / 5.0).norm(), 1e-12);
  const double hoop = hoop_angle(4.0, 3.0);
  EXPECT_LT((direction(D::hoop_of_opening) - (std::cos(hoop) * ahead + std::sin(hoop) * left)).norm(), 1e-12);
  EXPECT_LT(hoop, 0.0);
  EXPECT_LT((direction(D::initial) - Vec2(0.0, 1.0)).norm(), 1e-12);

  tip.shear_opening = 0.0;  // pure opening goes on as it is
  EXPECT_LT((direction(D::normal_to_opening) - ahead).norm(), 1e-12);
  tip.normal_opening = 0.0;  // and so does a crack without any
  EXPECT_LT((direction(D::normal_to_opening) - ahead).norm(), 1e-12);
  EXPECT_LT((direction(D::hoop_of_opening) - ahead).norm(), 1e-12);
}

// --- the alternate rule
// -----------------------------------------------------------------------------------------------

TEST(CrackGrowth, AlternateRuleUntilTheFirstHasGrown) {
  TipRules rules = rules_of(C::hoop_stress);
  rules.alternate = {C::opening, D::self_similar, ""};
  TipState slid = tip_with(0.1e6, 0.1e6), torn = tip_with(2e6, 2e6);
  slid.shear_opening = torn.shear_opening = 5e-5;
  TipGrowth growth;
  GrowthDecision now = growth.look(slid, rules);
  EXPECT_TRUE(now.grows);
  EXPECT_TRUE(now.alternate);
  EXPECT_EQ(now.angle, 0.0);  // by the alternate's direction
  growth.grown(slid, now, 1e-3);
  EXPECT_TRUE(growth.alternate_is_open());
  EXPECT_TRUE(growth.look(slid, rules).alternate);

  now = growth.look(torn, rules);  // the first goes before it
  EXPECT_TRUE(now.grows);
  EXPECT_FALSE(now.alternate);
  EXPECT_NEAR(now.angle, -53.130 * kDegree, 0.0005 * kDegree);
  EXPECT_TRUE(growth.look(slid, rules).alternate);  // not yet, for a decision is not growth
  growth.grown(torn, now, 1e-3);
  EXPECT_FALSE(growth.look(slid, rules).grows);  // off for good
  EXPECT_FALSE(growth.alternate_is_open());
  EXPECT_TRUE(growth.look(torn, rules).grows);
}

TEST(CrackGrowth, AMaterialsRulesGoFirst) {
  const GrowthRule scene_first{C::hoop_stress, D::by_criterion, "glue"};
  const GrowthRule scene_second{C::opening, D::by_criterion, ""};
  FractureConstants constants;
  EXPECT_EQ(tip_rules(scene_first, scene_second, constants, kPolymer).first.traction, "glue");
  constants.growth = GrowthRule{C::release_rate, D::initial, ""};
  const TipRules rules = tip_rules(scene_first, scene_second, constants, kPolymer);
  EXPECT_EQ(rules.first.criterion, C::release_rate);
  EXPECT_EQ(rules.alternate.criterion, C::opening);
}

TEST(CrackGrowth, EndsAtTheLongestCrack) {
  TipRules rules = rules_of(C::release_rate);
  TipState tip = tip_with(5e6, 0.0);
  tip.length = 0.05;
  tip.open_length = 0.02;
  rules.longest = 0.051;
  rules.longest_open = 0.021;
  EXPECT_TRUE(TipGrowth().look(tip, rules).grows);
  rules.longest = 0.05;
  EXPECT_FALSE(TipGrowth().look(tip, rules).grows);
  rules.longest = 0.0;
  rules.longest_open = 0.02;
  EXPECT_FALSE(TipGrowth().look(tip, rules).grows);
}

// --- growth at a set speed
// --------------------------------------------------------------------------------------------

TipRules steady_rules() {
  TipRules rules = rules_of(C::steady_state);
  rules.constants.speed = 100.0;
  return rules;
}

// Reference 7.15: the tip is at x_0 + c (t - t_0) within one length, also when looks are at odd times; and it ends.
TEST(CrackGrowth, SteadyStateKeepsItsSpeed) {
  TipRules rules = steady_rules();
  rules.constants.start_time = 2e-4;
  rules.constants.longest = 0.1;
  const double length = 1e-3, look = 3.7e-6;  // 10 us a length
  TipGrowth growth;
  TipState tip;
  tip.length = 0.02;
  for (int i = 0; i < 400; ++i) {
    tip.time = i * look;
    const GrowthDecision now = growth.look(tip, rules);
    if (now.grows) {
      EXPECT_EQ(now.speed, 100.0);
      growth.grown(tip, now, length);
      tip.length += length;
    }
    if (tip.time < 2e-4) {
      EXPECT_EQ(tip.length, 0.02);
      continue;
    }
    // The first length grows at once, and a look comes late by `look` at most.
    const double expected = std::min(0.02 + 100.0 * (tip.time - 2e-4), 0.1);
    EXPECT_GT(tip.length, expected - 100.0 * look - 1e-12);
    EXPECT_LT(tip.length, expected + length + 1e-12);
  }
  EXPECT_NEAR(tip.length, 0.1, 1e-12);  // after 0.8 ms of growth, of 1.3
  EXPECT_STREQ(growth.look(tip, rules).reason, "steady growth has reached its longest length");
}

TEST(CrackGrowth, SteadyStateStartsByJAndGoesOnWithoutIt) {
  const TipRules rules = steady_rules();
  TipGrowth growth;
  TipState tip;
  tip.j = 99.0;
  EXPECT_FALSE(growth.look(tip, rules).grows);
  tip.j = 100.0;
  const GrowthDecision now = growth.look(tip, rules);
  EXPECT_TRUE(now.grows);
  growth.grown(tip, now, 1e-3);
  EXPECT_DOUBLE_EQ(growth.due(), 1e-5);  // t + da / c
  tip.j.reset();
  tip.time = 0.99e-5;
  EXPECT_FALSE(growth.look(tip, rules).grows);
  tip.time = 1.01e-5;
  EXPECT_TRUE(growth.look(tip, rules).grows);
}

TEST(CrackGrowth, SteadyStateMakesGoodOneLengthAtMost) {
  const TipRules rules = steady_rules();
  TipGrowth growth;
  TipState tip;
  tip.j = 200.0;
  growth.grown(tip, growth.look(tip, rules), 1e-3);
  tip.time = 1e-3;  // a hundred lengths late
  for (const bool expected : {true, true, false}) {
    const GrowthDecision now = growth.look(tip, rules);
    EXPECT_EQ(now.grows, expected);
    if (now.grows) growth.grown(tip, now, 1e-3);
    tip.time += 1e-9;
  }
}

TEST(CrackGrowth, SteadyStateGoesItsWay) {
  TipRules rules = steady_rules();
  TipState tip = tip_with(5e6, 5e6);
  EXPECT_LT((TipGrowth().look(tip, rules).direction - tip.direction).norm(), 1e-15);
  rules.constants.way = {-3.0, 4.0};
  EXPECT_LT((TipGrowth().look(tip, rules).direction - Vec2(-0.6, 0.8)).norm(), 1e-12);
}

TEST(CrackGrowth, TimeBetweenLooks) {
  EXPECT_DOUBLE_EQ(look_interval(1e-7, 0.5, 1e-3, 1000.0), 5e-7);
  EXPECT_DOUBLE_EQ(look_interval(1e-6, 0.5, 1e-3, 1000.0), 1e-6);
}

// --- memory ---------------------------------------------------------------------------------------------------------

// A tip that is kept and taken up again decides as one that went on, and not as a new one.
TEST(CrackGrowth, GoesOnFromWhatIsKept) {
  TipRules rules = rules_of(C::energy_balance);
  rules.constants.speed = 0.05;
  TipGrowth growth, resumed;
  TipState tip;
  tip.j = 150.0;
  tip.energies = BodyEnergies{3.0, 0.5};
  for (int i = 0; i < 3; ++i) {
    const GrowthDecision now = growth.look(tip, rules);
    ASSERT_TRUE(now.grows);
    growth.grown(tip, now, 1e-3);
    tip.time = growth.due();
    tip.grown_area += 1e-3;
    tip.energies->potential -= 0.150 + 0.01 * i;
    tip.energies->plastic += 1e-3;
  }
  KeptNumbers kept;
  growth.serialise(kept);
  kept.read();
  resumed.serialise(kept);
  EXPECT_EQ(resumed.due(), growth.due());
  EXPECT_FALSE(resumed.alternate_is_open());
  tip.j = 0.0;  // it has started
  const GrowthDecision now = growth.look(tip, rules), again = resumed.look(tip, rules);
  EXPECT_TRUE(now.grows);
  EXPECT_EQ(now.speed, again.speed);
  EXPECT_GT(now.speed, 0.05 * kPolymer.dilatational_speed());
  EXPECT_FALSE(TipGrowth().look(tip, rules).grows);
}

}  // namespace crack_growth_test
}  // namespace mpm::test
