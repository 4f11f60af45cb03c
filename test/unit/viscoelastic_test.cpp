// The standard linear solid at a point against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "material_paths.hpp"

namespace viscoelastic_test {

using namespace mpm;
using namespace mpm::paths;

constexpr double kDensity = 100.0, kRelaxation = 0.3, kBranch = 5e3;
constexpr double kInstant = 1e-13 * kRelaxation;  ///< [s] too short to relax
const Elasticity kLongTerm{20e3, 0.35};

MaterialPoint foam() {
  return MaterialPoint({"foam", kDensity, StandardLinearSolidDefinition{kLongTerm, kBranch, kRelaxation}});
}

// Neo-Hookean solid of the long-term bulk modulus and the shear modulus of both springs.
MaterialPoint stiff() {
  const double bulk = kLongTerm.bulk(), shear = kLongTerm.shear() + kBranch;
  const Elasticity both{9.0 * bulk * shear / (3.0 * bulk + shear),
                        (3.0 * bulk - 2.0 * shear) / (2.0 * (3.0 * bulk + shear))};
  return MaterialPoint({"stiff", kDensity, NeoHookeanDefinition{both}});
}

const Matrix3<double> kStretch{0.2, 0.1, 0, 0, -0.1, 0.05, 0.15, 0, 0.1};

// At a large constant strain the stress goes from that of both springs to the long-term one, G(t) = G + G1 exp(-t/T),
// for any steps.
TEST(Viscoelastic, RelaxesExactly) {
  MaterialPoint point = foam(), instant = stiff(), relaxed({"soft", kDensity, NeoHookeanDefinition{kLongTerm}});
  point.advance(kStretch, kInstant);
  instant.advance(kStretch, 1.0);
  relaxed.advance(kStretch, 1.0);
  const double scale = std::sqrt(squared_norm(instant.cauchy()));
  EXPECT_LE(distance(point.cauchy(), instant.cauchy()), 1e-12 * scale);
  double time = 0.0;
  for (const double dt : {0.01, 0.5, 0.003, 0.2, 2.0}) {
    point.advance({}, dt);
    time += dt;
    const double left = std::exp(-time / kRelaxation);
    const auto expected = sum(scale_shift(instant.cauchy(), left, 0.0), scale_shift(relaxed.cauchy(), 1.0 - left, 0.0));
    EXPECT_LE(distance(point.cauchy(), expected), 1e-12 * scale) << time;
  }
  // The energy that the branch stored at first is lost.
  EXPECT_NEAR(point.plastic_work() + point.elastic_energy(), instant.elastic_energy(), 1e-12 * scale / kDensity);
}

// Small shear under constant stress: tau + T tau' = G gamma + (G + G1) T gamma' has the solution
// gamma = tau/G (1 - G1/(G + G1) exp(-t/T')), T' = T (G + G1)/G. Returns the relative error at 2 T.
double creep_error(int steps) {
  const double stress = 1e-4 * kBranch, shear = kLongTerm.shear();
  MaterialPoint point = foam();
  double gamma = 0.0;
  const auto hold = [&](double dt) {
    const auto moved = [&](double g) {
      MaterialPoint next = point;
      next.advance({0, g, 0, 0, 0, 0, 0, 0, 0}, dt);
      return next;
    };
    double a = 0.0, b = 1e-4, fa = moved(a).cauchy().xy - stress, fb = moved(b).cauchy().xy - stress;
    for (int n = 0; n < 30 && std::abs(fb) > 1e-13 * stress && fb != fa; ++n) {
      const double c = b - fb * (b - a) / (fb - fa);
      a = b, fa = fb, b = c, fb = moved(b).cauchy().xy - stress;
    }
    point = moved(b);
    gamma += b;
  };
  hold(kInstant);
  for (int n = 0; n < steps; ++n) hold(2.0 * kRelaxation / steps);
  const double retardation = kRelaxation * (shear + kBranch) / shear;
  const double expected =
      stress / shear * (1.0 - kBranch / (shear + kBranch) * std::exp(-2.0 * kRelaxation / retardation));
  return std::abs(gamma - expected) / expected;
}

TEST(Viscoelastic, CreepsAtSecondOrder) {
  const double coarse = creep_error(10), fine = creep_error(20);
  EXPECT_LT(fine, 1e-3);  // (0.1)^2 / 12
  EXPECT_GT(std::log2(coarse / fine), 1.95);
  EXPECT_LT(std::log2(coarse / fine), 2.05);
}

// In fast strain both springs act, in slow strain the long-term one. At a slow strain rate the branch adds G1 T times
// the rate.
TEST(Viscoelastic, IsAsStiffAsTimeAllows) {
  MaterialPoint fast = foam(), slow = foam(), both = stiff(), soft({"soft", kDensity, NeoHookeanDefinition{kLongTerm}});
  for (int n = 0; n < 100; ++n) {
    fast.advance(scaled(kStretch, 0.01), kInstant);
    slow.advance(scaled(kStretch, 0.01), 1e6 * kRelaxation);
    both.advance(scaled(kStretch, 0.01), 1.0);
    soft.advance(scaled(kStretch, 0.01), 1.0);
  }
  const double scale = std::sqrt(squared_norm(both.cauchy()));
  EXPECT_LE(distance(fast.cauchy(), both.cauchy()), 1e-11 * scale);
  EXPECT_LE(distance(slow.cauchy(), soft.cauchy()), 1e-11 * scale);
}

}  // namespace viscoelastic_test
