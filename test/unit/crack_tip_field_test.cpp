// Stress intensities and the field at the tip of a crack: the numbers of crack reference 4.7 and 7.10, limits, and the
// equations that the field has to satisfy.
#include "mpm/crack/crack_tip_field.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "mpm/math/constants.hpp"

namespace mpm::test {
namespace crack_tip_field_test {

constexpr double kRootMilli = 0.0316227766016838;  // sqrt(1e-3): of 1 MPa sqrt(mm) in MPa sqrt(m)

/// E = 2500 MPa, nu = 0.33 of crack reference 4.7, with some density.
ElasticConstants polymer(bool plane_stress = false) { return {2.5e9, 0.33, 1200.0, plane_stress}; }
/// The plate of crack reference 7.10.
ElasticConstants steel() { return {210e9, 0.3, 8000.0, false}; }

TEST(CrackConstants, OfThePlane) {
  EXPECT_NEAR(polymer().plane_modulus(), 2805.52e6, 0.005e6);  // reference 4.7, five digits
  EXPECT_NEAR(polymer().shear_modulus(), 939.85e6, 0.005e6);
  EXPECT_NEAR(polymer().kappa(), 1.68, 1e-12);
  EXPECT_DOUBLE_EQ(polymer(true).plane_modulus(), 2.5e9);
  EXPECT_NEAR(polymer(true).kappa(), 2.67 / 1.33, 1e-12);
  EXPECT_TRUE(ElasticConstants::of(1.0, 0.3, 1.0, GeometryKind::plane_stress).plane_stress);
  EXPECT_FALSE(ElasticConstants::of(1.0, 0.3, 1.0, GeometryKind::axisymmetric).plane_stress);
}

TEST(CrackConstants, WaveSpeeds) {
  EXPECT_NEAR(steel().dilatational_speed(), 5944.5, 0.05);  // reference 7.10, one decimal
  EXPECT_NEAR(steel().shear_speed(), 3177.4, 0.05);
  EXPECT_NEAR(steel().rayleigh_speed(), 2946.8, 0.05);
  // Speed of a plate: sqrt(E / (rho (1 - nu^2))).
  const ElasticConstants plate{210e9, 0.3, 8000.0, true};
  EXPECT_NEAR(plate.dilatational_speed(), std::sqrt(210e9 / (8000.0 * 0.91)), 1e-9 * 5000.0);
  EXPECT_EQ((ElasticConstants{210e9, 0.3, 0.0, false}.rayleigh_speed()), kInfinity);
}

TEST(CrackStressIntensity, SplitByOpenings) {
  const StressIntensity k = split_by_openings(1000.0, 2e-5, 1e-5, polymer());
  EXPECT_NEAR(k.one, 47.375e6 * kRootMilli, 0.0005e6 * kRootMilli);  // reference 4.7: J = 1 N/mm, ratio 1/2
  EXPECT_NEAR(k.two, 23.688e6 * kRootMilli, 0.0005e6 * kRootMilli);
  // (K_I^2 + K_II^2) / E' by hand.
  EXPECT_NEAR((k.one * k.one + k.two * k.two) / polymer().plane_modulus(), 1000.0, 1e-9);
  const StressIntensity turned = split_by_openings(1000.0, -2e-5, -1e-5, polymer());
  EXPECT_DOUBLE_EQ(turned.one, -k.one);
  EXPECT_DOUBLE_EQ(turned.two, -k.two);
}

TEST(CrackStressIntensity, IsZeroWithoutJOrOpening) {
  for (const StressIntensity& k :
       {split_by_openings(0.0, 1e-5, 1e-5, polymer()), split_by_openings(-1.0, 1e-5, 1e-5, polymer()),
        split_by_openings(10.0, 0.0, 0.0, polymer()), split_by_openings(10.0, 1.0, 0.0, steel(), 2947.0)}) {
    EXPECT_EQ(k.one, 0.0);
    EXPECT_EQ(k.two, 0.0);
  }
}

TEST(CrackStressIntensity, OfATipThatSlowsDown) {
  // Both factors tend to (kappa + 1) / 4 as c^2: halving the speed quarters the rest.
  for (const ElasticConstants& constants : {steel(), polymer(true)}) {
    const double at_rest = 0.25 * (constants.kappa() + 1.0), wave = constants.shear_speed();
    for (const auto factor : {&RunningTip::one, &RunningTip::two}) {
      const double coarse = running_tip(constants, 0.02 * wave).*factor - at_rest;
      const double fine = running_tip(constants, 0.01 * wave).*factor - at_rest;
      EXPECT_NEAR(coarse / fine, 4.0, 0.01);  // the next term is of c^4
    }
    for (const double speed : {0.0, 1e-9, 1e-3}) {
      EXPECT_NEAR(running_tip(constants, speed).one, at_rest, 1e-12) << speed;
      EXPECT_NEAR(running_tip(constants, speed).two, at_rest, 1e-12) << speed;
    }
    const StressIntensity rest = split_by_openings(50.0, 3e-6, -2e-6, constants);
    const StressIntensity slow = split_by_openings(50.0, 3e-6, -2e-6, constants, 1e-3);
    EXPECT_NEAR(slow.one, rest.one, 1e-9 * rest.one);
    EXPECT_NEAR(slow.two, rest.two, 1e-9 * rest.one);
    EXPECT_NEAR(release_rate(rest, constants), (rest.one * rest.one + rest.two * rest.two) / constants.plane_modulus(),
                1e-10);
  }
}

TEST(CrackStressIntensity, OfARunningTip) {
  // Reference 7.10: G / G_0 of a tip that starts to run, with K / K_0 = k.
  const double wave = steel().rayleigh_speed(), fast = steel().dilatational_speed();
  const std::vector<std::array<double, 3>> rows = {
      {0.2, 0.843, 0.729}, {0.4, 0.670, 0.502}, {0.6, 0.477, 0.305}, {0.8, 0.258, 0.133}};
  for (const auto& [part, k_expected, g_expected] : rows) {
    const double speed = part * wave, k = (1.0 - part) / std::sqrt(1.0 - speed / fast);
    EXPECT_NEAR(k, k_expected, 0.0006);  // three digits; the last row is 0.2575
    EXPECT_NEAR(release_rate({k, 0.0}, steel(), speed) / release_rate({1.0, 0.0}, steel()), g_expected, 0.0006);
  }
  // The split returns the energy that it was given, at any speed at which there is one.
  for (const double part : {0.0, 0.3, 0.9, 0.999}) {
    const StressIntensity k = split_by_openings(80.0, 1e-5, -3e-5, steel(), part * wave);
    EXPECT_NEAR(release_rate(k, steel(), part * wave), 80.0, 1e-9) << part;
    EXPECT_GT(k.one, 0.0);
    EXPECT_LT(k.two, 0.0);
  }
  EXPECT_FALSE(running_tip(steel(), 1.001 * wave).possible);
  EXPECT_EQ(release_rate({1e6, 1e6}, steel(), 1.001 * wave), 0.0);
}

struct FieldCase {
  StressIntensity k;
  double t_stress;
  ElasticConstants constants;
};

std::vector<FieldCase> field_cases() {
  const double k = 1e6, t = 4e6;
  return {{{k, 0.0}, 0.0, polymer()},     {{0.0, k}, 0.0, polymer()},     {{0.0, 0.0}, t, polymer()},
          {{k, 0.0}, 0.0, polymer(true)}, {{0.0, k}, 0.0, polymer(true)}, {{0.8 * k, -0.6 * k}, -t, polymer(true)}};
}

const std::vector<Vec2> kPlaces = {{1e-3, 2e-4}, {-4e-4, 9e-4}, {-1.1e-3, -3e-4}, {2e-4, -8e-4}};

// The gradient is that of the displacement, the stress is in equilibrium, and the two obey Hooke's law. Central
// differences over 1e-4 of the distance err by about 1e-8 of the value, and by 1e-12 / 1e-4 of it by round-off.
TEST(CrackTipFieldTest, SatisfiesTheEquationsOfElasticity) {
  for (const FieldCase& one : field_cases()) {
    const CrackTipField field(one.k, one.t_stress, one.constants);
    for (const Vec2& place : kPlaces) {
      const double step = 1e-4 * place.norm();
      const TipFieldValue value = field.at(place);
      const double strain = value.gradient.norm(), stress = value.stress.norm();
      Vec2 divergence = Vec2::Zero();
      for (int j = 0; j < 2; ++j) {
        const TipFieldValue ahead = field.at(place + step * Vec2::Unit(j));
        const TipFieldValue behind = field.at(place - step * Vec2::Unit(j));
        const Vec2 along = (ahead.displacement - behind.displacement) / (2.0 * step);
        EXPECT_LT((along - value.gradient.col(j)).norm(), 1e-7 * strain);
        divergence += (ahead.stress - behind.stress).col(j) / (2.0 * step);
      }
      EXPECT_LT(divergence.norm() * place.norm(), 1e-7 * stress);

      // E e_ij = (1 + nu) s_ij - nu tr(s) d_ij, with the stress across the plane in the trace.
      const double e = one.constants.youngs, nu = one.constants.poisson;
      const double trace = value.stress.trace() + value.stress_out;
      const Eigen::Matrix2d measured = 0.5 * (value.gradient + value.gradient.transpose());
      const Eigen::Matrix2d expected = ((1.0 + nu) * value.stress - nu * trace * Eigen::Matrix2d::Identity()) / e;
      EXPECT_LT((measured - expected).norm(), 1e-12 * strain);
      const double strain_out = (value.stress_out - nu * value.stress.trace()) / e;
      if (one.constants.plane_stress) {
        EXPECT_EQ(value.stress_out, 0.0);
      } else {
        EXPECT_NEAR(strain_out, 0.0, 1e-15);
      }
    }
  }
}

// e_xx,yy + e_yy,xx = 2 e_xy,xy, by differences of the strains alone; over 1e-3 of the distance they err by about 1e-6
// of e / r^2, and 1e-16 / 1e-6 by round-off.
TEST(CrackTipFieldTest, StrainsAreCompatible) {
  const auto strain_at = [](const CrackTipField& field, const Vec2& place) -> Eigen::Matrix2d {
    const Eigen::Matrix2d gradient = field.at(place).gradient;
    return 0.5 * (gradient + gradient.transpose());
  };
  for (const FieldCase& one : field_cases()) {
    const CrackTipField field(one.k, one.t_stress, one.constants);
    for (const Vec2& place : kPlaces) {
      const double step = 1e-3 * place.norm();
      const Vec2 x = step * Vec2::UnitX(), y = step * Vec2::UnitY();
      const Eigen::Matrix2d here = strain_at(field, place);
      const double xx_yy = strain_at(field, place + y)(0, 0) - 2.0 * here(0, 0) + strain_at(field, place - y)(0, 0);
      const double yy_xx = strain_at(field, place + x)(1, 1) - 2.0 * here(1, 1) + strain_at(field, place - x)(1, 1);
      const double xy_xy = 0.25 * (strain_at(field, place + x + y)(0, 1) - strain_at(field, place + x - y)(0, 1) -
                                   strain_at(field, place - x + y)(0, 1) + strain_at(field, place - x - y)(0, 1));
      EXPECT_NEAR(xx_yy + yy_xx - 2.0 * xy_xy, 0.0, 1e-5 * 1e-6 * here.norm());
    }
  }
}

TEST(CrackTipFieldTest, FacesAreFreeAndOpenAsK) {
  for (const FieldCase& one : field_cases()) {
    const CrackTipField field(one.k, one.t_stress, one.constants);
    const double behind = 7e-4;
    const TipFieldValue above = field.at({-behind, 0.0}), below = field.at({-behind, -0.0});
    for (const TipFieldValue& face : {above, below}) {
      EXPECT_LT(face.stress.col(1).norm(), 1e-14 * face.stress.norm() + 1e-8);
    }
    // Reference 4.7: delta = (kappa + 1) K sqrt(r / 2 pi) / G.
    const double scale =
        (one.constants.kappa() + 1.0) * std::sqrt(behind / (2.0 * kPi)) / one.constants.shear_modulus();
    const Vec2 opening = above.displacement - below.displacement;
    EXPECT_NEAR(opening.x(), scale * one.k.two, 1e-12 * scale * 1e6);
    EXPECT_NEAR(opening.y(), scale * one.k.one, 1e-12 * scale * 1e6);
  }
}

TEST(CrackTipFieldTest, HasTheStressesOfKAhead) {
  // s_yy = K_I / sqrt(2 pi r), s_xy = K_II / sqrt(2 pi r) on the line ahead: what defines K.
  const CrackTipField field({0.8e6, -0.6e6}, 3e6, polymer());
  const double near = 1.0 / std::sqrt(2.0 * kPi * 2e-3);
  const Eigen::Matrix2d stress = field.at({2e-3, 0.0}).stress;
  EXPECT_NEAR(stress(1, 1), 0.8e6 * near, 1e-9 * 0.8e6 * near);
  EXPECT_NEAR(stress(0, 1), -0.6e6 * near, 1e-9 * 0.8e6 * near);
  EXPECT_NEAR(stress(0, 0), 0.8e6 * near + 3e6, 1e-9 * 0.8e6 * near);
}

/// J along the tip's direction on a circle from the lower face to the upper one, by the midpoint rule.
double j_on_circle(const CrackTipField& field, double radius, int parts) {
  double j = 0.0;
  for (int i = 0; i < parts; ++i) {
    const double angle = kPi * (2.0 * (i + 0.5) / parts - 1.0);
    const Vec2 normal(std::cos(angle), std::sin(angle));
    const TipFieldValue value = field.at(radius * normal);
    const double energy = 0.5 * value.stress.cwiseProduct(value.gradient).sum();
    const Vec2 traction = value.stress * normal;
    j += (energy * normal.x() - traction.dot(value.gradient.col(0))) * radius * 2.0 * kPi / parts;
  }
  return j;
}

// Without a T-stress the integrand is a trigonometric polynomial and the rule is exact; with it there are terms of half
// angles, which the rule integrates to order 2.
TEST(CrackTipFieldTest, JIsTheSumOfTheSquares) {
  for (const bool plane_stress : {false, true}) {
    const ElasticConstants constants = polymer(plane_stress);
    for (const StressIntensity& k : {StressIntensity{1e6, 0.0}, {0.0, 1e6}, {0.8e6, -0.6e6}}) {
      const double expected = (k.one * k.one + k.two * k.two) / constants.plane_modulus();
      EXPECT_NEAR(j_on_circle(CrackTipField(k, 0.0, constants), 1e-3, 64), expected, 1e-12 * expected);
      EXPECT_NEAR(j_on_circle(CrackTipField(k, 5e6, constants), 1e-3, 20000), expected, 1e-7 * expected);
      EXPECT_NEAR(release_rate(k, constants), expected, 1e-12 * expected);
    }
  }
}

}  // namespace crack_tip_field_test
}  // namespace mpm::test
