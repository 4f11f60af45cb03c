// Robots on material whose steps a device takes: joints, bases and wrenches are those of a run on the processor.
// Cost: 2 s.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"
#include "mpm_gpu/device.hpp"
#include "robot_case.hpp"

namespace robot_device_test {

using namespace mpm;
using namespace robot_test;

Simulation run_of(const std::string& robot, bool on_device) {
  provide_robots();
  SimulationOptions options;
  options.threads = 2;
  if (on_device) options.device = mpm_gpu::device_by(mpm_gpu::Executor(mpm_gpu::Visits::forwards, 2));
  const Scene scene = parse_scene(R"(
name: clay
gravity: [0, 0, -9.81]
grid: {cell: 0.04, min: [-0.16, -0.16, -0.12], max: [0.16, 0.16, 0.4]}
time: {end: 0.1, cfl: 0.5, sync: 0.0005}
method: {update: usavg}
materials: [{name: clay, law: j2_plasticity, density: 1800, young: 2 MPa, poisson: 0.4, yield_stress: 10 kPa}]
bodies: [{name: bed, material: clay, shape: {box: {min: [-0.16, -0.16, -0.12], max: [0.16, 0.16, 0]}}}]
boundaries: {all: slip, z_max: none}
robots:
)" + robot,
                                  "robot.yaml");
  return Simulation(build(scene), options);
}

/// Runs both and compares them.
void expect_alike(const std::string& robot) {
  constexpr int kPeriods = 60;
  constexpr double kRoundOff = 1e-9;  // points come in the same order, since no particle leaves its cell
  Simulation here = run_of(robot, false), there = run_of(robot, true);
  double force = 0.0;
  for (int k = 0; k < kPeriods; ++k) {
    here.advance();
    there.advance();
    const ContactReport a = here.take_contact(0), b = there.take_contact(0);
    force = std::max(force, a.mean.force.norm());
    ASSERT_LT((a.mean.force - b.mean.force).norm(), kRoundOff * (force + 1.0)) << k;
    ASSERT_LT((a.mean.torque - b.mean.torque).norm(), kRoundOff * (force + 1.0)) << k;
  }
  EXPECT_GT(force, 0.1);
  const RobotReport a = here.robots()[0], b = there.robots()[0];
  EXPECT_LT((a.base.position - b.base.position).norm(), kRoundOff);
  for (std::size_t j = 0; j < a.joints.size(); ++j) {
    EXPECT_NEAR(a.joints[j].position, b.joints[j].position, kRoundOff);
    EXPECT_NEAR(a.joints[j].velocity, b.joints[j].velocity, 1e3 * kRoundOff);
    EXPECT_NEAR(a.joints[j].impulse, b.joints[j].impulse, kRoundOff * (1.0 + std::abs(a.joints[j].impulse)));
  }
}

TEST(RobotDevice, GantryPressesClay) {
  expect_alike(fmt::format(R"(  - name: gantry
    urdf: {}
    base: {{pose: {{position: [0, 0, 0.04]}}}}
    links: {{plate: {{friction: 0.3, sides: one}}}}
    joints:
      along: {{drive: velocity, target: 0.1}}
      down: {{drive: velocity, target: 0.5, effort: 60}}
      turn: {{drive: position}}
)",
                           data_file("gantry.urdf")));
}

TEST(RobotDevice, LegFallsOnClay) {
  expect_alike(fmt::format(R"(  - name: leg
    urdf: {}
    base: {{kind: free, pose: {{position: [0, 0, 0.24]}}}}
    links: {{foot: {{friction: 0.5, sides: one}}}}
    joints:
      hip_joint: {{drive: position, stiffness: 20, damping: 0.1}}
      knee: {{drive: position, stiffness: 20, damping: 0.1}}
)",
                           data_file("leg.urdf")));
}

}  // namespace robot_device_test
