// Traction laws from the numbers that a scene gives: the others follow, and what does not make a law is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>

#include "mpm/crack/crack_error.hpp"
#include "mpm/crack/traction_completion.hpp"
#include "mpm/crack/traction_curve.hpp"

namespace mpm::test {
namespace crack_traction_completion_test {

// sigma 10 MPa, u_c 0.1 mm, u_e 0.01 mm: G_c = 0.5 N/mm = 500 J/m^2 (crack reference 5.5, checks).
constexpr double kStrength = 10e6, kOpening = 1e-4, kElastic = 1e-5, kToughness = 500.0;

using Given = std::optional<double>;

GivenTraction given_of(Given toughness, Given strength, Given opening, Given stiffness = {}, Given elastic = {},
                       Given part = {}) {
  return {toughness, strength, opening, stiffness, elastic, part};
}

TEST(CrackTractionCompletion, TriangularFromTwoNumbers) {
  for (const GivenTraction& given :
       {given_of(kToughness, kStrength, {}), given_of(kToughness, {}, kOpening), given_of({}, kStrength, kOpening)}) {
    const TractionMode mode = complete_triangular(given);
    EXPECT_DOUBLE_EQ(mode.strength, kStrength);
    EXPECT_DOUBLE_EQ(mode.opening, kOpening);
    EXPECT_DOUBLE_EQ(mode.elastic, 0.225926299 * kOpening);
    EXPECT_NEAR(TractionCurve(TractionKind::triangular, mode).toughness(), kToughness, 1e-10);
  }
  EXPECT_DOUBLE_EQ(complete_triangular(given_of({}, kStrength, kOpening, 1e12)).elastic, kElastic);
  EXPECT_DOUBLE_EQ(complete_triangular(given_of({}, kStrength, kOpening, {}, kElastic)).elastic, kElastic);
  EXPECT_DOUBLE_EQ(complete_triangular(given_of({}, kStrength, kOpening, {}, {}, 0.1)).elastic, kElastic);
}

// The default makes W(u) come closest, by least squares, to the cubic law's of the same toughness and opening.
TEST(CrackTractionCompletion, DefaultElasticPartFitsTheCubicLaw) {
  const auto misfit = [](double elastic) {
    double sum = 0.0;
    const int n = 20000;
    for (int i = 0; i < n; ++i) {
      const double x = (i + 0.5) / n;  // W over G_c; the triangular law stores x^2 / u_e before u_e
      const double cubic = x * x * (6.0 - 8.0 * x + 3.0 * x * x);
      const double lines = x < elastic ? x * x / elastic : (x * (1.0 - x) + x - elastic) / (1.0 - elastic);
      sum += (cubic - lines) * (cubic - lines);
    }
    return sum / n;
  };
  const double best = misfit(kTriangularElasticPart);
  EXPECT_GT(misfit(kTriangularElasticPart + 1e-3), best);
  EXPECT_GT(misfit(kTriangularElasticPart - 1e-3), best);
}

TEST(CrackTractionCompletion, CubicFromTwoNumbers) {
  const double toughness = 9.0 / 16.0 * kStrength * kOpening;  // crack reference 5.5, table
  for (const GivenTraction& given :
       {given_of(toughness, kStrength, {}), given_of(toughness, {}, kOpening), given_of({}, kStrength, kOpening)}) {
    const TractionMode mode = complete_cubic(given);
    EXPECT_DOUBLE_EQ(mode.strength, kStrength);
    EXPECT_DOUBLE_EQ(mode.opening, kOpening);
  }
  EXPECT_THROW(complete_cubic(given_of({}, kStrength, kOpening, 1e12)), CrackError);
}

// Every way to say one exponential law: G_c or u_c, and two of sigma, k and u_e, the last in m or as a part.
TEST(CrackTractionCompletion, ExponentialFromThreeNumbers) {
  const double decay = 3.0, rest = std::exp(-decay), f = 2.0 * (1.0 / decay - rest / (1.0 - rest));
  const double toughness = 0.5 * kStrength * (kElastic + f * (kOpening - kElastic));  // crack reference 5.5, table
  const double k = kStrength / kElastic;
  for (const bool by_toughness : {true, false}) {
    const Given g = by_toughness ? Given(toughness) : Given(), u = by_toughness ? Given() : Given(kOpening);
    for (const GivenTraction& given :
         {given_of(g, kStrength, u, k), given_of(g, kStrength, u, {}, kElastic), given_of(g, {}, u, k, kElastic),
          given_of(g, kStrength, u, {}, {}, 0.1), given_of(g, {}, u, k, {}, 0.1)}) {
      const TractionMode mode = complete_exponential(given, decay);
      EXPECT_NEAR(mode.strength, kStrength, 1e-12 * kStrength);
      EXPECT_NEAR(mode.opening, kOpening, 1e-12 * kOpening);
      EXPECT_NEAR(mode.elastic, kElastic, 1e-12 * kElastic);
      EXPECT_EQ(mode.decay, decay);
    }
  }
  EXPECT_THROW(complete_exponential(given_of(toughness, kStrength, kOpening, k), decay), CrackError);
  EXPECT_THROW(complete_exponential(given_of({}, kStrength, {}, k), decay), CrackError);
  EXPECT_THROW(complete_exponential(given_of(toughness, kStrength, {}), decay), CrackError);
  EXPECT_THROW(complete_exponential(given_of(toughness, {}, {}, {}, kElastic, 0.1), decay), CrackError);
  EXPECT_THROW(complete_exponential(given_of(40.0, kStrength, {}, k), decay), CrackError);  // it stores 50 by u_e
  EXPECT_THROW(complete_exponential(given_of(toughness, kStrength, {}, k), -1.0), CrackError);
}

// All sets of five of the six numbers of a law, and a stiffness in place of one of the first corner's.
TEST(CrackTractionCompletion, TrilinearFromFiveNumbers) {
  const double s1 = 10e6, u1 = 2e-5, s2 = 4e6, u2 = 5e-5, u3 = 1e-4;
  const double toughness = 0.5 * (s1 * u2 + s2 * (u3 - u1));  // crack reference 5.5, table
  const auto expect_law = [&](const GivenTrilinear& given, const char* what) {
    const TractionMode mode = complete_trilinear(given);
    EXPECT_NEAR(mode.strength, s1, 1e-12 * s1) << what;
    EXPECT_NEAR(mode.elastic, u1, 1e-12 * u1) << what;
    EXPECT_NEAR(mode.strength_2, s2, 1e-12 * s2) << what;
    EXPECT_NEAR(mode.elastic_2, u2, 1e-12 * u2) << what;
    EXPECT_NEAR(mode.opening, u3, 1e-12 * u3) << what;
    EXPECT_NEAR(TractionCurve(TractionKind::trilinear, mode).toughness(), toughness, 1e-12 * toughness) << what;
  };
  const GivenTrilinear all{s1, u1, s2, u2, u3, toughness, {}};
  const auto without = [&](Given GivenTrilinear::*number) {
    GivenTrilinear given = all;
    (given.*number).reset();
    return given;
  };
  for (Given GivenTrilinear::*number :
       {&GivenTrilinear::strength, &GivenTrilinear::elastic, &GivenTrilinear::strength_2, &GivenTrilinear::elastic_2,
        &GivenTrilinear::opening, &GivenTrilinear::toughness}) {
    expect_law(without(number), "five");
    if (number == &GivenTrilinear::strength || number == &GivenTrilinear::elastic) {
      GivenTrilinear given = without(number);
      given.stiffness = s1 / u1;
      EXPECT_THROW(complete_trilinear(given), CrackError);  // six numbers
      given.toughness.reset();
      expect_law(given, "stiffness");
    }
  }
  GivenTrilinear given = without(&GivenTrilinear::strength);
  given.elastic.reset();
  EXPECT_THROW(complete_trilinear(given), CrackError);  // four numbers
  given.stiffness = s1 / u1;
  expect_law(given, "stiffness alone");
  EXPECT_THROW(complete_trilinear(all), CrackError);
  GivenTrilinear weak = without(&GivenTrilinear::strength_2);
  weak.toughness = 0.4 * s1 * u2;  // less than the first corner's alone
  EXPECT_THROW(complete_trilinear(weak), CrackError);
  GivenTrilinear stiffer = without(&GivenTrilinear::toughness);
  stiffer.strength_2 = 30e6;  // above the line from the origin through the first corner
  EXPECT_THROW(complete_trilinear(stiffer), CrackError);
}

TEST(CrackTractionCompletion, RefusesTooFewTooManyAndImpossible) {
  EXPECT_THROW(complete_triangular(given_of({}, kStrength, {})), CrackError);
  EXPECT_THROW(complete_triangular(given_of({}, {}, {})), CrackError);
  EXPECT_THROW(complete_triangular(given_of({}, kStrength, kOpening, 1e12, kElastic)), CrackError);
  EXPECT_THROW(complete_triangular(given_of({}, kStrength, kOpening, 1e10)), CrackError);  // u_e beyond u_c
  EXPECT_THROW(complete_triangular(given_of({}, -kStrength, kOpening)), CrackError);
  EXPECT_THROW(complete_triangular(given_of({}, kStrength, std::nan(""))), CrackError);
  EXPECT_THROW(complete_triangular(given_of({}, kStrength, kOpening, {}, 0.0)), CrackError);
  EXPECT_THROW(complete_cubic(given_of(kToughness, {}, {})), CrackError);
  try {
    complete_cubic(given_of(kToughness, kStrength, kOpening));
    FAIL() << "three numbers for two unknowns";
  } catch (const CrackError& error) {
    EXPECT_EQ(std::string(error.what()),
              "a cubic traction law takes two of toughness, strength and opening, all three are given");
  }
}

}  // namespace crack_traction_completion_test
}  // namespace mpm::test
