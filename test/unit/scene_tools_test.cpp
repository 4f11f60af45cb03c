// Tools of revolution in scenes: their shapes in solid and in axisymmetric scenes, and refusals.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "mpm/definition/tool_size.hpp"
#include "mpm/simulation/simulation.hpp"
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

// The grid of scene() is 1 m long, and the block fills it.
TEST(SceneTools, ATooLargeToolIsDoubtedForItsUnit) {
  const auto doubt = [](const std::string& geometry, const std::string& shape) {
    const Scene read = parse_scene(scene(geometry, shape), "good.yaml");
    return size_doubt(read.definition.rigid_bodies.at(0), read.definition);
  };
  EXPECT_EQ(doubt("solid", "box: {size: [100, 20, 20]}"),
            "rigid body 'tool' is 100 m long in a grid of 1 m: check its unit (scale)");
  EXPECT_NE(doubt("solid", "sphere: {radius: 1.6}"), "") << "three times along each axis";
  EXPECT_EQ(doubt("axisymmetric", "sphere: {radius: 1.1}"), "") << "a ball of which the grid holds the tip";
  EXPECT_NE(doubt("plane_strain", "sphere: {radius: 6}"), "");
  EXPECT_EQ(doubt("solid", "box: {size: [9, 9, 0.1]}"), "") << "a floor";
  EXPECT_EQ(doubt("solid", "plane: {}"), "") << "without end";
  EXPECT_EQ(doubt("solid", "height_field: {x: [-50, 50], y: [-50, 50], heights: 0}"), "");
  EXPECT_EQ(doubt("plane_strain", "box: {size: [0.5, 0.5]}"), "");
  const Scene large = parse_scene(scene("solid", "box: {size: [100, 20, 20]}"), "good.yaml");
  try {
    build(large);
    FAIL() << "the block lies in the tool";
  } catch (const SceneError& error) {
    EXPECT_NE(std::string(error.what()).find("100 m long in a grid of 1 m: check its unit (scale); as it is, body"),
              std::string::npos);
    EXPECT_EQ(std::string(error.what()).find("cut_out"), std::string::npos) << error.what();
  }
  const Scene away =
      parse_scene(scene("solid", "box: {size: [100, 20, 20]}", "pose: {position: [0, 0, 20]}"), "a.yaml");
  const std::vector<std::string> warnings = Simulation(build(away), {1}).warnings();
  EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [](const std::string& warning) {
    return warning.find("is 100 m long in a grid of 1 m: check its unit (scale)") != std::string::npos;
  }));
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

/// A plate 0.5 m x 0.5 m as an OBJ file, of which 20 strips become linearly thinner, from `thick` to `thin` [m].
std::string plate_file(double thick, double thin) {
  constexpr int kStrips = 20;
  const std::filesystem::path path = std::filesystem::temp_directory_path() / "mpm_scene_plate.obj";
  std::ofstream file(path);
  for (int i = 0; i <= kStrips; ++i) {
    const double x = 0.5 * i / kStrips, half = 0.5 * (thick + (thin - thick) * i / kStrips);
    for (const double y : {0.0, 0.5}) {
      for (const double z : {-half, half}) file << "v " << x << " " << y << " " << z << "\n";
    }
  }
  // Corners of a station: 1 low near, 2 high near, 3 low far, 4 high far; near is y = 0.
  const auto quad = [&file](int a, int b, int c, int d) {
    file << "f " << a << " " << b << " " << c << "\nf " << a << " " << c << " " << d << "\n";
  };
  quad(1, 2, 4, 3);
  for (int i = 0; i < kStrips; ++i) {
    const int a = 4 * i, b = a + 4;
    quad(a + 1, a + 3, b + 3, b + 1);
    quad(a + 2, b + 2, b + 4, a + 4);
    quad(a + 1, b + 1, b + 2, a + 2);
    quad(a + 3, a + 4, b + 4, b + 3);
  }
  const int last = 4 * kStrips;
  quad(last + 1, last + 3, last + 4, last + 2);
  return path.string();
}

// A hundredth of a cell is 1 mm.
TEST(SceneTools, AMeshThinnerThanAHundredthOfACellIsRefused) {
  const auto mesh = [](double thick, double thin, const std::string& more = "") {
    return scene("solid", "mesh: {file: " + plate_file(thick, thin) + more + "}");
  };
  expect_refused(
      mesh(0.0009, 0.0009), "shape.mesh.file",
      "half of the mesh is less than 0.0009 m thick, and it has to be at least 0.001 m; its size is 0.5 x 0.5 "
      "x 0.0009 m: check its unit (scale), make it thicker, or the grid's cells smaller");
  expect_refused(mesh(0.1, 0.1, ", scale: 1 mm"), "shape.mesh.file", "its size is 0.0005 x 0.0005 x 0.0001 m");
  const auto thickness = [](const std::string& text) {
    return parse_scene(text, "good.yaml").definition.rigid_bodies.at(0).surface->thickness();
  };
  EXPECT_NEAR(thickness(mesh(0.0011, 0.0011)), 0.0011, 1e-9);  // assimp reads single precision
  // A knife: a twentieth of it is thinner than that, and half of it is not.
  EXPECT_LT(thickness(mesh(0.003, 0.0)), 0.001);
  expect_refused(mesh(0.0018, 0.0), "shape.mesh.file", "half of the mesh is less than 0.0009");
  std::filesystem::remove(plate_file(1.0, 1.0));
}

}  // namespace scene_tools_test
}  // namespace mpm
