// Sleep of material at rest: what a wave wakes, and that nothing is lost on the way. What may not fall asleep is in
// sleep_of_motion_test.cpp, what sleep does to forces and to slides in test/verification.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "mpm/particles/permute.hpp"
#include "mpm/sleep/sleeping_blocks.hpp"
#include "sleep_run.hpp"

namespace mpm::test {
namespace sleep_test {

constexpr double kG = 9.81;

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// A bed of sand at rest with a plate over its left end that is pressed in from 0.1 s on.
const char* const kBed = R"yaml(
geometry: plane_strain
thickness: 0.1
grid: {cell: 0.02, min: [0, 0], max: [1.6, 0.5]}
time: {end: 1, sync: 5 ms, cfl: 0.5}
gravity: [0, -9.81]
materials: [{name: sand, law: drucker_prager, density: 1600, young: 1 MPa, poisson: 0.3, friction_angle: 34 deg}]
bodies: [{name: bed, material: sand, shape: {box: {min: [0, 0], max: [1.6, 0.2]}}, initial: geostatic}]
rigid_bodies:
  - {name: plate, shape: {box: {size: [0.16, 0.1]}}, pose: {position: [0.3, 0.26]}, friction: 0.3,
     motion: {velocity: [0, "-0.1*min(1, max(0, (t-0.1)/0.05))"]}}
boundaries: {x_min: slip, x_max: slip, z_min: {friction: 0.6}}
)yaml";
const std::string kSleep = "sleep={speed: 5 mm/s}";

/// Particles with numbers of their own, that move.
ParticleSet numbered_particles(int count) {
  ParticleSet set;
  set.mass = 2.0;
  set.id.resize(count);
  set.x.resize(2);
  for (auto& x : set.x) x.resize(count);
  set.v = {ParticleScalar(Precision::float64, count), ParticleScalar(Precision::float64, count)};
  set.f = {ParticleScalar(Precision::float64, count)};
  for (int p = 0; p < count; ++p) {
    set.id[p] = static_cast<std::uint32_t>(100 + p);
    set.x[0][p] = p;
    set.x[1][p] = -p;
    set.v[0].set(p, 0.5);
    set.f[0].set(p, 1.0 + p);
  }
  set.next_x = set.x;
  for (int p = 0; p < count; ++p) set.next_x[0][p] = -1e9;  // place of a step before: may not be taken for a place
  return set;
}

/// Each particle is there once, with what is its own; those asleep, and no others, are at rest.
void expect_own_numbers(const ParticleSet& set, int asleep) {
  EXPECT_EQ(set.asleep, asleep);
  std::set<std::uint32_t> seen;
  for (int p = 0; p < set.size(); ++p) {
    const int own = static_cast<int>(set.id[p]) - 100;
    EXPECT_TRUE(seen.insert(set.id[p]).second);
    EXPECT_EQ(set.x[0][p], own);
    EXPECT_EQ(set.x[1][p], -own);
    EXPECT_EQ(set.f[0][p], 1.0 + own);
    EXPECT_EQ(set.v[0][p] == 0.0, p >= set.awake());
    if (p >= set.awake()) {
      EXPECT_EQ(set.next_x[0][p], own);
    }
  }
}

SleepingBlocks::Sleeper sleeper(int owner) {
  return {{0, static_cast<std::uint64_t>(10 + owner)}, owner, 3.0, 0.0, std::make_unique<BlockForces>()};
}

const GridLayout kLayout(2, Vec3(1, 1, 1), Vec3::Zero(), Vec3(16, 1, 16));

// In four blocks: whoever sleeps and wakes, each keeps its own.
TEST(SleepingBlocks, ParticlesKeepWhatIsTheirs) {
  std::vector<ParticleSet> sets{numbered_particles(40)};
  ParticleSet& set = sets[0];
  set.begin = {0, 7, 20, 33, 40};
  SleepingBlocks asleep(sets, kLayout, false);
  std::vector<SleepingBlocks::Sleeper> two;
  two.push_back(sleeper(0));
  two.push_back(sleeper(2));
  const TakenMotion taken = asleep.put_to_sleep(two);
  expect_own_numbers(set, 20);
  EXPECT_DOUBLE_EQ(taken.momentum.x(), 20 * 2.0 * 0.5);
  EXPECT_DOUBLE_EQ(taken.energy, 20 * 0.5 * 2.0 * 0.25);
  EXPECT_DOUBLE_EQ(asleep.mass(), 40.0);

  set.begin = {0, 20};  // the others, now in one block
  for (int p = 0; p < 20; ++p) set.v[0].set(p, 0.5);
  std::vector<SleepingBlocks::Sleeper> rest;
  rest.push_back(sleeper(0));
  rest.back().name.key = 11;
  asleep.put_to_sleep(rest);
  expect_own_numbers(set, 40);

  const auto wake = [&](std::uint64_t key, int then_asleep) {
    const int before = set.awake();
    asleep.wake({0, key});
    for (int p = before; p < set.awake(); ++p) set.v[0].set(p, 0.5);
    expect_own_numbers(set, then_asleep);
  };
  wake(10, 33);  // seven that lie among the others
  wake(11, 13);
  wake(12, 0);
  EXPECT_EQ(asleep.mass(), 0.0);
  EXPECT_TRUE(asleep.all().empty());
}

/// Leaves the first `stay` of those awake, and has others come.
void replace_awake(ParticleSet& set, int stay, int come) {
  ParticleOrder order;
  order.begin_anew(set);
  order.add({0, static_cast<std::uint32_t>(stay)});
  const int before = set.size();
  const auto extend = [&](auto& values) { values.extend(before + come, 0); };
  set.each_scalar(extend);
  extend(set.id);
  std::uint32_t next = *std::max_element(set.id.begin(), set.id.begin() + before);
  for (int p = before; p < before + come; ++p) {
    set.id[p] = ++next;
    set.x[0][p] = next - 100.0;
    set.x[1][p] = 100.0 - next;
    set.v[0].set(p, 0.5);
    set.v[1].set(p, 0.0);
    set.f[0].set(p, next - 99.0);
  }
  order.add({static_cast<std::uint32_t>(before), static_cast<std::uint32_t>(come)});
  PermuteScratch scratch;
  permute(set, order.places().data(), order, 0, scratch, 1);
}

// Over several ranks: of those awake some go and others come, more and fewer than are asleep. Then blocks wake, and
// those that were theirs do.
TEST(SleepingBlocks, FollowsParticlesThatComeAndGo) {
  for (const auto& [stay, come] : std::vector<std::pair<int, int>>{{9, 1}, {10, 3}, {6, 0}, {2, 90}, {1, 0}, {0, 0}}) {
    SCOPED_TRACE(std::to_string(stay) + " stay, " + std::to_string(come) + " come");
    std::vector<ParticleSet> sets{numbered_particles(40)};
    ParticleSet& set = sets[0];
    set.begin = {0, 7, 20, 33, 40};
    SleepingBlocks asleep(sets, kLayout, false);
    std::vector<SleepingBlocks::Sleeper> three;
    for (const int owner : {0, 1, 3}) three.push_back(sleeper(owner));
    asleep.put_to_sleep(three);
    replace_awake(set, stay, come);
    asleep.follow_moves();
    expect_own_numbers(set, 27);
    replace_awake(set, set.awake(), 2);
    asleep.follow_moves();
    expect_own_numbers(set, 27);
    int left = 27;
    for (const auto& [key, first, end] : {std::array<int, 3>{11, 7, 20}, {10, 0, 7}, {13, 33, 40}}) {
      const int before = set.awake();
      asleep.wake({0, static_cast<std::uint64_t>(key)});
      ASSERT_EQ(set.awake() - before, end - first);
      for (int p = before; p < set.awake(); ++p) {
        const int own = static_cast<int>(set.id[p]) - 100;
        EXPECT_TRUE(own >= first && own < end) << own << " of block " << key;
        set.v[0].set(p, 0.5);
      }
      expect_own_numbers(set, left -= end - first);
    }
  }
}

// Material asleep stays as it is to the bit, and is reported as ever: the energy that is kept for it is m g z of the
// particles that were read.
TEST(Sleep, WhatIsAsleepDoesNotChange) {
  Simulation run = start(kBed, {kSleep, "rigid_bodies=[]"});
  advance_to(run, 0.2);
  ASSERT_EQ(number(run, "asleep"), static_cast<double>(run.particles()));
  const std::vector<double> x = field(run, "x"), z = field(run, "z"), p = field(run, "p");
  advance_to(run, 0.6);
  EXPECT_EQ(field(run, "x"), x);
  EXPECT_EQ(field(run, "z"), z);
  EXPECT_EQ(field(run, "p"), p);
  EXPECT_EQ(run.state().energy.of("kinetic"), 0.0);
  const double mass = 1600 * 1.6 * 0.2 * 0.1;  // density times the bed's volume [kg]
  EXPECT_NEAR(run.state().energy.of("potential"), mass * kG * mean(z), 1e-9 * mass * kG);
  EXPECT_LT(run.state().audit.residual, 1e-10);
}

// A wave wakes a bar that sleeps: struck at 1 m/s, its far half moves when the wave has come, L / c later, and carries
// the momentum that it carries without sleep.
TEST(Sleep, AWaveWakesABar) {
  const char* const kBar = R"yaml(
geometry: line
grid: {cell: 0.05, min: 0, max: 12}
time: {end: 0.3, sync: 2 ms, cfl: 0.5}
materials: [{name: rubber, law: linear_elastic, density: 1000, young: 1 MPa, poisson: 0}]
bodies: [{name: bar, material: rubber, shape: {box: {min: 1, max: 9}}}]
rigid_bodies: [{name: hammer, shape: {box: {size: 0.5}}, pose: {position: 0.7}, motion: {velocity: "0.5*(1 - sign(0.07-t))"}}]
)yaml";
  Simulation with = start(kBar, {"sleep={speed: 5 mm/s, after: 0.02}"}), without = start(kBar);
  advance_to(with, 0.06);
  EXPECT_GT(number(with, "asleep"), 0.9 * static_cast<double>(with.particles()));
  advance_to(with, 0.28);
  advance_to(without, 0.28);
  const std::vector<double> v = field(with, "vx"), v_awake = field(without, "vx"), x = field(without, "x");
  double carried = 0.0, carried_awake = 0.0;
  for (std::size_t p = 0; p < x.size(); ++p) {
    carried += v[p];
    carried_awake += v_awake[p];
    if (x[p] > 8.0) {
      EXPECT_LT(std::abs(v[p]), 1e-2) << "the wave is not there yet: 31.6 m/s for 0.2 s";
    }
  }
  EXPECT_NEAR(carried, carried_awake, 0.01 * carried_awake);
  EXPECT_LT(with.state().audit.residual, 1e-10);
}

