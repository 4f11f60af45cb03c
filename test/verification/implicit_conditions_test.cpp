// Implicit steps with prescribed velocities: clay that is pressed together and sheared by them, against the elastic and
// the limiting stress; momentum, energy and bits. Cost: 1 s.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "implicit_scene.hpp"

namespace implicit_conditions_test {

constexpr double kYoung = 2e6, kPoisson = 0.3, kCohesion = 5e3, kWidth = 0.4, kHeight = 0.4;

/// Weightless clay of Tresca's law between x = 0 and 0.4 m, 0.4 m high.
std::string clay(const std::string& boundaries, const std::string& rest = "", double cohesion = kCohesion) {
  return fmt::format(
      "geometry: plane_strain\nmethod: {{update: implicit}}\ntime: {{end: 1, sync: 0.01}}\n"
      "grid: {{cell: 0.05, min: [0, 0], max: [{}, 0.6]}}\n"
      "materials: [{{name: clay, law: mohr_coulomb, density: 1600, young: {}, poisson: {}, friction_angle: 0, "
      "cohesion: {}}}]\n"
      "bodies: [{{name: clay, material: clay, shape: {{box: {{min: [0, 0], max: [{}, {}]}}}}}}]\n"
      "boundaries:\n{}{}",
      kWidth, kYoung, kPoisson, cohesion, kWidth, kHeight, boundaries, rest);
}

using verification::given;
using verification::start_text;

/// The row of nodes at the upper end moves along z, faster and faster, by 1 % of the height in a second.
const std::string kPressed =
    "  x_min: slip\n  x_max: slip\n  z_min: slip\n  conditions:\n"
    "    - {name: lid, region: {box: {min: [-1, 0.38], max: [1, 1]}}, direction: z, velocity: \"-0.01 * t\"}\n";

// Pressed together between smooth walls clay has the stress M times the strain, M = E (1 - nu) / ((1 + nu) (1 - 2 nu)),
// and that is what the condition gives, where sweeps are enough for a modulus far above rho (h / dt)^2.
TEST(ImplicitConditions, PressClayTogether) {
  mpm::Simulation run = start_text(clay(kPressed, "", 1e6), {"method.sweeps=400"});
  verification::run_until(run, 0.8);
  const double before = given(run, "condition/lid").z();
  verification::run_until(run, 0.9);
  const double force = (given(run, "condition/lid").z() - before) / 0.1;
  const double moduli = kYoung * (1.0 - kPoisson) / ((1.0 + kPoisson) * (1.0 - 2.0 * kPoisson));
  // From the rows that move to the bottom; mean of t^2 from 0.8 to 0.9 s, and logarithmic strain.
  const double travel = 0.005 * (std::pow(0.9, 3) - std::pow(0.8, 3)) / 0.3;
  const double exact = -moduli * std::log(1.0 / (1.0 - travel / 0.4)) * kWidth;
  EXPECT_NEAR(force / exact, 1.0, 0.02);
  RecordProperty("over_exact", fmt::format("{:.4f}", force / exact));
  EXPECT_LT(run.state().audit.residual, 1e-12);
}

/// The upper end moves along x, and not along z, between periodic faces.
const std::string kSheared =
    "  x: periodic\n  z_min: fixed\n  conditions:\n"
    "    - {name: lid, region: {box: {min: [-1, 0.38], max: [1, 1]}}, direction: x, velocity: 0.04}\n"
    "    - {name: keep, region: {box: {min: [-1, 0.38], max: [1, 1]}}, direction: z, velocity: 0}\n";

// Sheared clay has the stress c, and the work of the condition is what it takes.
TEST(ImplicitConditions, ShearClay) {
  mpm::Simulation run = start_text(clay(kSheared));
  const mpm::EnergyReport start_energy = run.state().energy;
  verification::run_until(run, 0.5);
  const double before = given(run, "condition/lid").x();
  verification::run_until(run, 1.0);
  const double force = (given(run, "condition/lid").x() - before) / 0.5;
  EXPECT_NEAR(force / (kCohesion * kWidth), 1.0, 0.02);
  RecordProperty("over_exact", fmt::format("{:.4f}", force / (kCohesion * kWidth)));
  EXPECT_LT(run.state().audit.residual, 1e-12);
  const mpm::EnergyReport energy = run.state().energy;
  EXPECT_NEAR(energy.of("load_work"), 0.04 * given(run, "condition/lid").x(), 1e-9 * energy.of("load_work"));
  EXPECT_NEAR(energy.balance() - start_energy.balance(), 0.0, 0.02 * energy.of("load_work"));
}

/// A grip that wanders through sheared clay, beside a tool whose points are bound to nodes that it holds.
const std::string kGripped =
    "  x_min: slip\n  x_max: slip\n  z_min: {friction: 0.4}\n  conditions:\n"
    "    - {name: grip, region: {box: {min: [0.05, 0.1], max: [0.15, 0.3]}}, motion: {velocity: [0.1, 0]}, "
    "direction: x}\n";
constexpr const char* kTool =
    "rigid_bodies: [{name: tool, shape: {box: {size: [0.15, 0.2]}}, pose: {position: [0.2, 0.49]}, friction: 0.3, "
    "motion: {velocity: [0, -0.05]}}]\n";

// Momentum is exact where the nodes that are held change and a tool is near; the same bits for any number of threads,
// and from a checkpoint.
TEST(ImplicitConditions, KeepMomentumAndBits) {
  for (const std::string& text : {clay(kGripped, kTool), clay(kSheared)}) {
    verification::expect_kept_bits(text, 0.3, 0.6);
    mpm::Simulation run = start_text(text);
    verification::run_until(run, 0.6);
    EXPECT_LT(run.state().audit.residual, 1e-12);
  }
}

// A tool that stands in a block which a condition carries along at the tool's own velocity meets nothing; the velocity
// of nodes that are held counts at its points.
TEST(ImplicitConditions, CountWhereAToolIs) {
  const std::string still =
      "    - {name: still, region: {box: {min: [-1, -1], max: [1, 1]}}, direction: z, velocity: 0}\n";
  const std::string moves =
      "    - {name: all, region: {box: {min: [-1, -1], max: [1, 1]}}, direction: x, velocity: 0.1}\n";
  const auto run = [&](double velocity, const std::string& conditions) {
    mpm::Simulation simulation =
        start_text(clay("  x: periodic\n  conditions:\n" + conditions,
                        fmt::format("rigid_bodies: [{{name: tool, shape: {{box: {{size: [0.1, 0.2]}}}}, pose: "
                                    "{{position: [0.15, 0.42]}}, friction: 0.3, motion: {{velocity: [{}, 0]}}}}]\n",
                                    velocity)),
                   {"bodies.clay.cut_out=[tool]"});
    simulation.take_contact(0);
    verification::run_until(simulation, 0.2);
    return std::abs(simulation.take_contact(0).mean.force.x());
  };
  EXPECT_LT(run(0.1, moves + still), 1e-9);
  EXPECT_LT(run(0.11, moves + still), 1e-9);  // nodes that are held cannot answer
  EXPECT_GT(run(0.11, still), 1.0);           // soil that is free along x does
}

}  // namespace implicit_conditions_test
