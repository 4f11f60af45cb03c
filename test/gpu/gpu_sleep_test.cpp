// Sleep of blocks in simulations whose steps a device takes: what falls asleep and wakes does so in the same steps as on
// the processor, and the accounts are the same. Cost: 6 s.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "../unit/checkpoint_run.hpp"
#include "gpu_runs.hpp"
#include "mpm/checkpoint/checkpoint.hpp"
#include "mpm/scene/scene.hpp"

namespace gpu_sleep_test {

using namespace gpu_runs;

/// A bed of sand between walls, at rest under its weight, and a plate over it that is pressed in from 10 ms on.
const char* const kBed = R"yaml(
geometry: plane_strain
thickness: 0.1
grid: {cell: 0.02, min: [0, 0], max: [1.2, 0.4]}
time: {end: 1, sync: 5 ms, cfl: 0.5}
gravity: [0, -9.81]
method: {update: usavg}
materials: [{name: sand, law: drucker_prager, density: 1600, young: 1 MPa, poisson: 0.3, friction_angle: 34 deg}]
bodies: [{name: bed, material: sand, shape: {box: {min: [0, 0], max: [1.2, 0.2]}}, initial: geostatic}]
rigid_bodies:
  - {name: plate, shape: {box: {size: [0.16, 0.1]}}, pose: {position: [0.3, 0.27]}, friction: 0.3,
     motion: {velocity: [0, "-0.5*min(1, max(0, (t-0.01)/0.02))"]}}
contact: {method: nodes}
boundaries: {x_min: slip, x_max: slip, z_min: {friction: 0.6}}
sleep: {speed: 5 mm/s, from_start: true}
)yaml";

/// A bed that falls asleep, and a block that falls on it.
const char* const kStruck = R"yaml(
geometry: plane_strain
thickness: 0.1
grid: {cell: 0.02, min: [0, 0], max: [1.2, 0.5]}
time: {end: 1, sync: 5 ms, cfl: 0.5}
gravity: [0, -9.81]
method: {update: usf}
materials: [{name: sand, law: drucker_prager, density: 1600, young: 1 MPa, poisson: 0.3, friction_angle: 34 deg}]
bodies:
  - {name: bed, material: sand, shape: {box: {min: [0, 0], max: [1.2, 0.2]}}, initial: geostatic}
  - {name: stone, material: sand, shape: {box: {min: [0.4, 0.32], max: [0.52, 0.4]}}}
boundaries: {x_min: fixed, x_max: slip, z_min: fixed}
sleep: {speed: 10 mm/s, after: 20 ms}
)yaml";

Simulation run_of(const char* text, bool on_device, const std::vector<std::string>& changes = {}) {
  return Simulation(mpm::build(mpm::parse_scene(text, "sleep.yaml", changes)), options(on_device));
}

double asleep(const Simulation& run) {
  for (const mpm::NamedNumber& one : run.numbers()) {
    if (one.name == "asleep") return one.value;
  }
  return -1.0;
}

/// Largest and smallest number of particles asleep at sync points, once some were.
struct Asleep {
  double most = 0.0, least_after = 0.0;
};

/// Expects as many particles to be asleep at each of so many sync points, and all to be alike at the last.
Asleep expect_sleep_alike(const char* text, int periods, const std::vector<std::string>& changes = {},
                          double bound = kRoundOff) {
  Simulation here = run_of(text, false, changes), there = run_of(text, true, changes);
  Asleep seen;
  for (int i = 0; i < periods; ++i) {
    here.advance();
    there.advance();
    const double now = asleep(here);
    EXPECT_EQ(now, asleep(there)) << "after period " << i;
    if (now >= seen.most) seen.least_after = now;
    seen.most = std::max(seen.most, now);
    seen.least_after = std::min(seen.least_after, now);
  }
  expect_alike(here, there, bound);
  EXPECT_LT(difference(here, there, "szz"), bound);
  return seen;
}

TEST(GpuSleep, ABedWakesUnderATool) {
  const Asleep seen = expect_sleep_alike(kBed, 20);
  EXPECT_GT(seen.most, 1000);
  EXPECT_LT(seen.least_after, seen.most);
}
TEST(GpuSleep, ABedFallsAsleepAndWakesWhenStruck) {
  const Asleep seen = expect_sleep_alike(kStruck, 40);
  EXPECT_GT(seen.most, 1000);
  EXPECT_LT(seen.least_after, seen.most);
}

}  // namespace gpu_sleep_test