TEST(Sleep, SameBitsForAnyNumberOfThreads) {
  Simulation one = start(kBed, {kSleep}, 1), three = start(kBed, {kSleep}, 3);
  advance_to(one, 0.16);
  advance_to(three, 0.16);
  EXPECT_GT(number(one, "asleep"), 0.0);
  EXPECT_EQ(one.memory_hash(), three.memory_hash());
}

// Local damping brings a swinging block of sand to rest, and books what it takes.
TEST(Sleep, DampingEasesTheWayToRest) {
  const char* const kBlock = R"yaml(
geometry: plane_strain
grid: {cell: 0.05, min: [0, 0], max: [1, 0.8]}
time: {end: 1, sync: 5 ms, cfl: 0.5}
gravity: [0, -9.81]
materials: [{name: sand, law: drucker_prager, density: 1600, young: 1 MPa, poisson: 0.3, friction_angle: 34 deg}]
bodies: [{name: block, material: sand, shape: {box: {min: [0, 0], max: [1, 0.4]}}, initial: {velocity: [0, "-0.5*z"]}}]
boundaries: {z_min: slip, x_min: slip, x_max: slip}
)yaml";
  Simulation damped = start(kBlock, {"sleep={speed: 20 mm/s, after: 0.1, damping: 0.3}"});
  Simulation not_damped = start(kBlock, {"sleep={speed: 20 mm/s, after: 0.1}"});
  double fell_asleep[2] = {1e9, 1e9};
  Simulation* runs[2] = {&damped, &not_damped};
  for (int i = 0; i < 2; ++i) {
    while (runs[i]->time() < 1000000000) {
      runs[i]->advance();
      if (number(*runs[i], "asleep") < static_cast<double>(runs[i]->particles())) continue;
      fell_asleep[i] = 1e-9 * static_cast<double>(runs[i]->time());
      break;
    }
    EXPECT_LT(runs[i]->state().audit.residual, 1e-10);
  }
  EXPECT_LT(fell_asleep[0], 0.9);
  EXPECT_LT(fell_asleep[0], fell_asleep[1]);
  EXPECT_GT(damped.state().energy.of("damping of slow material"), 0.0);
}

}  // namespace sleep_test
}  // namespace mpm::test
