// `free` of a rigid body in a scene: how it is read, and refusals.
#include <gtest/gtest.h>

#include "mpm/scene/scene.hpp"

namespace scene_free_test {

mpm::Scene scene_with(const std::string& body, const std::string& geometry = "plane_strain") {
  const bool solid = geometry == "solid";
  const std::string three = solid ? "0, " : "";
  return mpm::parse_scene("name: s\ngeometry: " + geometry + "\n" +
                              (geometry == "plane_strain" ? "thickness: 0.1\n" : "") + "grid: {cell: 0.1, min: [0, " +
                              three + "0], max: [1, " + (solid ? "1, " : "") +
                              "1]}\ntime: {end: 1}\n"
                              "materials: [{name: m, law: neo_hookean, density: 1000, young: 1 MPa, poisson: 0.3}]\n"
                              "bodies: [{name: b, material: m, shape: {box: {min: [0, " +
                              three + "0], max: [1, " + (solid ? "1, " : "") + "0.5]}}}]\n" +
                              "rigid_bodies: [{name: tool, " + body + "}]\n",
                          "free.yaml");
}

std::string refusal(const std::string& body, const std::string& geometry = "plane_strain") {
  try {
    scene_with(body, geometry);
  } catch (const mpm::SceneError& error) {
    return error.what();
  }
  return "";
}

mpm::FreeDefinition free_of(const std::string& body, const std::string& geometry = "plane_strain") {
  return *scene_with(body, geometry).definition.rigid_bodies.front().free;
}

TEST(SceneFree, TakesMassAndInertiaFromTheShape) {
  const mpm::FreeDefinition free = free_of("shape: {box: {size: [0.2, 0.1]}}, free: {density: 500}");
  EXPECT_NEAR(free.mass, 500.0 * 0.2 * 0.1 * 0.1, 1e-15);  // 0.1 m thick
  EXPECT_NEAR(free.inertia(1, 1), free.mass * (0.04 + 0.01) / 12.0, 1e-15);
  const std::array<bool, 6> plane = {true, false, true, false, true, false};
  EXPECT_EQ(free.axes, plane);
  const mpm::FreeDefinition ball = free_of("shape: {sphere: {radius: 0.1}}, free: {mass: 2 kg}", "solid");
  EXPECT_NEAR(ball.inertia(2, 2), 0.4 * 2.0 * 0.01, 1e-15);
}

TEST(SceneFree, TakesWhatIsWritten) {
  const mpm::FreeDefinition free = free_of(
      "shape: {sphere: {radius: 0.1}}, motion: {rotation_rate: 3}, free: {mass: 5, inertia: 0.2, axes: [x, z], "
      "velocity: [1, 2], force: [-10 N, 0]}");
  const std::array<bool, 6> axes = {true, false, true, false, false, false};
  EXPECT_EQ(free.axes, axes);
  EXPECT_EQ(free.mass, 5.0);
  EXPECT_EQ(free.inertia(1, 1), 0.2);
  EXPECT_EQ(free.velocity.linear.z(), 2.0);
  EXPECT_EQ(free.wrench.force.x(), -10.0);
}

TEST(SceneFree, RefusesWhatCannotBe) {
  const std::string ball = "shape: {sphere: {radius: 0.1}}, ";
  const auto says = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << "'" << text << "' does not say '" << part << "'";
  };
  says(refusal(ball + "free: {axes: [x]}"), "write exactly one of mass and density");
  says(refusal(ball + "free: {mass: 1, density: 2}"), "write exactly one of mass and density");
  says(refusal(ball + "free: {mass: -1}"), "free.mass");
  says(refusal(ball + "free: {mass: 1, axes: [y]}"), "a planar scene has no such motion");
  says(refusal(ball + "free: {mass: 1, axes: []}"), "no axis is free");
  says(refusal(ball + "free: {mass: 1, speed: 2}"), "free");
  says(refusal(ball + "motion: {velocity: [1, 0]}, free: {mass: 1}"), "prescribed by `motion` too");
  says(refusal(ball + "free: {mass: 1, axes: [x], velocity: [1, 1]}"), "a direction that is not free");
  says(refusal(ball + "free: {mass: 1, axes: [x, z], centre: [0.01, 0]}"), "off the body's origin");
  says(refusal("shape: {plane: {}}, free: {density: 1}"), "volume of this shape is not known");
  says(refusal("shape: {plane: {}}, free: {mass: 1}"), "inertia of this shape is not known");
  says(refusal(ball + "free: {mass: 1, centre: [0.01, 0]}"), "inertia about this centre is not known");
  says(refusal(ball + "mass: 3"), "write free: {mass: ...}");
  says(refusal("shape: {polygon: {points: [[0, 0], [1, 0]]}}"), "at least 3");
  says(refusal("shape: {polygon: {points: [[0, 0], [1, 0], [0, 1]]}}", "solid"), "planar");
  says(refusal("shape: {ring: {inner: 0.1, outer: 0.2, height: 0.1}}, free: {mass: 1}", "axisymmetric"), "ring");
}

}  // namespace scene_free_test
