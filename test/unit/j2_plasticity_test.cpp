// J2 plasticity at a point against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "material_paths.hpp"

namespace j2_plasticity_test {

using namespace mpm;
using namespace mpm::paths;

const Elasticity kSteel{200e9, 0.3};
constexpr double kDensity = 7800.0;

MaterialPoint point(double yield, double hardening = 0.0, double saturation = 0.0, double rate = 0.0) {
  return MaterialPoint({"metal", kDensity, J2PlasticityDefinition{kSteel, yield, hardening, saturation, rate}});
}

// tr b of random unimodular tensors, small and extreme, from their deviators.
TEST(Isochoric, MeanFollowsFromTheDeviator) {
  std::mt19937 random(3);
  for (const double size : {1e-9, 1e-4, 0.1, 1.0, 3.0}) {
    for (int n = 0; n < 200; ++n) {
      std::uniform_real_distribution<double> d(-size, size);
      const double u = d(random), v = d(random);
      const double b[3] = {std::exp(u), std::exp(v), std::exp(-u - v)};
      // tr b / 3 - 1 without cancellation
      const double excess = (std::expm1(u) + std::expm1(v) + std::expm1(-u - v)) / 3.0;
      const double mean = (b[0] + b[1] + b[2]) / 3.0;
      const double found = isochoric_excess(Symmetric3<double>{b[0] - mean, b[1] - mean, b[2] - mean, 0, 0, 0});
      // The deviator has errors of 1e-16 of b, which are amplified by the largest value of b over its second invariant.
      EXPECT_NEAR(found, excess, 1e-15 * (size + mean * mean * mean)) << b[0] << ' ' << b[1] << ' ' << b[2];
    }
  }
}

// Far below yield, at large stretch, the law is the neo-Hookean one for any path.
TEST(J2Plasticity, IsNeoHookeanBelowYield) {
  MaterialPoint metal = point(1e30), rubber({"rubber", kDensity, NeoHookeanDefinition{kSteel}});
  std::mt19937 random(1);
  double scale = 0.0;
  for (int n = 0; n < 200; ++n) {
    const Matrix3<double> du = random_gradient(random, 0.1);
    metal.advance(du, 1.0);
    rubber.advance(du, 1.0);
    scale = std::max(scale, std::sqrt(squared_norm(rubber.cauchy())));
  }
  EXPECT_GT(scale, kSteel.young);  // the deformation is large
  // Round-off of 200 steps.
  EXPECT_LE(distance(metal.cauchy(), rubber.cauchy()), 1e-13 * 200 * scale);
  EXPECT_NEAR(metal.elastic_energy(), rubber.elastic_energy(), 1e-12 * rubber.elastic_energy());
  EXPECT_EQ(metal.plastic_strain(), 0.0);
}

// Small strain: slope E, then E H / (E + H).
TEST(J2Plasticity, BarYieldsAndHardensAsInTheTextbook) {
  const double yield = 2e5, hardening = 20e9, young = kSteel.young;  // yields at a strain of 1e-6
  MaterialPoint bar = point(yield, hardening);
  const int steps = 100;
  const double end = 5.0 * yield / young;
  for (int n = 1; n <= steps; ++n) {
    advance_uniaxial(bar, end / steps, 1.0, yield);
    const double strain = n * end / steps, elastic = yield / young;
    const double expected =
        strain <= elastic ? young * strain : yield + young * hardening / (young + hardening) * (strain - elastic);
    EXPECT_NEAR(bar.cauchy().xx, expected, 2e-5 * yield);  // finite strain enters by a few times the strain, 5e-6
  }
  const double plastic = end - bar.cauchy().xx / young;
  EXPECT_NEAR(bar.plastic_strain(), plastic, 2e-5 * plastic);
  // sigma_y a + H a^2 / 2
  EXPECT_NEAR(kDensity * bar.plastic_work(), yield * plastic + 0.5 * hardening * plastic * plastic,
              5e-5 * yield * plastic);
}

TEST(J2Plasticity, ShearYieldsAtTheMisesStress) {
  const double yield = 2e6;
  MaterialPoint metal = point(yield);
  for (int n = 0; n < 100; ++n) metal.advance({0, 1e-6, 0, 1e-6, 0, 0, 0, 0, 0}, 1.0);
  EXPECT_NEAR(metal.cauchy().xy, yield / std::sqrt(3.0), 1e-8 * yield);  // second order in yield / shear = 2.6e-5
}

// A plastic strain of 100 % in random directions: stress stays on or within the yield surface, and flow does not change
// volume.
TEST(J2Plasticity, KeepsToTheYieldSurfaceAndTheVolume) {
  const double yield = 250e6, hardening = 1e9, saturation = 400e6, rate = 15.0;
  MaterialPoint metal = point(yield, hardening, saturation, rate);
  std::mt19937 random(2);
  for (int n = 0; n < 1500; ++n) {
    metal.advance(random_gradient(random, 3e-3), 1.0);
    const double a = metal.plastic_strain(), j = metal.j();
    const double strength = yield + hardening * a + (saturation - yield) * (1.0 - std::exp(-rate * a));
    EXPECT_LE(j * mises(metal.cauchy()), strength * (1.0 + 1e-12));
    const double pressure = -0.5 * kSteel.bulk() * (j - 1.0 / j);
    EXPECT_NEAR(-trace(metal.cauchy()) / 3.0, pressure, 1e-13 * kSteel.bulk());
  }
  EXPECT_GT(metal.plastic_strain(), 1.0);
}

// A yielding step with saturation: Newton's root, inserted in the consistency condition.
TEST(J2Plasticity, ReturnsOntoTheSaturatingCurve) {
  const double yield = 100e6, saturation = 300e6;
  for (const double rate : {0.1, 10.0, 1000.0, 1e6}) {
    MaterialPoint metal = point(yield, 0.0, saturation, rate);
    metal.advance({0.05, 0, 0, 0, -0.025, 0, 0, 0, -0.025}, 1.0);
    const double a = metal.plastic_strain();
    EXPECT_GT(a, 0.0);
    EXPECT_NEAR(mises(metal.cauchy()), yield + (saturation - yield) * -std::expm1(-rate * a), 1e-11 * saturation);
  }
}

// Perfect plasticity in shear at finite strain: every turn of a closed cycle leaves the same stress, and b does not
// drift. 20 turns of 10 % shear strain, with the elastic shear modulus measured in the last.
TEST(J2Plasticity, StaysElasticInTheSameWayThroughLongFlow) {
  const double yield = 800e6;
  MaterialPoint metal = point(yield);
  for (int turn = 0; turn < 20; ++turn) {
    for (int n = 0; n < 400; ++n) {
      const double e = n < 100 || n >= 300 ? 1e-3 : -1e-3;
      metal.advance({0, e, 0, e, 0, 0, 0, 0, 0}, 1.0);
    }
  }
  EXPECT_GT(metal.plastic_strain(), 5.0);
  const double before = metal.cauchy().xy, e = -1e-6;
  metal.advance({0, e, 0, e, 0, 0, 0, 0, 0}, 1.0);
  // d s_xy = 2 G e tr(b)/3 and (b with the stress itself along), whose mean is 1 + (yield/G)^2/3 / 2 < 1 + 2e-5
  EXPECT_NEAR((metal.cauchy().xy - before) / (2.0 * e), kSteel.shear(), 5e-5 * kSteel.shear());
}

}  // namespace j2_plasticity_test
