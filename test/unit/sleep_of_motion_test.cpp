// Slow motion that may not fall asleep: what begins to slide, creeps or swings goes on to the bit as without sleep.
// Cost: 5 s.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "sleep_run.hpp"

namespace mpm::test {
namespace sleep_of_motion_test {

double fastest(const Simulation& run) {
  const std::vector<double> speed = field(run, "speed");
  return *std::max_element(speed.begin(), speed.end());
}

/// Runs to `end`, and returns the least that the highest speed of any particle was at a sync point after `from` [m/s].
double least_speed(Simulation& run, double from, double end) {
  double least = std::numeric_limits<double>::infinity();
  while (1e-9 * static_cast<double>(run.time()) < end - 1e-9) {
    run.advance();
    if (1e-9 * static_cast<double>(run.time()) > from) least = std::min(least, fastest(run));
  }
  return least;
}

// A layer about to slide, on a slope without end that is steeper than friction holds by a five-hundredth: it sets off
// at g cos (tan slope - friction) = 0.009 m/s^2, and is slower than the speed of sleep for half a second. It slides on
// to the bit as without sleep.
TEST(Sleep, ASlopeAboutToSlideIsNotFrozen) {
  const char* const kSlope = R"yaml(
geometry: plane_strain
grid: {cell: 0.05, min: [0, 0], max: [2, 0.5]}
time: {end: 1, sync: 5 ms, cfl: 0.5}
gravity: [4.3948, -8.7721]
materials: [{name: soil, law: neo_hookean, density: 1600, young: 1 MPa, poisson: 0}]
bodies: [{name: block, material: soil, shape: {box: {min: [0, 0], max: [2, 0.2]}}, initial: {stress: {zz: "-1600*8.7721*(0.2-z)", xz: "1600*4.3948*(0.2-z)"}}}]
boundaries: {x: periodic, z_min: {friction: 0.5}}
)yaml";
  Simulation with = start(kSlope, {"sleep={}"}), without = start(kSlope);
  const std::vector<double> before = field(without, "x");
  advance_to(with, 0.3);
  EXPECT_LT(fastest(with), 0.007) << "the default speed of sleep: a hundredth of (g cell)^1/2";
  advance_to(with, 1.0);
  advance_to(without, 1.0);
  const std::vector<double> after = field(without, "x");
  double slid = 0.0;
  for (std::size_t p = 0; p < after.size(); ++p) slid += std::remainder(after[p] - before[p], 2.0);
  slid /= static_cast<double>(after.size());
  EXPECT_NEAR(slid, 0.5 * (4.3948 - 0.5 * 8.7721), 0.1 * slid) << "half g cos (tan - friction)";
  EXPECT_EQ(with.state_hash(), without.state_hash());
}

// A column that creeps: a viscous fluid between walls without friction at its sides, pressed together slowly; its speed
// is below that of sleep everywhere, and above a tenth of it.
TEST(Sleep, ACreepingColumnIsNotFrozen) {
  const char* const kColumn = R"yaml(
geometry: plane_strain
grid: {cell: 0.05, min: [0, 0], max: [1, 0.8]}
time: {end: 1, sync: 5 ms, cfl: 0.5}
gravity: [0, -9.81]
materials: [{name: gum, law: viscoelastic, density: 1000, young: 20 kPa, poisson: 0.3, branch_modulus: 80 kPa, relaxation_time: 2}]
bodies: [{name: column, material: gum, shape: {box: {min: [0.3, 0], max: [0.7, 0.6]}}}]
boundaries: {z_min: slip}
)yaml";
  const std::string sleep = "sleep={speed: 0.2, wake: 0.6, after: 0.05}";
  Simulation with = start(kColumn, {sleep}), without = start(kColumn);
  EXPECT_LT(least_speed(with, 0.1, 1.0), 0.2) << "it is seen as slow";
  advance_to(without, 1.0);
  EXPECT_EQ(with.state_hash(), without.state_hash());
}

// An elastic block that swings, seen through a speed of sleep that it exceeds only near the middle of its way: at the
// ends of it each block turns, with a mean velocity in each half of the time of watching.
TEST(Sleep, AnElasticBlockThatSwingsIsNotFrozen) {
  const char* const kBlock = R"yaml(
geometry: plane_strain
grid: {cell: 0.05, min: [0, 0], max: [1, 0.8]}
time: {end: 1, sync: 5 ms, cfl: 0.5}
gravity: [0, -9.81]
materials: [{name: rubber, law: neo_hookean, density: 1000, young: 50 kPa, poisson: 0.3}]
bodies: [{name: block, material: rubber, shape: {box: {min: [0.3, 0], max: [0.7, 0.4]}}}]
boundaries: {z_min: fixed}
)yaml";
  const std::string sleep = "sleep={speed: 0.1, wake: 0.3, after: 0.02}";
  Simulation with = start(kBlock, {sleep}), without = start(kBlock);
  EXPECT_LT(least_speed(with, 0.1, 1.0), 0.1) << "it is seen as slow";
  advance_to(without, 1.0);
  EXPECT_EQ(with.state_hash(), without.state_hash());
}

}  // namespace sleep_of_motion_test
}  // namespace mpm::test
