// Modified Cam clay on single elements, against closed forms: isotropic compression, undrained and drained triaxial
// tests, and the return at the tip and on the dry side.
#include "mpm/material/cam_clay.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "material_paths.hpp"
#include "mpm/material/initial_state.hpp"
#include "mpm/material/path_driver.hpp"
#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"

namespace mpm {
namespace cam_clay_test {

constexpr int kXx = 0, kYy = 1, kZz = 2;
constexpr double kLambda = 0.2, kKappa = 0.05, kSlope = 1.0, kVoids = 1.0, kLeast = 1.0, kConsolidation = 100e3;

/// Clay of kaolin's order; `shear` 0: Poisson's ratio 0.3.
CamClayDefinition clay(double shear = 2e6) {
  CamClayDefinition d;
  d.lambda = kLambda;
  d.kappa = kKappa;
  d.slope = kSlope;
  d.void_ratio = kVoids;
  d.shear_modulus = shear;
  d.poisson = 0.3;
  d.consolidation = kConsolidation;
  d.least_pressure = kLeast;
  return d;
}

double pressure_of(const MaterialPoint& point) { return -trace(point.cauchy()) / 3.0; }
double mises_of(const MaterialPoint& point) {
  const Symmetric3<double> s = point.cauchy();
  return std::sqrt(1.5 * squared_norm(scale_shift(s, 1.0, -trace(s) / 3.0)));
}
double consolidation_of(const MaterialPoint& point) {
  return kConsolidation * std::exp(point.history(CamClay::kHardening));
}

/// To an isotropic pressure.
PathDriver pressed(const CamClayDefinition& d, double pressure, int steps = 200) {
  PathDriver driver({"clay", 1700.0, d});
  Leg leg;
  leg.duration = 1.0;
  leg.steps = steps;
  for (const int k : {kXx, kYy, kZz}) {
    leg.control[k] = Control::stress;
    leg.target[k] = -pressure;
  }
  driver.run(leg);
  return driver;
}

// Isotropic compression: v falls by lambda ln p beyond p_c, and on the way back it swells by kappa ln p; v = v0 J. The
// law meets the lines at any step, but for the mean volume of a step (third order) and p_r beside p (1e-5).
TEST(CamClay, IsotropicCompressionFollowsTheLines) {
  PathDriver driver = pressed(clay(), 50e3);
  const double v0 = 1.0 + kVoids;
  const auto press = [&driver](double pressure) {
    Leg leg;
    leg.duration = 1.0;
    leg.steps = 400;
    for (const int k : {kXx, kYy, kZz}) {
      leg.control[k] = Control::stress;
      leg.target[k] = -pressure;
    }
    driver.run(leg);
  };
  press(100e3);
  const double at_yield = v0 * driver.point().j();
  press(400e3);
  const double at_most = v0 * driver.point().j();
  EXPECT_NEAR(at_yield - at_most, kLambda * std::log(4.0), 1e-5 * kLambda);
  EXPECT_NEAR(consolidation_of(driver.point()), 400e3, 1.0);
  press(100e3);
  EXPECT_NEAR(v0 * driver.point().j() - at_most, kKappa * std::log(4.0), 1e-5 * kKappa);
}

// Undrained strength, that of constant volume: from p0 at the overconsolidation ratio R = p_c / p0 to the critical
// state, where p = p_c / 2: kappa ln(p / p0) + (lambda - kappa) ln(2 p / p_c) = 0, so p = p0 (R / 2)^(1 -
// kappa/lambda), q = M p (Wood 1990, 7.2), on both sides of the critical state, in compression and extension. p_r
// beside p: 1e-5. Elastic shear reaches the end as exp(-strain).
TEST(CamClay, UndrainedStrengthIsExact) {
  for (const double shear : {2e6, 0.0}) {
    for (const double ratio : {1.0, 1.5, 2.0, 4.0, 10.0}) {
      for (const double sign : {-1.0, 1.0}) {
        PathDriver driver = pressed(clay(shear), kConsolidation);
        const double initial = kConsolidation / ratio;
        Leg unload;
        unload.duration = 1.0;
        unload.steps = 400;
        for (const int k : {kXx, kYy, kZz}) {
          unload.control[k] = Control::stress;
          unload.target[k] = -initial;
        }
        driver.run(unload);
        MaterialPoint point = driver.point();
        const double e = sign * 1e-4;
        for (int n = 0; n < 10000; ++n) point.advance({-0.5 * e, 0, 0, 0, -0.5 * e, 0, 0, 0, e}, 1.0);
        const double expected = initial * std::pow(0.5 * ratio, 1.0 - kKappa / kLambda);
        EXPECT_NEAR(pressure_of(point), expected, 2e-3 * expected) << shear << ' ' << ratio << ' ' << sign;
        EXPECT_NEAR(mises_of(point), kSlope * pressure_of(point), 1e-3 * expected) << shear << ' ' << ratio;
      }
    }
  }
}

// Drained triaxial compression at the pressure p0 on the sides ends at q = M p with q = 3 (p - p0): p = 3 p0 / (3 - M),
// q = 150 kPa of 100 kPa, p_c = 2 p, and shears on at constant volume. From there v is on the critical line: v = v_p0 -
// lambda ln(p_c / p_c0) + kappa ln 2 at normally consolidated p0 = p_c0.
TEST(CamClay, DrainedCompressionEndsInTheCriticalState) {
  PathDriver driver = pressed(clay(), kConsolidation);
  const double start = (1.0 + kVoids) * driver.point().j();
  Leg leg;
  leg.duration = 1.0;
  leg.steps = 4000;
  leg.from_start = true;
  for (const int k : {kXx, kYy}) {
    leg.control[k] = Control::stress;
    leg.target[k] = -kConsolidation;
  }
  leg.target[kZz] = -2.5;
  driver.run(leg);
  const double pressure = 3.0 * kConsolidation / (3.0 - kSlope);
  EXPECT_NEAR(pressure_of(driver.point()), pressure, 1e-3 * pressure);
  EXPECT_NEAR(mises_of(driver.point()), kSlope * pressure, 1e-3 * pressure);
  EXPECT_NEAR(consolidation_of(driver.point()), 2.0 * pressure, 4e-3 * pressure);
  const double end = start - kLambda * std::log(2.0 * pressure / kConsolidation) + kKappa * std::log(2.0);
  EXPECT_NEAR((1.0 + kVoids) * driver.point().j(), end, 1e-3 * (start - end));
}

// Steps of any size from random states end on the surface, or inside it: f <= 0, and f = 0 where the clay flowed.
TEST(CamClay, EveryStepEndsOnTheSurface) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> decades(-6.0, -1.2);
  int wet = 0, dry = 0;
  for (int n = 0; n < 3000; ++n) {
    MaterialPoint point({"clay", 1700.0, clay(n % 2 == 0 ? 2e6 : 0.0)});
    const double pressing = -0.1 * (0.6 + 0.6 * (n % 97) / 97.0);
    point.advance({pressing, 0, 0, 0, pressing, 0, 0, 0, pressing}, 1.0);
    for (int k = 0; k < 4; ++k) {
      const double strain = point.plastic_strain(), hardening = point.history(CamClay::kHardening);
      point.advance(paths::random_gradient(random, std::pow(10.0, decades(random))), 1.0);
      const double p = pressure_of(point), q = mises_of(point), pc = consolidation_of(point);
      ASSERT_TRUE(std::isfinite(p + q + pc));
      ASSERT_GE(p, -1e-9 * pc);
      const double f = q * q / (kSlope * kSlope) + p * (p - pc), scale = pc * pc;
      EXPECT_LE(f, 1e-9 * scale);
      if (point.plastic_strain() > strain && point.history(CamClay::kOpening) == 0.0) {
        EXPECT_NEAR(f, 0.0, 1e-9 * scale);
        (point.history(CamClay::kHardening) > hardening ? wet : dry) += 1;
      }
    }
  }
  EXPECT_GT(wet, 300);
  EXPECT_GT(dry, 300);
}

// Flow is normal to the surface: volume over shear strain (2 p - p_c) / (2 q / M^2), on a path of small steps at
// constant volume and stress that hardly changes. Plastic volume from p_c, shear from history.
TEST(CamClay, FlowsNormalToTheSurface) {
  PathDriver driver = pressed(clay(), 90e3);
  MaterialPoint point = driver.point();
  for (int n = 0; n < 400; ++n) point.advance({-5e-5, 0, 0, 0, -5e-5, 0, 0, 0, 1e-4}, 1.0);
  const double hardening = point.history(CamClay::kHardening), strain = point.plastic_strain();
  ASSERT_GT(strain, 0.0);
  point.advance({-5e-7, 0, 0, 0, -5e-7, 0, 0, 0, 1e-6}, 1.0);
  const double v = (1.0 + kVoids) * point.j();
  const double volume = (kLambda - kKappa) * (point.history(CamClay::kHardening) - hardening) / v;
  const double shear = (point.plastic_strain() - strain) / std::sqrt(3.0);
  const double p = pressure_of(point),
               expected = (2.0 * p - consolidation_of(point)) * kSlope * kSlope / 2.0 / mises_of(point);
  EXPECT_NEAR(volume / shear, expected, 1e-3 * expected);
}

// Clay that is pulled apart carries nothing, nor on its way back until it has closed, and then what it did before.
TEST(CamClay, OpensWithoutTension) {
  MaterialPoint point({"clay", 1700.0, clay()});
  const auto grow = [&point](double e, int n) {
    for (int k = 0; k < n; ++k) point.advance({e, 0, 0, 0, e, 0, 0, 0, e}, 1.0);
  };
  grow(-1e-3, 60);
  const Symmetric3<double> before = point.cauchy();
  grow(1e-3, 200);
  EXPECT_EQ(squared_norm(point.cauchy()), 0.0);
  grow(-1e-3, 120);
  EXPECT_EQ(squared_norm(point.cauchy()), 0.0);
  grow(-1e-3, 80);
  // Volumes are those of the same J: equal but for the trapezoidal rule.
  EXPECT_NEAR(point.cauchy().xx, before.xx, 1e-3 * std::abs(before.xx));
}

// An overconsolidation ratio makes the surface of the initial stress: R (p + q^2 / (M^2 p)).
TEST(CamClay, StartsOverconsolidated) {
  CamClayDefinition d = clay();
  d.consolidation = 0.0;
  d.overconsolidation = 1.5;
  const CamClay law(d, 1700.0);
  const Symmetric3<double> stress{-30e3, -30e3, -60e3, 0, 0, 0};  // p = 40 kPa, q = 30 kPa
  const double through = 40e3 + 30e3 * 30e3 / 40e3;
  EXPECT_NEAR(std::exp(law.initial_hardening(stress)) * 1.5 * kLeast, 1.5 * through, 1e-9 * through);
  const InitialStates states({"clay", 1700.0, d}, GeometryKind::solid);
  EXPECT_TRUE(states.carries(stress));
  EXPECT_TRUE(states.carries({-1e3, -1e3, -100e3, 0, 0, 0}));
  const InitialStates fixed({"clay", 1700.0, clay()}, GeometryKind::solid);
  EXPECT_TRUE(fixed.carries(stress));
  EXPECT_FALSE(fixed.carries({-1e3, -1e3, -100e3, 0, 0, 0}));
}

// A bed 0.8 m deep with a ratio of 1.5, geostatic: it stays at rest, its vertical stress is the weight above (8 cells,
// so 1 % of the weight at the foot), the horizontal one K0 of normal consolidation times 1.5 to the power of the sine
// (Mayne & Kulhawy 1982), and no clay has yielded.
TEST(CamClay, RestsUnderItsWeight) {
  const Scene scene = parse_scene(
      "geometry: plane_strain\nthickness: 1\ngravity: [0, -9.81]\n"
      "grid: {cell: 0.1, min: [0, 0], max: [0.8, 1.2]}\ntime: {end: 0.2, sync: 10 ms}\n"
      "materials:\n  - {name: clay, density: 1700, law: cam_clay, lambda: 0.2, kappa: 0.04, M: 1, void_ratio: 1, "
      "poisson: 0.3, overconsolidation_ratio: 1.5, least_pressure: 500}\n"
      "bodies:\n  - {name: bed, material: clay, initial: geostatic, shape: {box: {min: [0, 0], max: [0.8, 0.8]}}}\n"
      "boundaries: {x_min: slip, x_max: slip, z_min: slip}\n",
      "bed.yaml", {});
  Simulation simulation(build(scene), {1});
  while (simulation.time() < 200'000'000) simulation.advance();
  std::vector<double> z, v, szz, sxx, strain;
  simulation.particle_field("z", z);
  simulation.particle_field("vz", v);
  simulation.particle_field("szz", szz);
  simulation.particle_field("sxx", sxx);
  simulation.particle_field("ep", strain);
  const double weight = 1700.0 * 9.81, sine = 3.0 / 7.0, ratio = (1.0 - sine) * std::pow(1.5, sine);
  for (std::size_t p = 0; p < z.size(); ++p) {
    EXPECT_NEAR(szz[p], -weight * (0.8 - z[p]), 0.01 * weight * 0.8) << z[p];
    EXPECT_NEAR(sxx[p], ratio * szz[p], 0.01 * weight * 0.8) << z[p];
    EXPECT_LT(std::abs(v[p]), 1e-3) << z[p];
    EXPECT_EQ(strain[p], 0.0) << z[p];
  }
}

}  // namespace cam_clay_test
}  // namespace mpm
