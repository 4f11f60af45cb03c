// mu(I) grain: single elements against the closed form, and a steady flow down a chute against Bagnold's profile.
#include "mpm/material/mu_i.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "material_paths.hpp"
#include "mpm/material/path_driver.hpp"
#include "mpm/math/constants.hpp"
#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"

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

// A layer of depth h on a rough slope of 26 degrees, endless along it, in steady flow: the friction is tan(slope) at
// every depth, so that the inertial number is one and the rate follows the root of the pressure (Bagnold's profile),
//   v(z) = 2/3 (I / d) sqrt(g cos(slope) rho / rho_s) (h^1.5 - (h - z)^1.5),
//   I = I_0 (tan(slope) - mu_s) / (mu_2 - tan(slope)).
// 16 cells on the depth of 0.1 m; from a profile a tenth too fast, for 4 s (the flow settles in 0.5 s). 2 % of the
// speed at the surface: friction within 0.2 %, by the elastic strain and that of the grid, is 3 % of I. APIC, since
// FLIP of 0.998 adds a viscosity of 5 % of the flow's. 2 s.
TEST(MuI, FlowsDownAChuteInBagnoldsProfile) {
  constexpr double kSlope = 26.0 * kPi / 180.0, kDepth = 0.1, kBead = 0.01, kDensity = 1500.0, kGravity = 9.81;
  const double tangent = std::tan(kSlope);
  const double inertial = kReference * (tangent - kStatic) / (kLimiting - tangent);
  const double factor = 2.0 / 3.0 * inertial / kBead * std::sqrt(kGravity * std::cos(kSlope) * kDensity / kGrain);
  const auto text = [](double value) { return std::to_string(value); };
  const std::string profile = text(1.1 * factor) + "*(0.1^1.5-max(0.1-z,0)^1.5)";
  const Scene scene =
      parse_scene("geometry: plane_strain\nthickness: 1\ngravity: [" + text(kGravity * std::sin(kSlope)) + ", " +
                      text(-kGravity * std::cos(kSlope)) +
                      "]\ngrid: {cell: 0.00625, min: [0, 0], max: [0.05, 0.125]}\n"
                      "time: {end: 4, sync: 10 ms}\nmethod: {transfer: apic}\n"
                      "materials:\n  - {name: beads, density: 1500, law: mu_i, young: 1 MPa, poisson: 0.3, mu_s: " +
                      text(kStatic) + ", mu_2: " + text(kLimiting) +
                      ", I_0: 0.279, grain_diameter: 10 mm, grain_density: 2500}\n"
                      "bodies:\n  - {name: layer, material: beads, initial: {velocity: [\"" +
                      profile +
                      "\", 0], stress: {xx: \"-13225*(0.1-z)\", yy: \"-13225*(0.1-z)\", zz: \"-13225*(0.1-z)\"}}, "
                      "shape: {box: {min: [0, 0], max: [0.05, 0.1]}}}\n"
                      "boundaries: {x: periodic, z_min: fixed}\n",
                  "chute.yaml", {});
  Simulation simulation(build(scene), {1});
  while (simulation.time() < 4'000'000'000) simulation.advance();
  std::vector<double> z, v;
  simulation.particle_field("z", z);
  simulation.particle_field("vx", v);
  const double fastest = factor * std::pow(kDepth, 1.5);
  for (std::size_t p = 0; p < z.size(); ++p) {
    if (z[p] < 0.0125) continue;  // two cells at the foot, across which the velocity is a straight line
    const double exact = factor * (std::pow(kDepth, 1.5) - std::pow(std::max(kDepth - z[p], 0.0), 1.5));
    EXPECT_NEAR(v[p], exact, 0.02 * fastest) << z[p];
  }
}

}  // namespace mu_i_test
}  // namespace mpm
