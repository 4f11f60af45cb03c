// Implicit steps with loads: soil answers to them in the same step, and their momentum and work are exact. Cost: 1 s.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "implicit_scene.hpp"

namespace implicit_loads_test {

constexpr double kDensity = 1600.0, kGravity = 9.81, kLoad = 5e3;

/// A bed of sand of 0.4 m between smooth walls.
std::string bed(double gravity, const std::string& rest) {
  return fmt::format(
      "geometry: plane_strain\ngravity: [0, {}]\nmethod: {{update: implicit}}\ntime: {{end: 1, sync: 0.01}}\n"
      "grid: {{cell: 0.05, min: [0, 0], max: [0.4, 0.6]}}\n"
      "materials: [{{name: sand, law: mohr_coulomb, density: {}, young: 2 MPa, poisson: 0.3, friction_angle: 30 deg, "
      "cohesion: 0}}]\n"
      "bodies: [{{name: sand, material: sand, shape: {{box: {{min: [0, 0], max: [0.4, 0.4]}}}}}}]\n"
      "boundaries: {{x_min: slip, x_max: slip, z_min: {{friction: 0.577}}}}\n{}",
      -gravity, kDensity, rest);
}

using verification::start_text;

const std::string kTraction = fmt::format(
    "loads: [{{traction: {{body: sand, edge: z_max, traction: [0, \"-{} * min(1, t / 0.2)\"]}}}}]\n", kLoad);

// A traction on the surface adds itself to the stress of soil at rest, sigma_zz = -(rho g d + q), in the middle of
// every cell; a settlement that is elastic takes its work.
TEST(ImplicitLoads, ATractionAddsItsStress) {
  mpm::Simulation run = start_text(bed(kGravity, kTraction), {"bodies.sand.initial=geostatic", "method.sweeps=200"});
  const mpm::EnergyReport before = run.state().energy;
  verification::run_until(run, 1.0);
  const std::vector<double> z = verification::field(run, "z"), s = verification::field(run, "szz");
  const double top = *std::max_element(z.begin(), z.end()) + 0.0125;
  double sum = 0.0, exact = 0.0, worst = 0.0;
  for (std::size_t i = 0; i < z.size(); ++i) {
    sum += s[i];
    exact -= kDensity * kGravity * (top - z[i]) + kLoad;
    const double middle = 0.05 * std::floor(z[i] / 0.05) + 0.025;
    const double own = -(kDensity * kGravity * (top - middle) + kLoad);
    worst = std::max(worst, std::abs(s[i] / own - 1.0));
  }
  EXPECT_NEAR(sum / exact, 1.0, 0.005);
  EXPECT_LT(worst, 0.03);
  EXPECT_LT(run.state().audit.residual, 1e-12);
  RecordProperty("mean", fmt::format("{:.4f}", sum / exact));
  RecordProperty("worst", fmt::format("{:.4f}", worst));
  const mpm::EnergyReport after = run.state().energy;
  EXPECT_GT(after.of("load_work"), 0.0);
  EXPECT_NEAR(after.balance() - before.balance(), 0.0, 0.05 * after.of("load_work"));
  RecordProperty("work", fmt::format("{:.3f} {:.4f}", after.of("load_work"), after.balance() - before.balance()));
}

// The very step in which a load comes has its stress: where sweeps are enough, all of it.
TEST(ImplicitLoads, SoilAnswersInTheSameStep) {
  mpm::Simulation run =
      start_text(bed(0.0, "loads: [{traction: {body: sand, edge: z_max, traction: [0, -5000]}}]\n"),
                 {"materials.sand.young=200 MPa", "method.sweeps=1000", "materials.sand.cohesion=1 MPa"});
  run.advance();
  const std::vector<double> s = verification::field(run, "szz");
  double mean = 0.0;
  for (const double one : s) mean += one / static_cast<double>(s.size());
  EXPECT_NEAR(mean / -kLoad, 1.0, 0.05);
  RecordProperty("mean", fmt::format("{:.4f}", mean / -kLoad));
}

// A body force that is gravity does what gravity does, and a force on all particles that is the weight, too.
TEST(ImplicitLoads, ABodyForceIsGravity) {
  const auto fallen = [](double gravity, const std::string& loads) {
    mpm::Simulation run = start_text(bed(gravity, loads));
    verification::run_until(run, 0.2);
    EXPECT_LT(run.state().audit.residual, 1e-12);
    return verification::field(run, "z");
  };
  const std::vector<double> by_gravity = fallen(kGravity, "");
  const double weight = kDensity * 0.4 * 0.4 * kGravity;
  for (const std::string& loads :
       {fmt::format("loads: [{{body_force: {{acceleration: [0, -{}]}}}}]\n", kGravity),
        fmt::format("loads: [{{particle_force: {{force: [0, -{}], body: sand}}}}]\n", weight)}) {
    const std::vector<double> z = fallen(0.0, loads);
    double most = 0.0;
    for (std::size_t i = 0; i < z.size(); ++i) most = std::max(most, std::abs(z[i] - by_gravity[i]));
    EXPECT_LT(most, 1e-8) << loads;  // error in 1 mm; nodes that hardly carry anything are given some mass
  }
}

// The same bits for any number of threads, and from a checkpoint.
TEST(ImplicitLoads, KeepTheirBits) { verification::expect_kept_bits(bed(kGravity, kTraction), 0.1, 0.3); }

}  // namespace implicit_loads_test
