// The rehearsal of a run on a coarse grid: what it finds against the run itself, how its figures make a forecast of the
// first steps one of the whole run, and the grids that it takes. Cost: 4 s
#include "mpm/pace/rehearsal.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "mpm/advice/coarser_scene.hpp"
#include "mpm/math/build_info.hpp"
#include "mpm/math/nanoseconds.hpp"
#include "mpm/pace/forecast.hpp"

namespace rehearsal_test {

using namespace mpm;
using namespace mpm::pace;

constexpr double kEver = 1e9;  ///< [s]

/// A blade ploughs through a bed that sleeps, and a lump falls on it; 25 rows of cells across, 2.4 m along.
Scene ploughed(const std::string& velocity = {}, const std::string& place = {}) {
  std::vector<std::string> set;
  if (!velocity.empty()) set.push_back("rigid_bodies.blade.motion.velocity=" + velocity);
  if (!place.empty()) set.push_back("rigid_bodies.blade.pose.position=" + place);
  return load_scene(source_folder() + "/test/verification/scenes/ranks_sleep.yaml", set);
}

/// The part of the particles that are awake, and the part of the steps with the tool in contact, over all of a run.
Rehearsal outcome(const Scene& scene) {
  Simulation run(build(scene), SimulationOptions{1});
  Rehearsal sums;
  sums.awake = 0.0;
  int periods = 0;
  for (; seconds_of(run.time()) < scene.definition.time.end; ++periods) {
    run.advance();
    sums.awake += part_awake(run);
    sums.touched += touches(run) ? 1.0 : 0.0;
  }
  sums.awake /= periods;
  sums.touched /= periods;
  return sums;
}

// Twice as wide cells: more stays awake round what moves, since blocks are twice as large; a tool touches as long.
TEST(Rehearsal, FindsWhatIsAwakeAndWhatTouches) {
  const Scene scene = ploughed();
  const auto coarse = coarser_scene(scene, 2.0);
  ASSERT_TRUE(coarse);
  EXPECT_DOUBLE_EQ(coarse->times, 2.0);
  const auto found = rehearse(build(coarse->scene), coarse->times, 1, {}, kEver);
  ASSERT_TRUE(found);
  const Rehearsal is = outcome(scene);
  EXPECT_EQ(found->reached, 1.0);
  EXPECT_GE(found->awake, is.awake);
  EXPECT_LE(found->awake, 1.3 * is.awake);
  EXPECT_NEAR(found->touched, is.touched, 0.05);
  EXPECT_EQ(found->steps, 1.0);  // value for a scene with a step of its own
}

// A blade that comes down to the bed in the middle of the run.
TEST(Rehearsal, FindsWhenAToolTouches) {
  const Scene scene = ploughed("[0, -0.5]", "[0.5, 0.305]");  // 0.065 m above the bed
  const auto coarse = coarser_scene(scene, 2.0);
  ASSERT_TRUE(coarse);
  const auto found = rehearse(build(coarse->scene), coarse->times, 1, {}, kEver);
  ASSERT_TRUE(found);
  const Rehearsal is = outcome(scene);
  EXPECT_GT(is.touched, 0.3);
  EXPECT_LT(is.touched, 0.7);
  EXPECT_NEAR(found->touched, is.touched, 0.1);
}

TEST(Rehearsal, WhatItDoesNotReachGoesOnAsBefore) {
  const auto coarse = coarser_scene(ploughed(), 2.0);
  ASSERT_TRUE(coarse);
  double now = 0.0;
  const auto clock = [&now] { return now += 1e-3; };
  const auto part = rehearse(build(coarse->scene), 2.0, 1, {}, 0.4, {}, clock);
  ASSERT_TRUE(part);
  EXPECT_GT(part->reached, 0.05);
  EXPECT_LT(part->reached, 0.9);
  EXPECT_FALSE(rehearse(build(coarse->scene), 2.0, 1, {}, 0.0));
  EXPECT_THROW(rehearse(build(coarse->scene), 2.0, 1, {}, kEver, [] { return true; }), StoppedError);
}

// Made-up figures: a step of 2 ms with a fifth awake and no tool in contact.
TEST(Rehearsal, MakesAForecastOneOfTheWholeRun) {
  const StepCost start{2e-3, 1000.0, 70, 0.2, false};
  Rehearsal found;
  found.coarser = 2.0;
  found.awake = 0.6;
  found.touched = 0.5;
  found.contact = 1.4;
  found.steps = 1.1;
  found.particle_step = 1e-6;
  StepCost whole = of_whole_run(start, found, 40'000);
  EXPECT_DOUBLE_EQ(whole.steps_per_second, 1100.0);
  EXPECT_DOUBLE_EQ(whole.step_seconds, 2e-3 * 3.0 * 1.1);  // half of the steps cost a fifth more on cells half as wide
  EXPECT_EQ(whole.awake, 0.6);
  EXPECT_TRUE(whole.touched);
  StepCost in_contact = start;
  in_contact.touched = true;
  EXPECT_DOUBLE_EQ(of_whole_run(in_contact, found, 40'000).step_seconds, 2e-3 * 3.0);
  // Nothing moved in the steps that were timed: what a particle costs is known from the rehearsal alone.
  StepCost all_sleep = start;
  all_sleep.awake = 0.0;
  EXPECT_DOUBLE_EQ(of_whole_run(all_sleep, found, 40'000).step_seconds, 1e-6 * 0.6 * 40'000);
  Forecast forecast;
  forecast.sleeps = forecast.tools = true;
  forecast.simulated = 1.5;
  forecast.cost = start;
  EXPECT_TRUE(forecast.changes());
  forecast.cost = whole;
  EXPECT_FALSE(forecast.changes());
  EXPECT_EQ(forecast_text(forecast),
            "0.14 of real time expected on 1 thread; 1.5 s will take 10.9 s of wall time (1650 steps of 6.6 ms); as a "
            "rehearsal in cells 2 times as wide foresees it, with 60 % of the material awake");
}

// Blocks twice as wide hold four times as much in a plane, where little moves; as much, where nearly all does.
TEST(Rehearsal, TwoGridsSayWhatIsAwakeOnTheOwnOne) {
  Rehearsal coarse, fine;
  coarse.coarser = 4.0;
  fine.coarser = 2.0;
  coarse.awake = 0.56;
  fine.awake = 0.14;
  EXPECT_DOUBLE_EQ(awake_by(coarse, fine, 2), 0.035);
  EXPECT_DOUBLE_EQ(awake_by(coarse, fine, 1), 0.07);
  coarse.awake = fine.awake = 0.9;
  EXPECT_DOUBLE_EQ(awake_by(coarse, fine, 2), 0.9);
  coarse.awake = 0.8;
  EXPECT_DOUBLE_EQ(awake_by(coarse, fine, 2), 0.9);
}

TEST(Rehearsal, CellsFollowFromTheBudget) {
  EXPECT_DOUBLE_EQ(cell_factor(16.0, 1.0, 3), 2.0);
  EXPECT_DOUBLE_EQ(cell_factor(1.0, 8.0, 2), 0.5);
}

// The grid keeps its size and is filled by whole cells, three at least along an axis.
TEST(Rehearsal, ACoarserSceneFillsItsGrid) {
  const Scene scene = ploughed();  // 120 x 28 cells
  const auto cells = [](const Scene& of, int axis) {
    const GridDefinition& grid = of.definition.grid;
    return (grid.max[axis] - grid.min[axis]) / grid.cell[axis];
  };
  for (const auto& [times, along, up] : {std::tuple(2.0, 60, 14), {3.0, 40, 9}, {1000.0, 3, 3}}) {
    const auto coarse = coarser_scene(scene, times);
    ASSERT_TRUE(coarse);
    EXPECT_NEAR(cells(coarse->scene, 0), along, 1e-9) << times;
    EXPECT_NEAR(cells(coarse->scene, 2), up, 1e-9) << times;
    EXPECT_EQ(coarse->scene.definition.grid.max, scene.definition.grid.max);
    EXPECT_NEAR(coarse->times, std::sqrt(120.0 / along * 28.0 / up), 1e-9);
  }
  EXPECT_FALSE(coarser_scene(scene, 1.001));
}

// Steps foreseen from some of a copy against those that the run takes: elastic bodies whose wave speed hardly
// changes, free, vibrating, and pressed by a tool in axisymmetry. Within a fifth; 1 s of computing.
TEST(Forecast, StepsAreThoseThatTheRunTakes) {
  const std::vector<std::pair<std::string, std::vector<std::string>>> scenes = {
      {"falling_block", {}}, {"elastic_block", {"time.end=0.2"}}, {"foam_probe", {"time.end=0.5"}}};
  for (const auto& [name, set] : scenes) {
    const Scene scene = load_scene(name, set);
    const auto forecast = time_copy(build(scene), 1, {}, 0.01, {});
    ASSERT_TRUE(forecast);
    Simulation run(build(scene), SimulationOptions{1});
    while (static_cast<double>(run.time()) * 1e-9 < scene.definition.time.end) run.advance();
    const auto steps = static_cast<double>(run.state().step.steps);
    EXPECT_NEAR(forecast->steps(), steps, 0.2 * steps) << name;
  }
}

}  // namespace rehearsal_test
