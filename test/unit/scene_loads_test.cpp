// loads: how they are read, and each refusal with its place.
#include <gtest/gtest.h>

#include <algorithm>

#include "mpm/scene/scene.hpp"

namespace mpm {
namespace scene_loads_test {

const char* const kPlanar =
    "geometry: plane_strain\n"
    "grid: {cell: 0.1, min: [0, 0], max: [1, 1]}\n"
    "materials: [{name: soft, density: 1000, law: neo_hookean, young: 1000, poisson: 0.3}]\n"
    "bodies: [{name: block, material: soft, shape: {box: {min: [0.2, 0.2], max: [0.6, 0.6]}}}]\n";

std::string refusal(const std::string& lines) {
  try {
    build(parse_scene(kPlanar + lines, "bad.yaml"));
  } catch (const SceneError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
  return "no error";
}

void expect_refused(const std::string& line, const std::string& expected) {
  const std::string found = refusal(line + "\n");
  EXPECT_EQ(found.substr(0, expected.size()), expected) << "whole text: " << found;
}

TEST(SceneLoads, AreReadWithTheirUnits) {
  const auto d = parse_scene(std::string("units: mm-g-s\n") + kPlanar +
                                 "loads:\n"
                                 "  - {body_force: {acceleration: [\"2*t\", \"X+x\"], body: block}}\n"
                                 "  - {body_force: {acceleration: [1 m/s^2, 5], body: all}}\n"
                                 "  - {body_force: {acceleration: [0, 0]}}\n",
                             "test.yaml")
                     .definition;
  ASSERT_EQ(d.body_forces.size(), 3u);
  EXPECT_EQ(d.body_forces[0].body, "block");
  EXPECT_EQ(d.body_forces[1].body, "");
  EXPECT_EQ(d.body_forces[2].body, "");
  // 2 t mm/s^2 at 3 s; X + x = (7 + 4) mm/s^2 at X = 7 mm, x = 4 mm.
  EXPECT_NEAR(d.body_forces[0].acceleration[0](3.0), 6e-3, 1e-17);
  EXPECT_NEAR(d.body_forces[0].acceleration[2](0.0, Vec3(4e-3, 0, 0), Vec3(7e-3, 0, 0)), 11e-3, 1e-17);
  EXPECT_TRUE(d.body_forces[0].acceleration[2].uses_start());
  EXPECT_FALSE(d.body_forces[0].acceleration[0].uses_start());
  EXPECT_EQ(d.body_forces[1].acceleration[0](0.0), 1.0);
  EXPECT_EQ(d.body_forces[1].acceleration[2](0.0), 5e-3);
}

TEST(SceneLoads, AreRefusedWhenWrong) {
  expect_refused("loads: {}", "bad.yaml:5: loads: found a map of keys; write a list");
  expect_refused("loads: [{body_forc: {}}]",
                 "bad.yaml:5: loads.0.body_forc: unknown key 'body_forc'; did you mean 'body_force'?");
  expect_refused("loads: [{body_force: {}}]",
                 "bad.yaml:5: loads.0.body_force: the key 'acceleration' is missing; add it");
  const std::string at = "bad.yaml:5: loads.0.body_force.";
  expect_refused("loads: [{body_force: {force: [0, 1]}}]", at + "force: 'force' is no key here; write acceleration");
  expect_refused("loads: [{body_force: {acceleration: [0, 0, 1]}}]",
                 at + "acceleration: found 3 components; write two components, [x, z]");
  expect_refused("loads: [{body_force: {acceleration: [0, 3 N]}}]",
                 at + "acceleration.1: '3 N' is a force, but an acceleration is expected");
  expect_refused("loads: [{body_force: {acceleration: [0, \"sin(T)\"]}}]",
                 at + "acceleration.1: expression 'sin(T)': unknown name 'T'; write 't'");
  expect_refused("loads: [{body_force: {acceleration: [0, \"2*(t\"]}}]",
                 at + "acceleration.1: expression '2*(t' does not parse");
  expect_refused("loads: [{body_force: {acceleration: [0, 1], body: blok}}]",
                 at + "body: no deformable body 'blok'; did you mean 'block'?");
}

// A force of 6 N on all particles of a region together, or on each of them; the particles are those with centres in the
// region.
TEST(SceneLoads, ForcesOnParticles) {
  const std::string loads =
      "loads:\n"
      "  - {particle_force: {force: [6, \"X\"], body: block, region: {box: {min: [0.5, 0], max: [1, 1]}}}}\n"
      "  - {particle_force: {each: [0, 2 kN], body: block, spread: center}}\n"
      "  - {body_force: {acceleration: [0, 1], spread: center}}\n"
      "  - {body_force: {acceleration: [0, 1], spread: domain}}\n";
  const SimulationDefinition d = build(parse_scene(kPlanar + loads, "test.yaml"));
  ASSERT_EQ(d.particle_forces.size(), 2u);
  const ParticleForceDefinition &total = d.particle_forces[0], &each = d.particle_forces[1];
  EXPECT_EQ(total.body, "block");
  EXPECT_TRUE(total.shared);
  EXPECT_EQ(total.spread, LoadSpread::domain);
  EXPECT_EQ(total.force[0](0.0), 6.0);
  EXPECT_TRUE(total.force[2].uses_start());
  EXPECT_EQ(total.particles.size(), 2u * 8u);  // two columns of the 8 by 8 in 0.4 m
  for (std::size_t p = 0; p < d.bodies[0].positions.size(); ++p) {
    const bool listed = std::count(total.particles.begin(), total.particles.end(), p) > 0;
    EXPECT_EQ(listed, d.bodies[0].positions[p].x() > 0.5) << p;
  }
  EXPECT_FALSE(each.shared);
  EXPECT_TRUE(each.particles.empty());
  EXPECT_EQ(each.spread, LoadSpread::center);
  EXPECT_EQ(each.force[2](0.0), 2000.0);
  EXPECT_EQ(d.body_forces[0].spread, LoadSpread::center);
  EXPECT_EQ(d.body_forces[1].spread, LoadSpread::domain);
}

TEST(SceneLoads, ForcesOnParticlesAreRefusedWhenWrong) {
  const std::string at = "bad.yaml:5: loads.0.particle_force";
  const std::string both =
      at + ": write force, which all chosen particles carry together, or each, which every one of them carries";
  expect_refused("loads: [{particle_force: {body: block}}]", both);
  expect_refused("loads: [{particle_force: {force: [0, 1], each: [0, 1], body: block}}]", both);
  expect_refused("loads: [{particle_force: {force: [0, 1]}}]", at + ": the key 'body' is missing; add it");
  expect_refused("loads: [{particle_force: {force: [0, 1 m], body: block}}]",
                 at + ".force.1: '1 m' is a length, but a force is expected");
  expect_refused("loads: [{particle_force: {force: [0, 1], body: blok}}]",
                 at + ".body: no deformable body 'blok'; did you mean 'block'?");
  expect_refused("loads: [{particle_force: {force: [0, 1], body: block, spread: node}}]",
                 at + ".spread: 'node' is not known; write one of domain, center");
  expect_refused(
      "loads: [{particle_force: {force: [0, 1], body: block, region: {sphere: {center: [0.9, 0.9], radius: 0.1}}}}]",
      at + ".region: no particle of body 'block' has its centre in it; make it larger, or move it");
}

// Without a region the simulation chooses the particles; with one, they are those with centres in it.
TEST(SceneLoads, TractionsOnFaces) {
  const std::string loads =
      "loads:\n"
      "  - {traction: {body: block, edge: x_max, traction: [2 kPa, \"3*X\"]}}\n"
      "  - {pressure: {body: block, edge: z_min, value: \"t\", shear: 7, region: {box: {min: [0, 0], max: [0.3, "
      "0.25]}}}}\n";
  const SimulationDefinition d = build(parse_scene(kPlanar + loads, "test.yaml"));
  ASSERT_EQ(d.tractions.size(), 2u);
  const TractionDefinition &fixed = d.tractions[0], &following = d.tractions[1];
  EXPECT_EQ(fixed.body, "block");
  EXPECT_EQ(fixed.face, 1);
  EXPECT_FALSE(fixed.follows);
  EXPECT_TRUE(fixed.particles.empty());
  EXPECT_EQ(fixed.value[0](0.0), 2000.0);
  EXPECT_EQ(fixed.value[2](0.0, Vec3::Zero(), Vec3(2.0, 0, 0)), 6.0);
  EXPECT_EQ(following.face, 4);
  EXPECT_TRUE(following.follows);
  EXPECT_EQ(following.particles.size(), 2u);  // the lowest of two columns of the 8 by 8 in 0.4 m
  EXPECT_EQ(following.value[0](5.0), 5.0);
  EXPECT_EQ(following.value[1](0.0), 7.0);
}

TEST(SceneLoads, TractionsAreRefusedWhenWrong) {
  const std::string at = "bad.yaml:5: loads.0.traction", of = "bad.yaml:5: loads.0.pressure";
  expect_refused("loads: [{traction: {edge: x_max, traction: [0, 1]}}]", at + ": the key 'body' is missing; add it");
  expect_refused("loads: [{traction: {body: block, traction: [0, 1]}}]", at + ": the key 'edge' is missing; add it");
  expect_refused("loads: [{traction: {body: block, edge: x_max}}]", at + ": the key 'traction' is missing; add it");
  expect_refused("loads: [{traction: {body: block, edge: x_mx, traction: [0, 1]}}]",
                 at + ".edge: 'x_mx' is not known; did you mean 'x_max'?");
  expect_refused("loads: [{traction: {body: block, edge: right, traction: [0, 1]}}]",
                 at + ".edge: 'right' is not known; write one of x_min, x_max, z_min, z_max");
  expect_refused("loads: [{traction: {body: block, edge: x_max, traction: [0, 1 N]}}]",
                 at + ".traction.1: '1 N' is a force, but a pressure is expected");
  expect_refused("loads: [{traction: {body: block, edge: x_max, value: 1}}]", at + ".value: unknown key 'value'");
  expect_refused(
      "loads: [{traction: {body: block, edge: x_max, traction: [0, 1], region: {box: {min: [0.7, 0.7], max: "
      "[0.9, 0.9]}}}}]",
      at + ".region: no particle of body 'block' has its centre in it; make it larger, or move it");
  expect_refused(
      "loads: [{traction: {body: block, edge: x_max, traction: [0, 1], region: {box: {min: [0.5, 0.2], max: "
      "[0.6, 0.3]}}}}]",
      at + ".region: the edge x_max of the particle at (0.525, 0, 0.225) m is inside body 'block': another particle "
           "lies beyond it; let the region hold no more than the outermost particles, or leave it out");
  expect_refused("loads: [{pressure: {body: block, edge: x_max}}]", of + ": the key 'value' is missing; add it");
  expect_refused("loads: [{pressure: {body: blok, edge: x_max, value: 1}}]",
                 of + ".body: no deformable body 'blok'; did you mean 'block'?");
  expect_refused("loads: [{pressure: {body: block, edge: x_max, value: 1, shear: [1, 2]}}]", of + ".shear: ");
}

}  // namespace scene_loads_test
}  // namespace mpm
