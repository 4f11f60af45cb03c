// Sleep of blocks in simulations whose steps a device takes: what falls asleep and wakes does so in the same steps as
// on the processor, and the accounts are the same. Cost: 6 s.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "../unit/checkpoint_run.hpp"
#include "gpu_runs.hpp"
#include "mpm/checkpoint/checkpoint.hpp"
#include "mpm/scene/scene.hpp"
#include "mpm/simulation/state_set.hpp"

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
  SimulationOptions chosen = options(false);
  if (on_device) chosen.device = mpm_gpu::device_by(mpm_gpu::Executor(mpm_gpu::Visits::shuffled));
  chosen.isa = mpm::Isa::plain;  // the number of lanes says when the processor sorts particles to be faster
  return Simulation(mpm::build(mpm::parse_scene(text, "sleep.yaml", changes)), chosen);
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

/// The same, of a bed that sleeps at some time, in whole or in part, and wakes.
void expect_waking_alike(const char* text, int periods, const std::vector<std::string>& changes = {},
                         double bound = kRoundOff) {
  const Asleep seen = expect_sleep_alike(text, periods, changes, bound);
  EXPECT_GT(seen.most, 1000);
  EXPECT_LT(seen.least_after, seen.most);
}
const int kPressed = 20, kFallen = 36;  ///< sync periods until a tool, or a block, has woken most of the bed

TEST(GpuSleep, ABedWakesUnderATool) { expect_waking_alike(kBed, kPressed); }
TEST(GpuSleep, ABedFallsAsleepAndWakesWhenStruck) { expect_waking_alike(kStruck, kFallen); }
TEST(GpuSleep, AtPoints) {
  expect_waking_alike(kBed, kPressed, {"contact.method=points"}, 2e-3);  // sweeps, as in gpu_contact_test.cpp
}
TEST(GpuSleep, InSingle) { expect_waking_alike(kBed, kPressed, {"method.precision=single"}, 1e-5); }
TEST(GpuSleep, WithFmpm) { expect_waking_alike(kBed, kPressed, {"method={update: usl, transfer: {fmpm: 2}}"}); }
TEST(GpuSleep, WithXpic) {
  expect_waking_alike(kStruck, 30, {"method={update: usavg, shape: ugimp_stretch, transfer: {xpic: 2}}"});
}
TEST(GpuSleep, WithMixture) {
  expect_waking_alike(kStruck, 30, {"method={update: usf, transfer: {flip: 0.6, xpic: 2, every: 5}}"});
}
TEST(GpuSleep, WithSplines) { expect_waking_alike(kBed, 15, {"method={update: usf, shape: bspline3}"}); }
TEST(GpuSleep, WithDampingOfSlowNodes) { expect_waking_alike(kStruck, kFallen, {"sleep.damping=0.3"}); }
TEST(GpuSleep, WithMeanStresses) { expect_waking_alike(kBed, kPressed, {"method.average_stress=true"}); }

// Material asleep bears the load that it had, and wakes when that changes.
TEST(GpuSleep, UnderLoads) {
  expect_waking_alike(kStruck, 28,
                      {"loads=[{body_force: {acceleration: [\"0.1+2*min(1, max(0, (t-0.1)/0.05))\", 0]}}]"});
  expect_waking_alike(kStruck, 28,
                      {"loads=[{traction: {body: bed, edge: z_max, traction: [0, \"-300-300*min(1, max(0, "
                       "(t-0.1)/0.05))\"]}}]"});
}

// No particle is left to step.
TEST(GpuSleep, AllAtRest) {
  const std::vector<std::string> alone = {"rigid_bodies=[]"};
  Simulation here = run_of(kBed, false, alone), there = run_of(kBed, true, alone);
  for (Simulation* one : {&here, &there}) {
    advance(*one, 4);
    EXPECT_EQ(asleep(*one), 2400);
  }
  expect_sums_alike(here, there);
  EXPECT_EQ(difference(here, there, "z"), 0.0);
}

