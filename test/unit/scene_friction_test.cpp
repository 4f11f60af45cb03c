// Friction as a function that turns negative in a run, with each kind of contact that has functions: 0.2 - 10 t is
// negative at mid-step from t = 20 ms on, and would drive the sliding from there.
#include <gtest/gtest.h>

#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"

namespace mpm {
namespace scene_friction_test {

constexpr const char* kFalling = "\"0.2 - 10*t\"";

/// Two bodies, one above the other, and a plate below both.
std::string scene(const std::string& of_bodies, const std::string& of_plate, const std::string& normals) {
  return "geometry: plane_strain\n"
         "grid: {cell: 0.1, min: [0, 0], max: [2, 2]}\n"
         "materials: [{name: soft, density: 1000, law: neo_hookean, young: 1 MPa, poisson: 0.3}]\n"
         "bodies:\n"
         "  - {name: upper, material: soft, shape: {box: {min: [0.5, 1.0], max: [1.5, 1.5]}}}\n"
         "  - {name: lower, material: soft, shape: {box: {min: [0.5, 0.5], max: [1.5, 1.0]}}}\n"
         "rigid_bodies: [{name: plate, shape: {box: {size: [1.2, 0.2]}}, pose: {position: [1, 0.4]}, normals: " +
         normals +
         "}]\n"
         "contact: {pairs: [{between: [upper, lower], friction: " +
         of_bodies + "}, {between: [lower, plate], friction: " + of_plate +
         "}]}\n"
         "time: {end: 40 ms, sync: 1 ms}\n";
}

void expect_refused_at_20_ms(const std::string& scene, const std::string& named) {
  Simulation simulation(build(parse_scene(scene, "friction.yaml")), {1});
  std::string found;
  try {
    while (simulation.time() < 40'000'000) simulation.advance();
  } catch (const PhysicsError& error) {
    found = error.what();
  }
  // The sync period from 20 ms on is the first in which the middle of a step is beyond 20 ms.
  EXPECT_EQ(simulation.time(), 20'000'000);
  EXPECT_EQ(found,
            "motion of a rigid body, or a law of contact, at t = 0.02 s: contact of " + named +
                ": friction or adhesion is negative, or friction at rest less than that of sliding; change the law");
}

TEST(SceneFriction, ThatTurnsNegativeIsRefusedAtPoints) {
  expect_refused_at_20_ms(scene("0.1", kFalling, "surface"), "'plate' with 'lower'");
}
TEST(SceneFriction, ThatTurnsNegativeIsRefusedBetweenDeformableBodies) {
  expect_refused_at_20_ms(scene(kFalling, "0.1", "surface"), "'upper/lower'");
}
TEST(SceneFriction, ThatTurnsNegativeIsRefusedAgainstParticles) {
  expect_refused_at_20_ms(scene("0.1", kFalling, "particles"), "'plate'");
}

}  // namespace scene_friction_test
}  // namespace mpm
