// A robot of test/data/robots, as tests set it up.
#pragma once

#include <string>
#include <vector>

#include "mpm/math/build_info.hpp"
#include "mpm/robot/robot.hpp"
#include "mpm_robots/robots.hpp"

namespace robot_test {

inline const mpm::Vec3 kGravity{0.0, 0.0, -9.81};  // [m/s^2]

inline std::string data_file(const std::string& name) {
  return std::string(mpm::source_folder()) + "/test/data/robots/" + name;
}

/// All joints by `drive`, at position 0; no link meets anything.
inline mpm::RobotDefinition load(const std::string& name, mpm::JointDrive drive = mpm::JointDrive::effort) {
  mpm::provide_robots();
  mpm::RobotDefinition robot;
  robot.name = "robot";
  robot.model = mpm::load_urdf_robot(data_file(name));
  for (std::size_t j = 0; j < robot.model.joints.size(); ++j) {
    if (!robot.model.joints[j].moves() || robot.model.joints[j].mimic) continue;
    mpm::JointDefinition joint;
    joint.joint = static_cast<int>(j);
    joint.drive = drive;
    robot.joints.push_back(joint);
  }
  return robot;
}

inline void run(mpm::Robot& robot, int steps, double dt, double start = 0.0) {
  for (int k = 0; k < steps; ++k) {
    robot.begin_step(start + k * dt, dt);
    robot.end_step();
  }
}

}  // namespace robot_test