// Places along a periodic axis are compared on its circle elsewhere.
TEST(GpuSleep, OnPeriodicAxes) {
  const std::vector<std::string> around = {"grid.max=[1.28, 0.5]", "bodies.0.shape.box.max=[1.28, 0.2]",
                                           "bodies.1.shape.box={min: [1.12, 0.32], max: [1.24, 0.4]}",
                                           "bodies.1.initial={velocity: [1, 0]}",
                                           "boundaries={x: periodic, z_min: {friction: 0.6}}"};
  Simulation here = run_of(kStruck, false, around), there = run_of(kStruck, true, around);
  double most = 0.0;
  for (int i = 0; i < 31; ++i) {
    here.advance();
    there.advance();
    most = std::max(most, asleep(here));
    EXPECT_EQ(asleep(here), asleep(there)) << "after period " << i;
  }
  EXPECT_GT(most, 1000);
  EXPECT_LT(asleep(here), most);
  expect_sums_alike(here, there);
  for (const char* name : {"z", "vx", "szz"}) EXPECT_LT(difference(here, there, name), kRoundOff) << name;
}

// A checkpoint of material asleep: a run that goes on from it on the device does so to the bit, as does the one that
// wrote it; one that goes on on the other processor agrees.
void expect_checkpoints_alike(const char* text, int before, int after) {
  const mpm::test::Folder folder;
  Simulation whole = run_of(text, false), quiet = run_of(text, true);
  advance(whole, before + after);
  advance(quiet, before + after);
  for (const bool begins_on_device : {true, false}) {
    const std::string file = folder.file("half.h5");
    Simulation first = run_of(text, begins_on_device), again = run_of(text, begins_on_device),
               other = run_of(text, !begins_on_device);
    advance(first, before);
    EXPECT_GT(asleep(first), 1000);
    mpm::save_checkpoint(file, first, {});
    mpm::load_checkpoint(file, again, "");
    mpm::load_checkpoint(file, other, "");
    EXPECT_EQ(first.state_hash(), other.state_hash());
    EXPECT_EQ(first.memory_hash(), again.memory_hash());
    for (Simulation* one : {&first, &again, &other}) advance(*one, after);
    EXPECT_EQ(first.state_hash(), again.state_hash());
    if (begins_on_device) {
      EXPECT_EQ(first.state_hash(), quiet.state_hash());
    }
    EXPECT_EQ(asleep(whole), asleep(other));
    expect_alike(whole, other);
  }
}
TEST(GpuSleep, CheckpointsOfABedUnderATool) { expect_checkpoints_alike(kBed, 13, 5); }
TEST(GpuSleep, CheckpointsOfABedThatIsStruck) { expect_checkpoints_alike(kStruck, 29, 3); }

// Reading between two sync points changes nothing that follows, and sees what sleeps.
TEST(GpuSleep, ReadingChangesNothing) {
  Simulation quiet = run_of(kBed, true), read = run_of(kBed, true);
  for (int i = 0; i < 16; ++i) {
    quiet.advance();
    read.advance();
    field(read, "szz");
    read.memory_hash();
  }
  EXPECT_EQ(quiet.state_hash(), read.state_hash());
}

// A tool that is set down beside what sleeps wakes it.
TEST(GpuSleep, WakesWhereABodyIsSet) {
  const std::vector<std::string> still = {"rigid_bodies.0.motion.velocity=[0, 0]"};
  Simulation here = run_of(kBed, false, still), there = run_of(kBed, true, still);
  for (Simulation* one : {&here, &there}) {
    advance(*one, 3);
    const double before = asleep(*one);
    mpm::StateSet beside;
    beside.name = "plate";
    beside.pose = mpm::Pose{{0.8, 0.0, 0.26}, mpm::Quat::Identity()};
    one->set_state(beside);
    EXPECT_LT(asleep(*one), before);
    advance(*one, 3);
  }
  EXPECT_EQ(asleep(here), asleep(there));
  expect_sums_alike(here, there);
  EXPECT_LT(difference(here, there, "szz"), kRoundOff);
}

// A condition of velocity zero holds nodes under what sleeps; one that sets off wakes it.
TEST(GpuSleep, BesideConditions) {
  const std::vector<std::string> held = {
      "boundaries={x_min: slip, x_max: slip, z_min: slip, conditions: [{region: {box: {min: [0.5, 0], max: [0.6, "
      "0.03]}}, direction: x, velocity: \"0.05*min(1, max(0, (t-0.12)/0.01))\"}]}",
      "sleep.speed=4 mm/s"};
  expect_waking_alike(kStruck, 28, held);
}

}  // namespace gpu_sleep_test
