// Tools of revolution in scenes: their shapes in solid and in axisymmetric scenes, and refusals.
#include <gtest/gtest.h>

#include "scene_tool.hpp"

namespace mpm {
namespace scene_tools_test {

const std::string kRevolved = "revolved: {profile: [[0, 0], [20 cm, 0], [0, 0.1]]}";
const std::string kCone = "cone: {radius: 0.1, angle: 60 deg, shaft: 0.5}";
const std::string kRing = "ring: {inner: 0.1, outer: 0.3, height: 0.2}";

TEST(SceneTools, ShapesOfRevolutionInSolidAndAxisymmetricScenes) {
  for (const std::string geometry : {"solid", "axisymmetric"}) {
    EXPECT_EQ(tool(geometry, kRevolved).surface->bounds().max, Vec3(0.2, 0.2, 0.1));
    // tan 30 degrees = 1 / sqrt 3.
    const Box cone = tool(geometry, kCone).surface->bounds();
    EXPECT_NEAR(cone.max.z(), 0.1 * std::sqrt(3.0) + 0.5, 1e-15);
    EXPECT_EQ(cone.min.z(), 0.0);
    EXPECT_EQ(tool(geometry, "cone: {radius: 0.1, height: 0.4}").surface->bounds().max, Vec3(0.1, 0.1, 0.4));
    EXPECT_EQ(tool(geometry, kRing).surface->bounds().max, Vec3(0.3, 0.3, 0.1));
    EXPECT_EQ(tool(geometry, "sphere: {radius: 0.1}").surface->bounds().max, Vec3::Constant(0.1));
    EXPECT_EQ(tool(geometry, "cylinder: {radius: 0.1, height: 1}").surface->bounds().max, Vec3(0.1, 0.1, 0.5));
  }
}

TEST(SceneTools, ARingOpensInAnAxisymmetricSceneAlone) {
  const std::string rest = "pose: {position: [0.05, 0.2]}, motion: {velocity: [\"-t\", 1]}";
  const RigidBodyDefinition ring = tool("axisymmetric", kRing, rest);
  EXPECT_EQ(ring.inner_radius, 0.1);
  EXPECT_EQ(ring.pose.position, Vec3(0.05, 0.0, 0.2));
  EXPECT_EQ(ring.velocity[0](2.0), -2.0);
  EXPECT_EQ(tool("solid", kRing).inner_radius, 0.0);
  EXPECT_EQ(tool("axisymmetric", "cylinder: {radius: 0.1, height: 1}").inner_radius, 0.0);
}

TEST(SceneTools, SidesOfAThinTool) {
  EXPECT_EQ(tool("solid", kRing).sides, Sides::automatic);
  EXPECT_EQ(tool("solid", kRing, "sides: auto").sides, Sides::automatic);
  EXPECT_EQ(tool("solid", kRing, "sides: one").sides, Sides::one);
  EXPECT_EQ(tool("line", "box: {size: 0.1}", "sides: two").sides, Sides::two);
  expect_refused(scene("solid", kRing, "sides: 2"), "sides", "two");
  EXPECT_EQ(tool("solid", kRing, "divides: [block]").divides, std::vector<std::string>{"block"});
  expect_refused(scene("solid", kRing, "divides: block"), "divides", "write a list");
  expect_refused(scene("solid", kRing, "divides: [blok]"), "divides.0", "no deformable body is called 'blok'");
  expect_refused(scene("solid", kRing, "sides: one, divides: [block]"), "divides", "divides nothing");
}

TEST(SceneTools, AToolThatIsNotAxisymmetricIsRefused) {
  const std::string sphere = "sphere: {radius: 0.1}";
  const auto refused = [](const std::string& shape, const std::string& rest, const std::string& where,
                          const std::string& what) { expect_refused(scene("axisymmetric", shape, rest), where, what); };
  refused("box: {size: [1, 1]}", "", "shape.box", "a box is not a body of revolution; write cylinder or ring");
  refused("mesh: {file: a.stl}", "", "shape.mesh", "a mesh is not a body of revolution; write its section as revolved");
  refused("cylinder: {radius: 0.1, height: 1, axis: x}", "", "shape.cylinder.axis", "write z, or leave it out");
  refused(sphere, "pose: {position: [0.1, 0]}", "pose.position", "off the axis the tool is not axisymmetric");
  refused(sphere, "pose: {rpy: [0, 10 deg, 0]}", "pose.rpy", "a turned tool is not axisymmetric; leave it out");
  refused(sphere, "pose: {quaternion: [0, 0, 1, 0]}", "pose.quaternion", "a turned tool is not axisymmetric");
  refused(sphere, "motion: {velocity: [0.1, 0]}", "motion.velocity", "off the axis the tool is not axisymmetric");
  refused(sphere, "motion: {rotation_rate: [0, 0, 1]}", "motion.rotation_rate",
          "a tool that turns is not axisymmetric");
  refused(kRing, "pose: {position: [-0.1, 0]}", "pose.position", "the ring is closed there");
  refused(kRing, "pose: {rpy: [0, 10 deg, 0]}", "pose.rpy", "a turned tool is not axisymmetric");
}

TEST(SceneTools, NothingIsRevolvedInAPlaneOrALine) {
  const std::vector<std::pair<std::string, std::string>> shapes = {
      {"revolved", kRevolved}, {"cone", kCone}, {"ring", kRing}};
  for (const auto& [kind, shape] : shapes) {
    for (const std::string plane : {"plane_strain", "plane_stress"})
      expect_refused(scene(plane, shape), "shape." + kind, "a planar scene has no " + kind);
    expect_refused(scene("line", shape), "shape." + kind, "a line has no " + kind + "; write box or sphere");
  }
}

TEST(SceneTools, NumbersThatMakeNoBodyAreRefused) {
  const auto refused = [](const std::string& shape, const std::string& where, const std::string& what) {
    expect_refused(scene("solid", shape), where, what);
  };
  refused("revolved: {profile: [[0, 0], [1, 0]]}", "shape.revolved", "the profile has 2 points; it needs at least 3");
  refused("revolved: {profile: [[0, 0], [1, 0], [-1, 1]]}", "shape.revolved", "point 3 of 3");
  refused("revolved: {profile: [[0, 0], [1, 0, 0], [0, 1]]}", "shape.revolved.profile.1", "found 3 numbers");
  refused("cone: {radius: 0.1}", "shape.cone", "a cone has height or angle");
  refused("cone: {radius: 0.1, height: 1, angle: 60 deg}", "shape.cone", "write one of them");
  refused("cone: {radius: 0.1, angle: 180 deg}", "shape.cone.angle", "less than 180 deg");
  refused("cone: {radius: 0.1, height: 1, shaft: -1}", "shape.cone.shaft", "");
  refused("ring: {inner: 0.3, outer: 0.1, height: 1}", "shape.ring.outer", "not greater than the inner one");
  refused("ring: {inner: 0, outer: 0.1, height: 1}", "shape.ring.inner", "");
}

}  // namespace scene_tools_test
}  // namespace mpm
