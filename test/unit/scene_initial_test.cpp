// bodies.<name>.initial and cut_out: how they are read, and each refusal with its place.
#include <gtest/gtest.h>

#include <cmath>

#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"

namespace mpm {
namespace scene_initial_test {

// The body is on line 5.
std::string scene(const std::string& rest, const std::string& gravity = "[0, -9.81]") {
  return "geometry: plane_strain\n"
         "grid: {cell: 0.1, min: [0, 0], max: [1, 1]}\n"
         "gravity: " +
         gravity +
         "\n"
         "materials: [{name: sand, density: 1600, law: drucker_prager, young: 1e6, poisson: 0.3, friction_angle: 34 "
         "deg},"
         " {name: air, density: 1.2, law: ideal_gas, pressure: 1e5, temperature: 300}]\n"
         "bodies: [{name: bed, material: sand, shape: {box: {min: [0, 0], max: [1, 0.5]}}, " +
         rest + "}]\n";
}

std::string refusal(const std::string& text) {
  try {
    Simulation run(build(parse_scene(text, "bad.yaml")), {1});
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
  return "no error";
}

void expect_refused(const std::string& text, const std::string& expected) {
  const std::string found = refusal(text);
  EXPECT_EQ(found.substr(0, expected.size()), expected) << "whole text: " << found;
}

TEST(SceneInitial, StressAndTemperatureAreFunctionsOfPlace) {
  const auto d =
      build(parse_scene(scene("initial: {stress: {zz: \"-1e4*(1-z)\", xx: -5 kPa}, velocity: [x, 0]}"), "t"));
  const DeformableBody& body = d.bodies.at(0);
  ASSERT_EQ(body.stresses.size(), body.positions.size());
  EXPECT_TRUE(body.yy_follows);
  for (std::size_t p = 0; p < body.positions.size(); ++p) {
    EXPECT_NEAR(body.stresses[p].zz, -1e4 * (1 - body.positions[p].z()), 1e-11);  // a rounding or two
    EXPECT_EQ(body.stresses[p].xx, -5e3);
    EXPECT_EQ(body.velocities[p].x(), body.positions[p].x());
  }
  const std::string gas = scene("initial: {temperature: \"300 + 100*x\"}");
  const auto warm = build(parse_scene(gas, "t", {"bodies.bed.material=air"}));
  ASSERT_EQ(warm.bodies[0].temperatures.size(), warm.bodies[0].positions.size());
  Simulation run(warm, {1});
  std::vector<double> x, p;
  run.particle_field("x", x);
  run.particle_field("p", p);
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(p[i], 1e5 * (1.0 + x[i] / 3.0), 1e-6);  // p0 T / T0
}

// The elastic energy of a uniform stress: (s:s / 2G - ...) by LinearElastic's definition, here for pure pressure
// p^2/2K.
TEST(SceneInitial, EnergyOfTheStressCounts) {
  const Simulation run(build(parse_scene(scene("initial: {stress: {xx: -1e3, yy: -1e3, zz: -1e3}}"), "t")), {1});
  const double bulk = 1e6 / (3.0 * 0.4), volume = 1.0 * 0.5 * 1.0;
  EXPECT_NEAR(run.state().energy.of("elastic"), volume * 1e6 / (2.0 * bulk), 1e-9);
}

TEST(SceneInitial, CutOutLeavesRoomForTools) {
  const std::string ball =
      "rigid_bodies: [{name: ball, shape: {sphere: {radius: 0.2}}, pose: {position: [0.5, 0.5]}}]\n";
  expect_refused(scene("initial: {velocity: [0, 0]}") + ball,
                 "bad.yaml:5: bodies.bed.shape: body 'bed' overlaps rigid");
  EXPECT_NE(refusal(scene("initial: {velocity: [0, 0]}") + ball).find("or leave them out by cut_out: [ball]"),
            std::string::npos);
  for (const char* which : {"cut_out: [ball]", "cut_out: all"}) {
    const auto d = build(parse_scene(scene(which) + ball, "t"));
    // Half a disk of radius 0.2 m has the area of 25 particles of (0.05 m)^2; the count differs by those that its edge
    // cuts.
    EXPECT_NEAR(static_cast<double>(d.bodies[0].positions.size()), 200.0 - M_PI * 0.04 / 2.0 / 0.0025, 3.0);
    for (const Vec3& p : d.bodies[0].positions) EXPECT_GT(std::hypot(p.x() - 0.5, p.z() - 0.5), 0.2);
  }
  expect_refused(scene("cut_out: [bal]") + ball,
                 "bad.yaml:5: bodies.bed.cut_out: no rigid body 'bal'; did you mean 'ball'?");
  expect_refused(scene("cut_out: ball") + ball, "bad.yaml:5: bodies.bed.cut_out: write all, or a list");
  expect_refused(scene("cut_out: [ball]"), "bad.yaml:5: bodies.bed.cut_out: no rigid body 'ball'; the scene has none");
  expect_refused(
      scene("cut_out: all") + "rigid_bodies: [{name: wall, shape: {box: {size: [4, 4]}}, pose: {position: [0, 0]}}]\n",
      "bad.yaml:5: bodies.bed.cut_out: rigid body 'wall' is 4 m long in a grid of 1 m: check its unit (scale); nothing "
      "is left of body "
      "'bed'");
}

TEST(SceneInitial, IsRefusedWhenWrong) {
  const std::string at = "bad.yaml:5: bodies.bed.initial";
  expect_refused(scene("initial: geostatik"), at + ": 'geostatik' is not known; did you mean 'geostatic'?");
  expect_refused(scene("initial: {stress: [0, 0, 0]}"), at + ".stress: name its components");
  expect_refused(scene("initial: {stress: -1 kPa}"), at + ".stress: name its components");
  expect_refused(scene("initial: {stress: {xy: 3}}"), at + ".stress.xy: unknown key 'xy'");
  expect_refused(scene("initial: {stress: {xx: 3 mm}}"), at + ".stress.xx: '3 mm' is a length, but a pressure");
  expect_refused(scene("initial: {stress: {zz: \"-1e3*h\"}}"),
                 at + ".stress.zz: expression '-1e3*h': unknown name 'h'");
  expect_refused(
      scene("initial: {stress: {zz: \"1/(x-0.025)\"}}"),
      at + ": initial stress of body 'bed': expression '1/(x-0.025)' is not finite at t = 0 s, place (0.025, ");
  expect_refused(scene("initial: {temperature: 300 K}"),
                 at + ".temperature: material 'sand' (drucker_prager) has no temperature; leave it out");
  expect_refused(scene("initial: {pore_pressure: 3}"), at + ".pore_pressure: 'pore_pressure' is no key here;");
  expect_refused(
      scene("initial: {stress: {zz: -1e3}}"),
      "body 'bed', initial state at (0.025, 0, 0.025) m: material 'sand' (drucker_prager) cannot carry the stress");
}

TEST(SceneInitial, GeostaticIsRefusedWhereThereIsNoRest) {
  const std::string at = "bad.yaml:5: bodies.bed.initial";
  expect_refused(scene("initial: geostatic", "[0, 0]"), at + ": needs gravity; write it");
  expect_refused(scene("initial: geostatic", "[1, -9]"), at + ": needs gravity along an axis");
  expect_refused(scene("initial: {geostatic: yes}"), at + ".geostatic: write initial: geostatic, or its keys");
  expect_refused(scene("initial: {geostatic: {k0: -1}}"), at + ".geostatic.k0: '-1' is less than 0");
  expect_refused(scene("initial: {geostatic: {residual: 0}}"), at + ".geostatic.residual: '0' is not greater than 0");
  expect_refused(scene("initial: {geostatic: {k0: 0.5}, velocity: [0, 1]}"),
                 at + ".velocity: a geostatic start is at rest");
  // Far below active earth pressure, (1 - sin 34) / (1 + sin 34) = 0.28.
  expect_refused(
      scene("initial: {geostatic: {k0: 0.1}}"),
      "body 'bed', initial state at (0.025, 0, 0.025) m: material 'sand' (drucker_prager) cannot carry the stress");
  std::string gas = scene("initial: geostatic");
  gas.replace(gas.find("material: sand"), 14, "material: air");
  expect_refused(gas, at + ": material 'air' (ideal_gas) is not held by its weight");
  EXPECT_EQ(refusal(scene("initial: geostatic") + "boundaries: {all: slip}\n"), "no error");
}

}  // namespace scene_initial_test
}  // namespace mpm
