// Tractions whose directions share their damage: the coupled sawtooth and the mixed law. Values of crack reference 5.5,
// checks, in MPa, mm and N/mm there.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "mpm/crack/crack_error.hpp"
#include "mpm/crack/traction_law.hpp"
#include "mpm/math/constants.hpp"

namespace mpm::test {
namespace crack_traction_coupled_test {

constexpr double kMpa = 1e6, kMm = 1e-3, kNmm = 1e3;  // N/mm in J/m^2

/// I: 10 MPa, 0.1 mm, elastic to 0.01 mm, G_c 0.5 N/mm; II: 20 MPa, 0.2 mm, G_c 2 N/mm.
TractionLawDefinition pair_definition(TractionKind kind, double shear_elastic = 0.02) {
  TractionLawDefinition definition;
  definition.kind = kind;
  definition.normal = {10 * kMpa, 0.1 * kMm, 0.01 * kMm, 0.0, 0.0, 0.0, 0.0};
  definition.shear = {20 * kMpa, 0.2 * kMm, shear_elastic * kMm, 0.0, 0.0, 0.0, 0.0};
  return definition;
}

/// The mixed law with curves of another shape.
TractionLaw curved_law(TractionKind curve) {
  TractionLawDefinition definition = pair_definition(TractionKind::mixed);
  definition.curve = curve;
  definition.normal.decay = 3.0;
  definition.shear.decay = 2.0;
  definition.normal.strength_2 = 5 * kMpa;
  definition.normal.elastic_2 = 0.03 * kMm;
  definition.shear.strength_2 = 8 * kMpa;
  definition.shear.elastic_2 = 0.1 * kMm;
  return TractionLaw(definition);
}

double sum_of_ratios(const TractionLaw& law, const TractionState& state) {
  return state.dissipated[0] / law.toughness(CrackMode::normal) + state.dissipated[1] / law.toughness(CrackMode::shear);
}

// Opening and sliding grow alike. Failure at |u| = 0.1265 mm: (u/0.1)^2 + (u/0.2)^2 = 1, u = 0.2 / sqrt(5).
TEST(CrackTractionCoupled, FailsAtTheReferencesPoint) {
  for (const TractionKind kind : {TractionKind::coupled, TractionKind::mixed}) {
    const TractionLaw law(pair_definition(kind));
    EXPECT_DOUBLE_EQ(law.toughness(CrackMode::normal), 0.5 * kNmm);
    TractionState state;
    for (double u = 0.0; !state.failed; u += 1e-5 * kMm) law.advance(u, u, 0.0, state);
    EXPECT_NEAR(std::hypot(state.opening.normal, state.opening.shear), 0.2 * std::sqrt(0.4) * kMm,
                2e-5 * kMm);  // a step; 0.1265
    EXPECT_NEAR(state.dissipated[0], 0.4 * kNmm, 1e-9 * kNmm);
    EXPECT_NEAR(state.dissipated[1], 0.4 * kNmm, 1e-9 * kNmm);
    EXPECT_NEAR(state.work, 0.8 * kNmm, 1e-9 * kNmm);
    EXPECT_EQ(law.advance(0.01 * kMm, 0.01 * kMm, 0.0, state).normal, 0.0);
    EXPECT_EQ(law.stored(state, 0.01 * kMm, 0.01 * kMm), 0.0);
  }
}

// With u_te = 0.08 mm: at the same opening, with G_I = 0.4524 and G_II = 0.1131 N/mm (four digits there).
TEST(CrackTractionMixed, FailsAtTheReferencesPointWithUnequalCurves) {
  const TractionLaw law(pair_definition(TractionKind::mixed, 0.08));
  TractionState state;
  for (double u = 0.0; !state.failed; u += 2e-5 * kMm) law.advance(u, u, 0.0, state);
  EXPECT_NEAR(std::hypot(state.opening.normal, state.opening.shear), 0.1265 * kMm, 1e-4 * kMm);
  EXPECT_NEAR(state.dissipated[0], 0.4524 * kNmm, 1e-4 * kNmm);
  EXPECT_NEAR(state.dissipated[1], 0.1131 * kNmm, 1e-4 * kNmm);
  EXPECT_NEAR(sum_of_ratios(law, state), 0.961, 1e-3);
}

/// Ways from the closed crack to failure, by part of it: normal and shear opening [mm].
std::vector<std::vector<std::array<double, 2>>> ways() {
  return {{{0.05, 0.0}, {0.05, 0.3}},
          {{0.0, 0.15}, {0.2, 0.15}},
          {{0.03, 0.05}, {0.0, 0.02}, {0.07, -0.1}, {0.02, 0.1}, {0.12, 0.1}},
          {{0.04, 0.04}, {-0.03, 0.1}, {-0.01, -0.12}, {0.09, -0.15}}};
}

TractionState along(const TractionLaw& law, const std::vector<std::array<double, 2>>& way, int steps,
                    double* worst = nullptr) {
  TractionState state;
  for (const std::array<double, 2>& corner : way) {
    const FaceOpening from = state.opening;
    for (int i = 1; i <= steps && !state.failed; ++i) {
      const double s = static_cast<double>(i) / steps;
      const FaceOpening to{from.normal + s * (corner[0] * kMm - from.normal),
                           from.shear + s * (corner[1] * kMm - from.shear)};
      const std::array<double, 2> before = state.dissipated;
      law.advance(to.normal, to.shear, 0.0, state);
      for (int k = 0; k < 2; ++k) EXPECT_GE(state.dissipated[k], before[k] - 1e-12 * kNmm);
      const double rest = state.work - law.stored(state, to.normal, to.shear) - law.released(state);
      if (worst != nullptr) *worst = std::max(*worst, std::abs(rest));
    }
  }
  return state;
}

// The ratios sum to 1 on every way (crack reference 5.5), though the energies differ from way to way.
TEST(CrackTractionCoupled, SumOfRatiosIsOneOnEveryWay) {
  const TractionLaw law(pair_definition(TractionKind::coupled));
  double least = 1e9, most = 0.0;
  for (const auto& way : ways()) {
    for (const int steps : {1, 7, 500}) {
      const TractionState state = along(law, way, steps);
      EXPECT_TRUE(state.failed);
      EXPECT_NEAR(sum_of_ratios(law, state), 1.0, 1e-12);
      if (steps == 500) {
        least = std::min(least, law.released(state));
        most = std::max(most, law.released(state));
      }
    }
  }
  EXPECT_GT(most, 1.2 * least);
}

// Work = stored + dissipated: to round-off for the mixed law in steps of any size. The coupled law's split errs with
// the square of a step that turns; on a straight way not at all.
TEST(CrackTractionCoupled, EnergyIsBalanced) {
  const TractionLaw coupled(pair_definition(TractionKind::coupled));
  for (const auto& way : ways()) {
    for (const double shear_elastic : {0.02, 0.08}) {
      const TractionLaw mixed(pair_definition(TractionKind::mixed, shear_elastic));
      for (const int steps : {1, 7, 100}) {
        double worst = 0.0;
        along(mixed, way, steps, &worst);
        EXPECT_LT(worst, 1e-10 * kNmm);
      }
    }
    double coarse = 0.0, fine = 0.0;
    along(coupled, way, 200, &coarse);
    along(coupled, way, 800, &fine);
    EXPECT_LT(coarse, 1e-3 * kNmm);
    EXPECT_NEAR(std::log(coarse / fine) / std::log(4.0), 2.0, 0.3);
  }
  for (const TractionKind curve : {TractionKind::cubic, TractionKind::trilinear, TractionKind::exponential}) {
    double worst = 0.0;
    along(curved_law(curve), ways()[2], 11, &worst);
    EXPECT_LT(worst, 1e-10 * kNmm) << kTractionKindNames[static_cast<int>(curve)];
  }
  double straight = 0.0;
  along(coupled, {{0.08, 0.09}, {0.0, 0.0}, {0.16, 0.18}}, 13, &straight);
  EXPECT_LT(straight, 1e-12 * kNmm);
}

// With the same elastic part in both directions the two laws are one: then (1 - D) k = (1 - l) / ((1 - l_p) l)
// sigma/u_c solves the mixed law's condition.
TEST(CrackTractionCoupled, IsTheMixedLawOfEqualElasticParts) {
  const TractionLaw coupled(pair_definition(TractionKind::coupled)), mixed(pair_definition(TractionKind::mixed));
  EXPECT_DOUBLE_EQ(coupled.stiffness(), 1e12);  // 10 MPa / 0.01 mm
  EXPECT_DOUBLE_EQ(mixed.stiffness(), 1e12);
  TractionState a, b;
  for (int i = 0; i < 400; ++i) {
    const double size = 0.0003 * i * kMm, turn = 0.05 * i;
    const Traction one = coupled.advance(size * std::cos(turn), size * std::sin(turn), 0.0, a);
    const Traction two = mixed.advance(size * std::cos(turn), size * std::sin(turn), 0.0, b);
    ASSERT_NEAR(one.normal, two.normal, 1e-10 * 10 * kMpa) << i;
    ASSERT_NEAR(one.shear, two.shear, 1e-10 * 20 * kMpa) << i;
  }
  EXPECT_GT(a.damage, 0.5);
}

// Along one direction alone the mixed law is that direction's curve. What it dissipates is the curve's own Omega; exact
// for straight lines, to the square of the step for others.
TEST(CrackTractionMixed, AloneFollowsItsCurve) {
  for (const TractionKind curve :
       {TractionKind::triangular, TractionKind::cubic, TractionKind::trilinear, TractionKind::exponential}) {
    const TractionLaw law = curved_law(curve);
    const TractionLawDefinition& definition = law.definition();
    const TractionCurve alone[2] = {TractionCurve(curve, definition.normal), TractionCurve(curve, definition.shear)};
    for (int k = 0; k < 2; ++k) {
      TractionState state;
      const int steps = 3000;
      for (int i = 1; i <= steps; ++i) {
        const double u = 0.9 * alone[k].opening() * i / steps;
        const Traction t = law.advance(k == 0 ? u : 0.0, k == 1 ? -u : 0.0, 0.0, state);
        ASSERT_NEAR(k == 0 ? t.normal : -t.shear, alone[k].secant(u) * u, 1e-9 * 10 * kMpa);
      }
      EXPECT_NEAR(state.dissipated[k], alone[k].dissipated(0.9 * alone[k].opening()), 1e-5 * alone[k].toughness());
      EXPECT_EQ(state.dissipated[1 - k], 0.0);
    }
  }
}

// One step to failure from the closed crack: the energies of the way, which the knots at the start of damage and at
// failure give; the published explicit update divides by the tractions at the step's start, which are zero.
TEST(CrackTractionMixed, TakesALargeFirstStep) {
  const TractionLaw law(pair_definition(TractionKind::mixed));
  TractionState state, part;
  law.advance(1.0 * kMm, 1.0 * kMm, 0.0, state);
  EXPECT_TRUE(state.failed);
  EXPECT_NEAR(state.dissipated[0], 0.4 * kNmm, 1e-10 * kNmm);
  EXPECT_NEAR(state.dissipated[1], 0.4 * kNmm, 1e-10 * kNmm);
  EXPECT_NEAR(state.work, 0.8 * kNmm, 1e-10 * kNmm);
  const Traction t = law.advance(0.05 * kMm, 0.0, 0.0, part);  // sigma (u_c - u) / (u_c - u_e)
  EXPECT_NEAR(t.normal, 10 * kMpa * 0.05 / 0.09, 1e-10 * 10 * kMpa);
  EXPECT_NEAR(part.dissipated[0], 0.5 * kNmm * 0.04 / 0.09, 1e-10 * kNmm);
}

// Faces that are closed know of the shear alone.
TEST(CrackTractionCoupled, ClosedFacesOnlySlide) {
  for (const TractionKind kind : {TractionKind::coupled, TractionKind::mixed}) {
    const TractionLaw law(pair_definition(kind));
    TractionState state;
    const Traction t = law.advance(-0.5 * kMm, 0.1 * kMm, 0.0, state);
    EXPECT_EQ(t.normal, 0.0);
    EXPECT_NEAR(t.shear, 20 * kMpa * 0.1 / 0.18, 1e-10 * 20 * kMpa);
    EXPECT_EQ(state.dissipated[0], 0.0);
    EXPECT_FALSE(state.failed);
    law.advance(-0.5 * kMm, 0.2 * kMm, 0.0, state);
    EXPECT_TRUE(state.failed);
    EXPECT_NEAR(state.dissipated[1], 2.0 * kNmm, 1e-10 * kNmm);
  }
}

TEST(CrackTractionCoupled, RefusesUnequalElasticParts) {
  EXPECT_THROW(TractionLaw{pair_definition(TractionKind::coupled, 0.08)}, CrackError);
  EXPECT_NO_THROW(TractionLaw{pair_definition(TractionKind::coupled, 0.02)});
}

}  // namespace crack_traction_coupled_test
}  // namespace mpm::test
