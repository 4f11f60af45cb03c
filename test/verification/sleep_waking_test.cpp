// Material that sleeps wakes when its support goes, and soil that would fall does not fall asleep. Costs 8 s.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "scene_run.hpp"

namespace verification {
namespace sleep_waking_test {

mpm::Simulation of_text(const std::string& text, const std::vector<std::string>& changes = {}) {
  return mpm::Simulation(mpm::parse_scene(text, "sleep.yaml", changes));
}

double mean_height(const mpm::Simulation& run) {
  const std::vector<double> heights = field(run, "z");
  double sum = 0.0;
  for (const double height : heights) sum += height;
  return sum / static_cast<double>(heights.size());
}

// Soil that is put to sleep from the start stands only where it would: a column whose side is free falls.
TEST(SleepWaking, FromTheStartWhatWouldFallIsAwake) {
  const char* const kColumn = R"yaml(
geometry: plane_strain
thickness: 0.1
grid: {cell: 0.02, min: [0, 0], max: [1.6, 0.8]}
time: {end: 0.5, sync: 5 ms, cfl: 0.5}
gravity: [0, -9.81]
materials: [{name: sand, law: drucker_prager, density: 1600, young: 1 MPa, poisson: 0.3, friction_angle: 34 deg}]
bodies: [{name: bed, material: sand, shape: {box: {min: [0.0, 0.0], max: [0.4, 0.6]}}, initial: {stress: {zz: "-1600*9.81*(0.6-z)", xx: "-800*9.81*(0.6-z)", yy: "-800*9.81*(0.6-z)"}}}]
boundaries: {x_min: slip, x_max: slip, z_min: {friction: 0.6}}
)yaml";
  mpm::Simulation with = of_text(kColumn, {"sleep={from_start: true}"}), without = of_text(kColumn);
  const double high = mean_height(without);
  run_until(with, 0.5);
  run_until(without, 0.5);
  const double fell = high - mean_height(without);
  EXPECT_GT(fell, 0.05);
  EXPECT_NEAR(high - mean_height(with), fell, 0.02 * fell);
}

// A wall that retains stiff soil moves away: what it held slides down, block after block, as without sleep. The change
// of force at a border is slow, and far below what a wave that wakes a block brings.
TEST(SleepWaking, ABedWhoseSupportGoesAwayWakes) {
  const char* const kGate = R"yaml(
geometry: plane_strain
thickness: 0.1
grid: {cell: 0.02, min: [0, 0], max: [1.6, 0.6]}
time: {end: 0.7, sync: 5 ms, cfl: 0.5}
gravity: [0, -9.81]
materials: [{name: sand, law: drucker_prager, density: 1600, young: 20 MPa, poisson: 0.3, friction_angle: 30 deg}]
bodies: [{name: bed, material: sand, shape: {box: {min: [0.0, 0.0], max: [0.8, 0.3]}}, initial: geostatic}]
rigid_bodies:
  - {name: gate, shape: {box: {size: [0.1, 0.5]}}, pose: {position: [0.85, 0.25]}, friction: 0,
     motion: {velocity: ["0.5*min(1, max(0, (t-0.1)/0.05))", 0]}}
boundaries: {x_min: slip, x_max: slip, z_min: {friction: 0.6}}
)yaml";
  mpm::Simulation with = of_text(kGate, {"sleep={from_start: true}"}), without = of_text(kGate);
  const double high = mean_height(without);
  run_until(with, 0.1);
  EXPECT_GT(number(with, "asleep"), 0.5 * static_cast<double>(with.particles()));
  run_until(with, 0.7);
  run_until(without, 0.7);
  const double fell = high - mean_height(without);
  EXPECT_GT(fell, 0.01);
  EXPECT_NEAR(high - mean_height(with), fell, 0.03 * fell);
}

}  // namespace sleep_waking_test
}  // namespace verification
