// The section `sleep` of a scene: its defaults, and what it refuses.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "mpm/scene/scene.hpp"

namespace mpm::test {
namespace scene_sleep_test {

const char* const kScene = R"yaml(geometry: plane_strain
grid: {cell: 0.1, min: [0, 0], max: [1.6, 1.6]}
time: {end: 1, sync: 5 ms}
gravity: [0, -9.81]
materials: [{name: soil, density: 1600, law: drucker_prager, young: 1 MPa, poisson: 0.3, friction_angle: 30 deg}]
bodies: [{name: bed, material: soil, shape: {box: {min: [0, 0], max: [1.6, 0.4]}}}]
boundaries: {x_min: slip, x_max: slip, z_min: slip}
)yaml";

std::string fault_of(const std::vector<std::string>& changes) {
  try {
    parse_scene(kScene, "sleep.yaml", changes);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

void expect_fault(const std::vector<std::string>& changes, const std::string& part) {
  const std::string fault = fault_of(changes);
  EXPECT_NE(fault.find(part), std::string::npos) << "said: '" << fault << "'";
}

TEST(SceneSleep, DefaultsFollowFromGravityAndCell) {
  EXPECT_FALSE(parse_scene(kScene, "sleep.yaml").definition.sleep.has_value());
  EXPECT_FALSE(parse_scene(kScene, "sleep.yaml", {"sleep=off"}).definition.sleep.has_value());
  const Scene scene = parse_scene(kScene, "sleep.yaml", {"sleep={}"});
  const SleepDefinition& sleep = scene.definition.sleep.value();
  EXPECT_NEAR(sleep.speed, 0.01 * std::sqrt(9.81 * 0.1), 1e-15);
  EXPECT_NEAR(sleep.wake, 3 * sleep.speed, 1e-15);
  EXPECT_NEAR(sleep.after, std::sqrt(0.1 / 9.81), 1e-15);
  EXPECT_EQ(sleep.balance, 0.1);
  EXPECT_EQ(sleep.damping, 0.0);
  EXPECT_FALSE(sleep.from_start);
}

TEST(SceneSleep, RefusesWhatCannotBe) {
  expect_fault({"sleep={speed: 0}"}, "sleep.speed");
  expect_fault({"sleep={speed: -1}"}, "sleep.speed");
  expect_fault({"sleep={speed: 10 mm/s, wake: 5 mm/s}"}, "sleep.wake: it is below sleep.speed");
  expect_fault({"sleep={damping: 1}"}, "below 1");
  expect_fault({"sleep={after: 0}"}, "sleep.after");
  expect_fault({"sleep={balance: 0}"}, "sleep.balance");
  expect_fault({"sleep={spede: 1}"}, "speed");
  expect_fault({"sleep={}", "gravity=[0, 0]"}, "write sleep.speed");
  expect_fault({"sleep={speed: 2 m/s}"}, "is no rest");
  expect_fault({"sleep={from_start: true}"}, "body 'bed' starts without stress");
  EXPECT_EQ(fault_of({"sleep={from_start: true}", "bodies.bed.initial=geostatic"}), "");
  EXPECT_EQ(fault_of({"sleep={}", "method={average_dilatation: true}"}), "");
  EXPECT_EQ(fault_of({"sleep={}", "loads=[{body_force: {acceleration: [1, 0]}}]"}), "");
}

// A tenth of the speed of what the scene moves on purpose is the most that may count as rest.
TEST(SceneSleep, RefusesASpeedThatWouldFreezeWhatMoves) {
  const std::string blade =
      "rigid_bodies=[{name: blade, shape: {box: {size: [0.2, 0.2]}}, pose: {position: [0.8, 1]}, motion: {velocity: "
      "[\"0.05*min(1, t)\", 0]}}]";
  const std::string grip =
      "boundaries.conditions=[{name: grip, region: {box: {min: [0.3, 0.55], max: [0.8, 0.85]}}, direction: x, "
      "velocity: \"0.05*min(1, t)\"}]";
  expect_fault({grip, "sleep={speed: 6 mm/s}"}, "condition 'grip' moves at 0.05 m/s");
  EXPECT_EQ(fault_of({grip, "sleep={speed: 5 mm/s}"}), "");
  expect_fault({blade, "sleep={speed: 6 mm/s}"}, "rigid body 'blade' moves at 0.05 m/s");
  EXPECT_EQ(fault_of({blade, "sleep={speed: 4 mm/s}"}), "");
  expect_fault({"bodies.bed.initial.velocity=[0.1, 0]", "sleep={speed: 20 mm/s}"}, "body 'bed' moves at 0.1 m/s");
  EXPECT_EQ(fault_of({"bodies.bed.initial.velocity=[0.1, 0]", "sleep={speed: 5 mm/s}"}), "");
  expect_fault({"bodies.bed.initial.velocity=[\"0.1*z\", 0]", "sleep={speed: 20 mm/s}"},
               "body 'bed' moves at 0.04 m/s");
  expect_fault({"rigid_bodies=[{name: wheel, shape: {box: {size: [0.3, 0.4]}}, pose: {position: [0.8, 1]}, motion: "
                "{rotation_rate: 0.2}}]",
                "sleep={speed: 6 mm/s}"},
               "rigid body 'wheel' moves at 0.05 m/s");
}

}  // namespace scene_sleep_test
}  // namespace mpm::test
