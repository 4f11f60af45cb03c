// boundaries and grid.leave: how they are read, and each refusal with its place.
#include <gtest/gtest.h>

#include <cmath>

#include "mpm/scene/scene.hpp"

namespace mpm {
namespace scene_boundaries_test {

const char* const kPlanar =
    "geometry: plane_strain\n"
    "materials: [{name: soft, density: 1000, law: neo_hookean, young: 1000, poisson: 0.3}]\n"
    "bodies: [{name: block, material: soft, shape: {box: {min: [0.2, 0.2], max: [0.6, 0.6]}}}]\n";
const char* const kGrid = "grid: {cell: 0.1, min: [0, 0], max: [1.6, 1]}\n";  // 16 by 10 cells

SimulationDefinition read(const std::string& lines, const std::string& grid = kGrid) {
  return parse_scene(kPlanar + grid + lines, "bad.yaml").definition;
}

void expect_refused(const std::string& line, const std::string& expected, const std::string& grid = kGrid) {
  std::string found = "no error";
  try {
    read(line + "\n", grid);
  } catch (const SceneError& error) {
    found = error.what();
  }
  EXPECT_EQ(found.find('\n'), std::string::npos) << found;
  EXPECT_EQ(found.substr(0, expected.size()), expected) << "whole text: " << found;
}

TEST(SceneBoundaries, FacesAndAxes) {
  const SimulationDefinition d = read("boundaries: {x: periodic, z_min: {absorbing: {hold: start}}, all: symmetry}\n");
  EXPECT_EQ(d.walls[0].kind, WallKind::periodic);
  EXPECT_EQ(d.walls[1].kind, WallKind::periodic);
  EXPECT_EQ(d.walls[2].kind, WallKind::none);
  EXPECT_EQ(d.walls[4].kind, WallKind::absorbing);
  EXPECT_TRUE(d.walls[4].hold);
  EXPECT_EQ(d.walls[5].kind, WallKind::symmetry);
  EXPECT_FALSE(read("boundaries: {z_min: absorbing}\n").walls[4].hold);
  EXPECT_EQ(d.grid.leave_limit, 0u);
  EXPECT_EQ(read("", "grid: {cell: 0.1, min: [0, 0], max: [1, 1], leave: {limit: 20}}\n").grid.leave_limit, 20u);
}

TEST(SceneBoundaries, Conditions) {
  const SimulationDefinition d = read(
      "units: mm-g-s\n"
      "boundaries:\n"
      "  conditions:\n"
      "    - {region: {box: {min: [0.2, 0.2], max: [0.3, 0.6]}}, direction: [3, 4], velocity: 2*t + x}\n"
      "    - {name: grip, shape: {box: {size: [0.2, 1]}}, pose: {position: [0.5, 0.4], rpy: [0, 90 deg, 0]}, motion: "
      "{velocity: [0, t]}, direction: z}\n");
  ASSERT_EQ(d.conditions.size(), 2u);
  const ConditionDefinition &first = d.conditions[0], &grip = d.conditions[1];
  EXPECT_EQ(first.region.name, "0");
  EXPECT_EQ(first.where, "bad.yaml:8: boundaries.conditions.0");
  EXPECT_NEAR((first.direction - Vec3(0.6, 0.0, 0.8)).norm(), 0.0, 1e-15);
  EXPECT_NEAR((*first.velocity)(1.0, Vec3(2e-3, 0, 0)), 4e-3, 1e-15);  // 2 mm/s + 2 mm/s
  // Nodes on the faces of the region belong to it, nodes beside it do not.
  const auto inside = [](const ConditionDefinition& c, double x, double z) {
    return c.region.surface->at(c.region.pose.to_body({x, 0.0, z})).distance <= 0.0;
  };
  EXPECT_TRUE(inside(first, 0.2e-3, 0.6e-3));
  EXPECT_FALSE(inside(first, 0.2e-3, 0.7e-3));
  EXPECT_EQ(grip.region.name, "grip");
  EXPECT_FALSE(grip.velocity);
  EXPECT_EQ(grip.direction, Vec3::UnitZ());
  EXPECT_EQ(grip.region.velocity[2](2.0), 2e-3);
  EXPECT_TRUE(inside(grip, 0.9e-3, 0.4e-3));  // turned by 90 degrees
  EXPECT_FALSE(inside(grip, 0.5e-3, 0.8e-3));
}

TEST(SceneBoundaries, AreRefusedWhenWrong) {
  const std::string at = "bad.yaml:5: boundaries";
  expect_refused("boundaries: {z: periodic}",
                 at +
                     ".z: the grid has 10 cells along z; a periodic axis needs a multiple of 8: 8 cells, max z = 0.8 m "
                     "or cell 0.125 m, or 16 cells, max z = 1.6 m or cell 0.0625 m");
  expect_refused("boundaries: {x: slip}", at + ".x: 'slip' is not known; write one of periodic");
  expect_refused("boundaries: {y: periodic}", at + ".y: a planar scene has no face along y; leave it out");
  expect_refused("boundaries: {x: periodic, x_min: slip}", at + ".x_min: x is periodic; leave one of the two out");
  expect_refused("boundaries: {x_min: periodic}",
                 at + ".x_min: 'periodic' is no word here; an axis is periodic, not a face");
  expect_refused("boundaries: {x_min: {absorbing: {hold: always}}}",
                 at + ".x_min.absorbing.hold: 'always' is not known; write one of none, start");
  expect_refused("boundaries: {z_max: symetry}", at + ".z_max: 'symetry' is not known; did you mean 'symmetry'?");
  const auto condition = [](const std::string& keys) { return "boundaries: {conditions: [{" + keys + "}]}"; };
  const std::string one = at + ".conditions.0", box = "region: {box: {min: [0, 0], max: [1, 1]}}";
  expect_refused(condition("direction: x, velocity: 1"), one + ": write region, which is one of a body's shapes, or ");
  expect_refused(condition(box + ", direction: y, velocity: 1"), one + ".direction: 'y' is not known; ");
  expect_refused(condition(box + ", direction: [0, 0], velocity: 1"), one + ".direction: a direction has a length; ");
  expect_refused(condition(box + ", direction: x"), one + ": write velocity, or motion, whose velocity ");
  expect_refused(condition(box + ", velocity: 1"), one + ": the key 'direction' is missing; add it");
  expect_refused(condition(box + ", direction: x, velocity: 1 m"), one + ".velocity: '1 m' is a length, but ");
  expect_refused(condition(box + ", direction: x, velocity: 1, pose: {}"), one + ".pose: a region stands where ");
  expect_refused("boundaries: {conditions: [{name: a, " + box + ", direction: x, velocity: 1}, {name: a, " + box +
                     ", direction: z, velocity: 1}]}",
                 at + ".conditions.a: a second condition 'a'; give each its own name");
  expect_refused("", "bad.yaml:4: grid.leave.limit: a number of particles; write 0 or more",
                 "grid: {cell: 0.1, min: [0, 0], max: [1, 1], leave: {limit: -1}}\n");
  expect_refused("", "bad.yaml:4: grid.leave: the key 'limit' is missing; add it",
                 "grid: {cell: 0.1, min: [0, 0], max: [1, 1], leave: {}}\n");
}

}  // namespace scene_boundaries_test
}  // namespace mpm
