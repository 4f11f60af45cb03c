// Problems of the suite of tool forces at places within a cell: what moves with the grid, and the row of several
// places.
#include <gtest/gtest.h>

#include <cmath>

#include "mpm/scene/scene.hpp"
#include "study/suite.hpp"
#include "study/tool_force/places.hpp"

namespace mpm::study::tool_force {
namespace problem_places_test {

// 4 cells of 50 mm: the grid moves by 12.5 mm along x and 37.5 mm along z, bed and tool stay where they are, and the
// bed ends where the grid does.
TEST(ProblemPlaces, TheGridMovesAndTheProblemStays) {
  const Problem& problem = find_problem("blade_flat");
  const std::string text = problem.scene(problem, {4.0, {}});
  const Scene before = parse_scene(text, "t"), after = parse_scene(moved(problem, text, {0.25, 0.75}), "t");
  const GridDefinition &old = before.definition.grid, &grid = after.definition.grid;
  EXPECT_NEAR(grid.min.x(), old.min.x() - 0.0125, 1e-12);
  EXPECT_NEAR(grid.max.x(), old.max.x() + 0.0375, 1e-12);
  EXPECT_NEAR(grid.min.z(), old.min.z() - 0.0375, 1e-12);
  EXPECT_NEAR(grid.max.z(), old.max.z() + 0.0125, 1e-12);
  const Box bed = after.bodies[0].region.box;
  EXPECT_EQ(bed.max.z(), 0.0);
  EXPECT_EQ(bed.min.x(), 0.0) << "the front, which is no face of the domain";
  EXPECT_NEAR(bed.max.x(), grid.max.x(), 1e-12);
  EXPECT_NEAR(bed.min.z(), grid.min.z(), 1e-12);
  EXPECT_EQ(after.definition.rigid_bodies[0].pose.position, before.definition.rigid_bodies[0].pose.position);
  EXPECT_EQ(moved(problem, text, {0.0, 0.0}), text);
}

// Nothing moves across a plane of symmetry.
TEST(ProblemPlaces, AreFiveAlongTheAxesThatAProblemHas) {
  EXPECT_EQ(five_places(find_problem("blade_flat")).size(), 5U);
  for (const Place& place : five_places(find_problem("strip_nq"))) EXPECT_EQ(place[0], 0.0);
  for (const Place& place : five_places(find_problem("pile"))) EXPECT_EQ(place[1], 0.0);
  EXPECT_EQ(five_places(find_problem("silo")).size(), 1U);
  for (const Problem& problem : problems()) {
    for (const Place& place : five_places(problem)) {
      EXPECT_NO_THROW(parse_scene(moved(problem, problem.scene(problem, {4.0, {}}), place), problem.name));
    }
  }
  const Problem& strip = find_problem("strip_nq");
  EXPECT_THROW(moved(strip, strip.scene(strip, {4.0, {}}), {0.5, 0.0}), StudyError);
  EXPECT_THROW(moved(strip, strip.scene(strip, {4.0, {}}), {0.0, 1.0}), StudyError);
}

TEST(ProblemPlaces, TheirRowIsTheMeanWithTheSpread) {
  ForceRow one, two;
  one.status = two.status = "ok";
  one.over_exact = 0.9;
  two.over_exact = 1.2;
  one.imbalance = -0.02;
  two.imbalance = 0.01;
  one.cpu_seconds = 1.0;
  two.cpu_seconds = 3.0;
  one.real_time_factor = 2.0;
  two.real_time_factor = 2.0 / 3.0;
  const ForceRow both = mean_of({one, two});
  EXPECT_NEAR(both.over_exact, 1.05, 1e-15);
  EXPECT_NEAR(both.spread, 0.15, 1e-15);
  EXPECT_EQ(both.imbalance, -0.02);
  EXPECT_EQ(both.cpu_seconds, 4.0);
  EXPECT_NEAR(both.real_time_factor, 1.0, 1e-15) << "4 s in 4 s";
  EXPECT_EQ(both.places, 2);
  two.status = "failed";
  EXPECT_EQ(mean_of({one, two}).status, "failed");
}

}  // namespace problem_places_test
}  // namespace mpm::study::tool_force
