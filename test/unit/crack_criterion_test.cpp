// Criteria of growth as functions of numbers: the table of crack reference 5.2, and what does not come from the same
// formula: maxima and minima found by scans of the field.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "mpm/crack/crack_tip_field.hpp"
#include "mpm/crack/fracture_criterion.hpp"
#include "mpm/math/constants.hpp"

namespace mpm::test {
namespace crack_criterion_test {

constexpr double kDegree = kPi / 180.0;

/// K_II / K_I, hoop angle, K_eq / |K|, angles of least energy density at nu = 0.33 and 0.25 (plane strain).
struct CriterionRow {
  double ratio, hoop, equivalent, density_33, density_25;
};
const std::vector<CriterionRow> kCriterionTable = {
    {0.0, 0.0, 1.0, 0.0, 0.0},
    {0.1, -11.203, 1.0097, -11.10, -11.00},
    {0.25, -25.333, 1.0529, -24.43, -23.62},
    {0.5, -40.208, 1.1474, -38.35, -36.25},
    {1.0, -53.130, 1.2649, -53.01, -49.91},
    {2.0, -61.342, 1.2972, -65.66, -62.29},
    {4.0, -65.835, 1.2580, -74.02, -70.71},
    {kInfinity, -70.529, 1.1547, -83.49, -80.41},
};

StressIntensity k_of_ratio(double ratio) {
  return std::isinf(ratio) ? StressIntensity{0.0, 1.0} : StressIntensity{1.0, ratio};
}

TEST(CrackCriterion, TableOfTheReference) {
  for (const CriterionRow& row : kCriterionTable) {
    for (const double sign : {1.0, -1.0}) {
      StressIntensity k = k_of_ratio(row.ratio);
      k.two *= sign;
      EXPECT_NEAR(hoop_angle(k.one, k.two), sign * row.hoop * kDegree, 0.0005 * kDegree) << row.ratio;
      EXPECT_NEAR(hoop_equivalent(k) / std::hypot(k.one, k.two), row.equivalent, 5e-5) << row.ratio;
      EXPECT_NEAR(density_angle(k.one, k.two, 1.68), sign * row.density_33 * kDegree, 0.0051 * kDegree) << row.ratio;
      EXPECT_NEAR(density_angle(k.one, k.two, 2.0), sign * row.density_25 * kDegree, 0.0051 * kDegree) << row.ratio;
    }
  }
}

TEST(CrackCriterion, PureModes) {
  EXPECT_NEAR(hoop_angle(0.0, 2.0), -std::acos(1.0 / 3.0), 1e-15);          // 70.5288 degrees
  EXPECT_NEAR(hoop_equivalent({0.0, 0.8660254037844386}), 1.0, 1e-15);      // sqrt(3) / 2 K_Ic
  EXPECT_NEAR(density_angle(0.0, 1.0, 2.0), -std::acos(1.0 / 6.0), 1e-12);  // (kappa - 1) / 6
  EXPECT_EQ(hoop_angle(3.0, 0.0), 0.0);
  EXPECT_EQ(hoop_angle(0.0, 0.0), 0.0);
  EXPECT_EQ(density_angle(3.0, 0.0, 1.68), 0.0);
  EXPECT_EQ(density_angle(0.0, 0.0, 1.68), 0.0);
  EXPECT_DOUBLE_EQ(hoop_equivalent({3.0, 0.0}), 3.0);
  EXPECT_DOUBLE_EQ(density_equivalent({3.0, 0.0}, 1.68), 3.0);
  // A hundred-millionth of shear turns by twice its ratio, to round-off.
  EXPECT_NEAR(hoop_angle(1.0, 1e-8), -2e-8, 1e-20);
  EXPECT_NEAR(density_angle(1.0, 1e-8, 1.68), -2e-8, 1e-15);
}

// The stress across lines through the tip, taken from the field itself.
TEST(CrackCriterion, HoopAngleIsWhereTheFieldsHoopStressIsLargest) {
  const ElasticConstants constants{2.5e9, 0.33, 0.0, false};
  for (const StressIntensity& k : {StressIntensity{1.0, 0.3}, {1.0, -2.0}, {0.1, 1.0}, {-0.5, 1.0}, {-2.0, -1.0}}) {
    const CrackTipField field(k, 0.0, constants);
    double best = -kInfinity, best_angle = 0.0;
    constexpr int kParts = 36000;
    for (int i = 1; i < kParts; ++i) {
      const double angle = kPi * (2.0 * i / kParts - 1.0);
      const Vec2 along(std::cos(angle), std::sin(angle)), across(-along.y(), along.x());
      const double hoop = across.dot(field.at(along).stress * across);
      if (hoop <= best) continue;
      best = hoop;
      best_angle = angle;
    }
    EXPECT_NEAR(hoop_angle(k.one, k.two), best_angle, kPi / kParts * 1.01) << k.one << " " << k.two;
    EXPECT_NEAR(hoop_equivalent(k), std::sqrt(2.0 * kPi) * best, 1e-6);  // r = 1
    EXPECT_GE(std::abs(hoop_angle(k.one, k.two)), k.one < 0.0 ? std::acos(1.0 / 3.0) : 0.0);
  }
}

// The energy of the field itself: no density within the first hump is less than that at the angle found, and it is a
// minimum; its size is that of the criterion, S = (1 - 2 nu) K_eq^2 / (4 pi G) of mode I.
TEST(CrackCriterion, DensityAngleIsAMinimumOfTheFieldsEnergy) {
  for (const double poisson : {0.05, 0.2, 0.33, 0.45, 0.499}) {
    const ElasticConstants constants{2.5e9, poisson, 0.0, false};
    const double kappa = constants.kappa();
    for (const double ratio : {0.02, 0.3, 1.0, 5.0, 1000.0}) {
      const StressIntensity k{1e6, ratio * 1e6};
      const CrackTipField field(k, 0.0, constants);
      const auto energy = [&field](double angle) {
        const TipFieldValue value = field.at(Vec2(std::cos(angle), std::sin(angle)));
        return 0.5 * value.stress.cwiseProduct(value.gradient).sum();
      };
      const double angle = density_angle(k.one, k.two, kappa);
      EXPECT_LT(angle, 0.0);
      EXPECT_LT(energy(angle), energy(angle + 1e-3));
      EXPECT_LT(energy(angle), energy(angle - 1e-3));
      double before = energy(0.0);
      for (int i = 1; i < 200; ++i) {  // it falls all the way from 0 to there: it is the first minimum
        const double now = energy(angle * i / 200.0);
        EXPECT_LT(now, before);
        before = now;
      }
      const double equivalent = density_equivalent(k, kappa);
      EXPECT_NEAR(energy(angle),
                  (1.0 - 2.0 * poisson) * equivalent * equivalent / (4.0 * kPi * constants.shear_modulus()),
                  1e-9 * energy(angle));
    }
  }
}

TEST(CrackCriterion, DensityTakesANegativeKForZero) {
  EXPECT_DOUBLE_EQ(density_angle(-5.0, 1.0, 1.68), density_angle(0.0, 1.0, 1.68));
  EXPECT_DOUBLE_EQ(density_equivalent({-5.0, 1.0}, 1.68), density_equivalent({0.0, 1.0}, 1.68));
}

TEST(CrackCriterion, Ellipse) {
  FractureConstants constants;
  constants.k_ic = 2.0;
  constants.k_iic = 4.0;
  EXPECT_DOUBLE_EQ(elliptical_measure({2.0, 0.0}, constants), 1.0);
  EXPECT_DOUBLE_EQ(elliptical_measure({1.0, -2.0}, constants), 0.5);
  constants.k_exponent = 1.5;
  constants.k_ii_exponent = 3.0;
  EXPECT_DOUBLE_EQ(elliptical_measure({-1.0, -2.0}, constants), 0.125);  // no power of a negative number
  EXPECT_DOUBLE_EQ(elliptical_measure({2.0, 4.0}, constants), 2.0);
}

TEST(CrackCriterion, FaultsNameTheConstant) {
  const ElasticConstants elastic{2.5e9, 0.33, 1200.0, false};
  const auto fault = [&elastic](FractureCriterion criterion, const FractureConstants& constants) {
    return criterion_fault({criterion, GrowthDirection::by_criterion, ""}, constants, &elastic);
  };
  const auto names = [](const std::string& text, const char* word) { return text.find(word) != std::string::npos; };
  using C = FractureCriterion;
  FractureConstants nothing, all;
  all.k_ic = all.k_iic = 1e6;
  all.j_ic = 100.0;
  all.opening_iic = 1e-6;
  all.speed = 0.1;
  EXPECT_EQ(fault(C::none, nothing), "");
  const std::vector<std::pair<C, const char*>> first_missing = {
      {C::hoop_stress, "k_ic"}, {C::steady_state, "speed"}, {C::energy_balance, "j_ic"}, {C::energy_density, "k_ic"},
      {C::elliptical, "k_ic"},  {C::opening, "opening_ic"}, {C::release_rate, "j_ic"}};
  for (const auto& [criterion, constant] : first_missing) {
    const std::string text = fault(criterion, nothing);
    EXPECT_TRUE(names(text, constant)) << text;
    EXPECT_TRUE(names(text, kFractureCriterionNames[static_cast<int>(criterion)])) << text;
    EXPECT_EQ(fault(criterion, all), "");
  }
  FractureConstants some = all;
  some.k_iic = 0.0;
  EXPECT_TRUE(names(fault(C::elliptical, some), "k_iic"));
  some = all;
  some.k_exponent = 0.0;
  EXPECT_TRUE(names(fault(C::elliptical, some), "k_exponent"));
  some = all;
  some.j_ic = 0.0;
  EXPECT_TRUE(names(fault(C::steady_state, some), "start_time"));
  some.start_time = 0.0;
  EXPECT_EQ(fault(C::steady_state, some), "");
  some = all;
  some.speed = 10.0;  // the part of the wave speed
  EXPECT_TRUE(names(fault(C::energy_balance, some), "speed"));
  some = all;
  some.gain = 0.0;
  EXPECT_TRUE(names(fault(C::energy_balance, some), "gain"));

  // Refuses as the alternate rule what sets a speed.
  for (const C criterion : {C::steady_state, C::energy_balance}) {
    const GrowthRule rule{criterion, GrowthDirection::by_criterion, ""};
    EXPECT_TRUE(names(criterion_fault(rule, all, &elastic, true), "alternate"));
  }
  EXPECT_EQ(criterion_fault({C::release_rate, GrowthDirection::by_criterion, ""}, all, &elastic, true), "");
  // Without isotropic constants there is no K, but J and openings.
  for (const C criterion : {C::hoop_stress, C::energy_density, C::elliptical}) {
    EXPECT_TRUE(names(criterion_fault({criterion, GrowthDirection::self_similar, ""}, all, nullptr), "isotropic"));
  }
  EXPECT_EQ(criterion_fault({C::opening, GrowthDirection::by_criterion, ""}, all, nullptr), "");
  // No minimum of the density ahead of the tip, and a division by kappa - 1.
  for (const double poisson : {0.0, 0.5}) {
    const ElasticConstants limit{2.5e9, poisson, 1200.0, false};
    EXPECT_TRUE(names(criterion_fault({C::energy_density, GrowthDirection::by_criterion, ""}, all, &limit), "Poisson"));
  }
}

}  // namespace crack_criterion_test
}  // namespace mpm::test
