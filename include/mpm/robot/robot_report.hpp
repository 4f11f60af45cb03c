// Report of a robot at a sync point: joints, sensors, energies.
#pragma once

#include <string>
#include <vector>

#include "mpm/rigid/motion.hpp"
#include "mpm/robot/definition.hpp"

namespace mpm {

struct JointReport {
  std::string name;
  bool prismatic = false;  ///< in metres and newtons; else in radians and newton metres
  double position = 0.0;   ///< [m], [rad]
  double velocity = 0.0;   ///< [m/s], [rad/s]
  double effort = 0.0;     ///< effort of the drive in the last step [N], [N m]
  double impulse = 0.0;    ///< impulse of the drive since the start of the run [N s], [N m s]
  double target = 0.0;     ///< target of the drive, by its kind
  JointDrive drive = JointDrive::effort;
};

/// Wrench that a joint transmits to its child link, in the child's axes and about its origin.
struct SensorReport {
  std::string joint, link;
  Wrench wrench;   ///< in the last step
  Wrench impulse;  ///< since the start of the run [N s], [N m s]
};

/// Energies since the start of the run [J]; kinetic + potential changes by drive + damping + friction + limit +
/// contact + set.
struct RobotEnergies {
  double kinetic = 0.0, potential = 0.0;
  double drive = 0.0;    ///< work of the drives, and of what moves the base
  double damping = 0.0;  ///< work of damping in joints, at most 0 as those below
  double friction = 0.0;
  double limit = 0.0;
  double contact = 0.0;  ///< work of the material and of other bodies on the links
  double loss = 0.0;     ///< lost where links met the material, sliding left out, and other bodies
  double set = 0.0;      ///< given by Simulation::set_state()
};

struct RobotReport {
  std::string name;
  Pose base;
  Twist base_twist;
  std::vector<JointReport> joints;  ///< all that move, mimic joints too
  std::vector<SensorReport> sensors;
  std::vector<std::string> links;  ///< bodies that are its links
  RobotEnergies energies;
};

}  // namespace mpm
