// Use of tools in the ground: depth, width and use, of motions and shapes whose figures are known by hand. 0.3 s.
#include "mpm/pace/tool_use.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "mpm/scene/scene.hpp"

namespace mpm {
namespace tool_use_test {

using pace::ToolAtWork;
using pace::ToolsInGround;
using pace::ToolUse;

/// The tools that are found, of one above a bed 0.4 m high, which it does not feel.
std::vector<ToolAtWork> found(const std::string& shape, const std::string& place, const std::string& motion,
                              const std::string& more = {}, int until = 200'000'000) {
  const Scene scene = parse_scene(
      "geometry: plane_strain\ngravity: [0, -9.81]\ngrid: {cell: 0.05, min: [0, 0], max: [1.6, 0.8]}\n"
      "time: {end: 0.2, sync: 0.02}\n"
      "materials: [{name: sand, law: drucker_prager, density: 1600, young: 1 MPa, poisson: 0.3, friction_angle: 30 "
      "deg}]\n"
      "bodies: [{name: bed, material: sand, shape: {box: {min: [0, 0], max: [1.6, 0.4]}}, initial: geostatic, cut_out: "
      "[tool]}" +
          more + "]\nrigid_bodies: [{name: tool, shape: {" + shape + "}, pose: {position: " + place + "}, motion: {" +
          motion + "}}]\nboundaries: {all: slip}\n",
      "use.yaml", {});
  Simulation simulation(build(scene), SimulationOptions{1});
  ToolsInGround tools(simulation);
  while (simulation.time() < until) {
    simulation.advance();
    tools.look(simulation);
  }
  tools.look_ahead(simulation, 0.2);
  return tools.found();
}

const char* const kPlate = "box: {size: [0.2, 0.1]}";

TEST(ToolUse, APlateIsPressedIn) {
  const auto tools = found(kPlate, "[0.8, 0.46]", "velocity: [0, -0.2]");  // from 10 mm above to 30 mm below
  ASSERT_EQ(tools.size(), 1U);
  EXPECT_EQ(tools[0].use, ToolUse::plate);
  EXPECT_NEAR(tools[0].depth, 0.03, 1e-3);
  EXPECT_NEAR(tools[0].width, 0.2, 1e-12);
  EXPECT_EQ(tools[0].length(ToolUse::plate), tools[0].width);
  EXPECT_EQ(tools[0].length(ToolUse::blade), tools[0].depth);
  EXPECT_EQ(tools[0].length({}), tools[0].depth) << "the smaller";
}

// In a bed that is higher where the tool comes to than where it begins.
TEST(ToolUse, ABladeDigsAsDeepAsTheGroundStandsBeforeIt) {
  const std::string step = ", {name: step, material: sand, shape: {box: {min: [0.9, 0.4], max: [1.6, 0.5]}}}";
  const auto tools = found(kPlate, "[0.65, 0.42]", "velocity: [1.2, 0]", step);  // bottom at 0.37, front to 0.99
  ASSERT_EQ(tools.size(), 1U);
  EXPECT_EQ(tools[0].use, ToolUse::blade);
  EXPECT_NEAR(tools[0].depth, 0.13, 2e-3);
}

TEST(ToolUse, AWheelRolls) {
  const std::string wheel = "cylinder: {radius: 0.1}";
  const auto rolling = found(wheel, "[0.6, 0.48]", "velocity: [0.4, 0], rotation_rate: 5");
  ASSERT_EQ(rolling.size(), 1U);
  EXPECT_EQ(rolling[0].use, ToolUse::wheel);
  EXPECT_NEAR(rolling[0].depth, 0.02, 1e-3);
  const auto fast = found(wheel, "[0.6, 0.48]", "velocity: [0.4, 0], rotation_rate: 300");  // six radians a look
  EXPECT_EQ(fast[0].use, ToolUse::wheel);
  EXPECT_EQ(found(wheel, "[0.6, 0.48]", "velocity: [0.4, 0]")[0].use, ToolUse::blade) << "it is dragged";
  EXPECT_FALSE(found(wheel, "[0.6, 0.48]", "velocity: [0, 0]")[0].use) << "it stands";
}

TEST(ToolUse, AMotionThatIsKnownIsFollowedBeyondTheRehearsal) {
  for (const int until : {0, 100'000'000}) {
    const auto tools = found(kPlate, "[0.8, 0.46]", "velocity: [0, -4 * t]", {}, until);  // 80 mm down
    ASSERT_EQ(tools.size(), 1U);
    EXPECT_NEAR(tools[0].depth, 0.07, 1e-3);
    EXPECT_EQ(tools[0].use, ToolUse::plate);
  }
}

TEST(ToolUse, WhatStaysAboveTheGroundIsNotFound) {
  EXPECT_TRUE(found(kPlate, "[0.8, 0.6]", "velocity: [0.5, 0]").empty());
}

}  // namespace tool_use_test
}  // namespace mpm
