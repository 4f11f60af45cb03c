// Axisymmetric scenes: how values are read, and each refusal, of a scene and of a definition made in code. Expected
// texts are written by hand from the rule "file:line: key.path: what; what to write instead".
#include <gtest/gtest.h>

#include "mpm/rules/method_rules.hpp"
#include "mpm/rules/method_text.hpp"
#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"

namespace mpm {
namespace scene_axisymmetric_test {

struct Parts {
  std::string grid = "{cell: 0.1, min: [0, 0], max: [2, 2]}";
  std::string shape = "{cylinder: {center: [0, 1], radius: 0.5, height: 0.4, axis: z}}";
  std::string more_of_body;
  std::string rest;

  std::string text() const {
    return "geometry: axisymmetric\n"
           "grid: " +
           grid +
           "\n"
           "materials: [{name: soft, density: 1000, law: neo_hookean, young: 1 MPa, poisson: 0.3}]\n"
           "bodies:\n"
           "  - {name: disk, material: soft, shape: " +
           shape + more_of_body + "}\n" + rest;
  }
};
Parts with_rest(const std::string& rest) { return {Parts().grid, Parts().shape, "", rest}; }
Parts with_shape(const std::string& shape, const std::string& more = "") { return {Parts().grid, shape, more, ""}; }
Parts with_grid(const std::string& grid, const std::string& shape) { return {grid, shape, "", ""}; }

std::string error_of(const Parts& parts) {
  try {
    Simulation simulation(build(parse_scene(parts.text(), "bad.yaml")), {1});
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
  return "no error";
}
void expect_refused(const Parts& parts, const std::string& expected) {
  const std::string found = error_of(parts);
  EXPECT_EQ(found.substr(0, expected.size()), expected) << "whole text: " << found;
}

TEST(SceneAxisymmetric, KeysOfTheAxisAndTheirDefaults) {
  const AxisRules usual = parse_scene(Parts().text(), "").definition.method.axis;
  EXPECT_EQ(usual.domains, AxisDomains::fitted);
  EXPECT_EQ(usual.functions, AxisFunctions::weighted);
  EXPECT_EQ(usual.ghosts, AxisGhosts::zero);
  EXPECT_EQ(usual.motion, AxisMotion::point);
  const auto axis_of = [](const std::string& keys) {
    return parse_scene(with_rest("method: {axis: {" + keys + "}}\n").text(), "").definition.method.axis;
  };
  EXPECT_EQ(axis_of("domains: whole").domains, AxisDomains::whole);
  EXPECT_EQ(axis_of("domains: fitted").domains, AxisDomains::fitted);
  EXPECT_EQ(axis_of("functions: planar").functions, AxisFunctions::planar);
  EXPECT_EQ(axis_of("functions: weighted").functions, AxisFunctions::weighted);
  EXPECT_EQ(axis_of("ghosts: free").ghosts, AxisGhosts::free);
  EXPECT_EQ(axis_of("ghosts: zero").ghosts, AxisGhosts::zero);
  EXPECT_EQ(axis_of("ghosts: mirror").ghosts, AxisGhosts::mirror);
  EXPECT_EQ(axis_of("motion: mean").motion, AxisMotion::mean);
  EXPECT_EQ(axis_of("motion: point").motion, AxisMotion::point);
}

TEST(SceneAxisymmetric, KeysOfTheAxisAreRefused) {
  expect_refused(with_rest("method: {axis: {domains: hole}}\n"),
                 "bad.yaml:6: method.axis.domains: 'hole' is not known; did you mean 'whole'?");
  expect_refused(with_rest("method: {axis: {motion: centre}}\n"),
                 "bad.yaml:6: method.axis.motion: 'centre' is not known");
  expect_refused(with_rest("method: {axis: {domain: whole}}\n"), "bad.yaml:6: method.axis.domain: unknown key");
  for (const char* geometry : {"plane_strain", "plane_stress"}) {
    std::string text = with_rest("method: {axis: {motion: mean}}\n").text();
    const std::string ours = "axisymmetric";
    text.replace(text.find(ours), ours.size(), geometry);
    try {
      parse_scene(text, "bad.yaml");
      ADD_FAILURE() << geometry;
    } catch (const SceneError& error) {
      EXPECT_STREQ(error.what(), "bad.yaml:6: method.axis: only an axisymmetric scene has an axis; leave it out");
    }
  }
}

TEST(SceneAxisymmetric, ShapeFunctionsWithoutAnAxis) {
  for (const char* shape : {"bspline2", "bspline3"}) {
    expect_refused(with_rest(std::string("method: {shape: ") + shape + "}\n"),
                   std::string("bad.yaml:6: method.shape: ") + shape +
                       " is not made for an axis of symmetry; use ugimp, ugimp_stretch or cpdi");
  }
  for (const char* shape : {"dirac", "ugimp", "ugimp_stretch", "cpdi", "qcpdi"}) {
    EXPECT_EQ(error_of(with_rest(std::string("method: {shape: ") + shape + "}\n")), "no error");
  }
  MethodDefinition method;
  method.shape = ShapeKind::bspline2;
  EXPECT_EQ(method_fault(method, GeometryKind::axisymmetric)->key, "shape");
}

// A grid begins at the axis, or at least two cells outside it, where the nodes of no domain reach the axis.
TEST(SceneAxisymmetric, TheGridHasNodesOnTheAxis) {
  const std::string outer = "{box: {min: [0.5, 0.5], max: [1, 1]}}";
  EXPECT_EQ(error_of(with_grid("{cell: 0.1, min: [0, 0], max: [2, 2]}", outer)), "no error");
  EXPECT_EQ(error_of(with_grid("{cell: 0.1, min: [0.2, 0], max: [2, 2]}", outer)), "no error");
  expect_refused(with_grid("{cell: 0.1, min: [0.05, 0], max: [2.05, 2]}", outer),
                 "bad.yaml:2: grid: min: the grid begins at r = 0.05 m, 0.5 cells from the axis, and has no nodes on "
                 "it: write r = 0");
  expect_refused(with_grid("{cell: 0.1, min: [0.1, 0], max: [2, 2]}", outer),
                 "bad.yaml:2: grid: min: the grid begins at r = 0.1 m, 1 cells from the axis");
  expect_refused(with_grid("{cell: 0.1, min: [-0.1, 0], max: [2, 2]}", outer),
                 "bad.yaml:2: grid: min: r = -0.1 m is beyond the axis; an axisymmetric grid begins at r = 0");
}

TEST(SceneAxisymmetric, MaterialLiesAtPositiveRadii) {
  expect_refused(with_shape("{box: {min: [-0.2, 0.5], max: [0.5, 1]}}"),
                 "bad.yaml:5: bodies.disk.shape.box.min: material at r = -0.2 m; about an axis r is 0 or more");
  const std::string off = "its centre is 0.3 m off the axis, and it is no body of revolution; write [0, z]";
  expect_refused(with_shape("{sphere: {center: [0.3, 1], radius: 0.2}}"),
                 "bad.yaml:5: bodies.disk.shape.sphere.center: " + off);
  expect_refused(with_shape("{cylinder: {center: [0.3, 1], radius: 0.2, height: 0.2}}"),
                 "bad.yaml:5: bodies.disk.shape.cylinder.center: " + off);
  expect_refused(with_shape("{cylinder: {center: [0, 1], radius: 0.2, height: 0.2, axis: x}}"),
                 "bad.yaml:5: bodies.disk.shape.cylinder.axis: an axisymmetric scene turns about z; write z");
}

// Positions with jitter stay on their side of the axis, where a sphere about it has no other boundary.
TEST(SceneAxisymmetric, JitterKeepsToPositiveRadii) {
  for (const char* shape : {"{cylinder: {center: [0, 1], radius: 0.5, height: 1.8}}",
                            "{sphere: {center: [0, 1], radius: 0.9}}", "{box: {min: [0, 0.1], max: [0.5, 1.9]}}"}) {
    const Parts parts = with_shape(shape, ", jitter: 0.4");
    const SimulationDefinition definition = build(parse_scene(parts.text(), "shaken.yaml"));
    double least = 1.0;
    for (const Vec3& place : definition.bodies[0].positions) least = std::min(least, place.x());
    EXPECT_GE(least, 0.0) << shape;
    EXPECT_LT(least, 0.02) << shape;  // the first row is at 0.025 m, with a jitter of 0.04 m
    EXPECT_EQ(error_of(parts), "no error") << shape;
  }
}

TEST(SceneAxisymmetric, TheAxisIsNoWallAndGravityIsAlongIt) {
  expect_refused(with_rest("boundaries: {x_min: slip}\n"),
                 "bad.yaml:6: boundaries: x_min is the axis, where nothing moves along r of itself; leave it out");
  expect_refused(
      with_rest("gravity: [1, -9.81]\n"),
      "bad.yaml:6: gravity: 1 m/s^2 along r; an axisymmetric scene has gravity along z alone: write [0, -9.81]");
  EXPECT_EQ(error_of(with_rest("gravity: [0, -9.81]\nboundaries: {x_max: slip, z_min: fixed}\n")), "no error");
  // `all` means all faces of the geometry.
  EXPECT_EQ(error_of(with_rest("boundaries: {all: slip}\n")), "no error");
  expect_refused(with_rest("thickness: 1\n"), "bad.yaml:6: thickness: only a planar scene has a thickness");
}

// Definitions made in code are refused for the same reasons.
TEST(SceneAxisymmetric, TheSimulationRefusesTheSame) {
  const auto refusal = [](const std::function<void(SimulationDefinition&)>& spoil) -> std::string {
    SimulationDefinition definition = build(parse_scene(Parts().text(), "good.yaml"));
    spoil(definition);
    try {
      Simulation simulation(std::move(definition), {1});
    } catch (const DefinitionError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(refusal([](SimulationDefinition&) {}), "no error");
  EXPECT_EQ(refusal([](SimulationDefinition& d) { d.bodies[0].positions[3].x() = -0.01; }),
            "bodies: body 'disk' has material at r = -0.01 m; about an axis r is 0 or more");
  EXPECT_NE(refusal([](SimulationDefinition& d) { d.grid.min.x() = 0.05; }).find("has no nodes on it"),
            std::string::npos);
  EXPECT_NE(refusal([](SimulationDefinition& d) { d.grid.min.x() = -0.1; }).find("beyond the axis"), std::string::npos);
  EXPECT_NE(refusal([](SimulationDefinition& d) { d.walls[0].kind = WallKind::fixed; }).find("is the axis"),
            std::string::npos);
  EXPECT_NE(refusal([](SimulationDefinition& d) { d.gravity.x() = 2.0; }).find("2 m/s^2 along r"), std::string::npos);
  EXPECT_NE(
      refusal([](SimulationDefinition& d) { d.method.shape = ShapeKind::bspline3; }).find("method.shape: bspline3"),
      std::string::npos);
}

TEST(SceneAxisymmetric, TheMethodSaysWhatIsUnusual) {
  MethodDefinition method;
  EXPECT_EQ(method_text(method).find("axis"), std::string::npos);
  method.axis = {AxisDomains::whole, AxisFunctions::planar, AxisGhosts::mirror, AxisMotion::mean};
  const std::string text = method_text(method);
  EXPECT_NE(text.find("domains across the axis"), std::string::npos) << text;
  EXPECT_NE(text.find("planar functions, nodes beyond the axis mirror"), std::string::npos) << text;
  EXPECT_NE(text.find("moved by the mean velocity in a domain"), std::string::npos) << text;
}

}  // namespace scene_axisymmetric_test
}  // namespace mpm
