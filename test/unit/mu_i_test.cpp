// mu(I) grain: single elements against the closed form; verification/chute_flow_test.cpp has a whole flow.
#include "mpm/material/mu_i.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "material_paths.hpp"
#include "mpm/material/path_driver.hpp"
#include "mpm/math/constants.hpp"

namespace mpm {
namespace mu_i_test {

constexpr int kXx = 0, kYy = 1, kZz = 2, kXz = 4;
// Glass beads: tan 20.9 and tan 32.76 degrees, I_0 0.279 (Jop, Forterre & Pouliquen 2006).
constexpr double kStatic = 0.3819, kLimiting = 0.6435, kReference = 0.279;
constexpr double kDiameter = 1e-3, kGrain = 2500.0;
const MuIDefinition kBeads{{1e9, 0.3}, kStatic, kLimiting, kReference, kDiameter, kGrain};

double friction(double rate, double pressure) {
  const double inertial = rate * kDiameter / std::sqrt(pressure / kGrain);
  return kStatic + (kLimiting - kStatic) / (kReference / inertial + 1.0);
}

/// Confined, then sheared at `rate` [1/s] to the engineering shear `shear`, with the confining pressure held along z.
PathDriver sheared(double rate, double pressure, double shear, int steps) {
  PathDriver driver({"beads", 1500.0, kBeads});
  Leg leg;
  leg.duration = 1.0;
  leg.steps = 10;
  for (const int k : {kXx, kYy, kZz}) {
    leg.control[k] = Control::stress;
    leg.target[k] = -pressure;
  }
  driver.run(leg);
  Leg flow;
  flow.duration = shear / rate;
  flow.steps = steps;
  flow.from_start = true;
  flow.control[kZz] = Control::stress;
  flow.target[kZz] = -pressure;
  flow.control[kXz] = Control::simple_shear;
  flow.target[kXz] = shear;
  driver.run(flow);
  return driver;
}

// In steady simple shear the normal stresses are p but for the elastic part of the shear, tau / G, which turns with the
// flow: 1e-5 of p here, and half of the shear of a step. tau = mu(I) p. Long and short steps give the same: the return
// is implicit.
TEST(MuI, SimpleShearIsTheClosedForm) {
  for (const double pressure : {1e3, 20e3}) {
    for (const double rate : {1e-3, 1.0, 30.0, 1e3}) {
      for (const int steps : {40, 2000}) {
        const Symmetric3<double> s = sheared(rate, pressure, 0.4, steps).point().cauchy();
        const double expected = friction(rate, pressure) * pressure;
        const double tolerance = 1e-4 + kLimiting / 2.0 * 0.4 / steps;
        EXPECT_NEAR(s.xz, expected, tolerance * expected) << pressure << ' ' << rate << ' ' << steps;
        EXPECT_NEAR(trace(s) / 3.0, -pressure, tolerance * pressure);
      }
    }
  }
}

// Faster and faster flow has the limiting friction, slow flow the static one.
TEST(MuI, HasTwoLimits) {
  EXPECT_NEAR(sheared(1e9, 10e3, 0.4, 2000).point().cauchy().xz, kLimiting * 10e3, 1e-3 * 10e3);
  EXPECT_NEAR(sheared(1e-9, 10e3, 0.4, 2000).point().cauchy().xz, kStatic * 10e3, 1e-3 * 10e3);
}

// Sheared at constant volume the pressure stays, since flow does not dilate.
TEST(MuI, KeepsItsVolume) {
  MaterialPoint point({"beads", 1500.0, kBeads});
  for (int n = 0; n < 10; ++n) point.advance({-1e-4, 0, 0, 0, -1e-4, 0, 0, 0, -1e-4}, 1e-3);
  const double before = trace(point.cauchy());
  for (int n = 0; n < 1000; ++n) point.advance({0, 0, 1e-3, 0, 0, 0, 0, 0, 0}, 1e-3);
  EXPECT_NEAR(trace(point.cauchy()), before, 1e-9 * std::abs(before));
}

// The stress at the end of a step meets mu(I) at the rate of the step, in the root of the quadratic that the plastic
// strain itself shows: from random states, in steps from far below to far above the time of the flow.
TEST(MuI, EveryStepMeetsTheLaw) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> decades(-8.0, 2.0);
  constexpr double kRoundOff = 1e-8;  // [Pa], of a predictor of 1 MPa: 1e-14
  int flowed = 0;
  for (int n = 0; n < 2000; ++n) {
    MaterialPoint point({"beads", 1500.0, kBeads});
    point.advance({-3e-4, 0, 0, 0, -3e-4, 0, 0, 0, -3e-4}, 1.0);
    const double dt = std::pow(10.0, decades(random));
    for (int k = 0; k < 3; ++k) {
      const double strain = point.plastic_strain();
      point.advance(paths::random_gradient(random, 1e-3), dt);
      const double plastic = point.plastic_strain() - strain;
      if (plastic == 0.0) continue;
      const Symmetric3<double> s = point.cauchy();
      const double pressure = -trace(s) / 3.0;
      if (!(pressure > 0.0)) continue;
      ++flowed;
      const double tau = std::sqrt(0.5 * squared_norm(scale_shift(s, 1.0, pressure)));
      EXPECT_NEAR(tau, friction(plastic / dt, pressure) * pressure, 1e-9 * pressure + kRoundOff) << dt;
    }
  }
  EXPECT_GT(flowed, 1000);
}

// Grain that is pulled apart carries nothing, and nothing on its way back until it has closed: 1 % apart, 0.9 % back.
TEST(MuI, OpensWithoutTension) {
  MaterialPoint point({"beads", 1500.0, kBeads});
  for (int n = 0; n < 100; ++n) point.advance({1e-4, 0, 0, 0, 0, 0, 0, 0, 0}, 1e-3);
  EXPECT_EQ(squared_norm(point.cauchy()), 0.0);
  for (int n = 0; n < 90; ++n) point.advance({-1e-4, 0, 0, 0, 0, 0, 0, 0, 0}, 1e-3);
  EXPECT_EQ(squared_norm(point.cauchy()), 0.0);
  for (int n = 0; n < 20; ++n) point.advance({-1e-4, 0, 0, 0, 0, 0, 0, 0, 0}, 1e-3);
  EXPECT_LT(trace(point.cauchy()), -1e3);
}

}  // namespace mu_i_test
}  // namespace mpm
