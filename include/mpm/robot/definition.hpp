// The definition of a robot: its links and joints, what drives these, where its base is, and which links meet the
// material.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mpm/math/function.hpp"
#include "mpm/rigid/robot_model.hpp"

namespace mpm {

/// Quantity that a joint's drive follows: a velocity, a position, or an effort alone.
enum class JointDrive : std::uint8_t { velocity = 0, position = 1, effort = 2 };
inline constexpr std::array kJointDriveNames = {"velocity", "position", "effort"};

struct JointDefinition {
  int joint = 0;  ///< in RobotModel::joints
  JointDrive drive = JointDrive::effort;
  /// Target of the drive, a function of t, until a command comes. Without one: of a position drive the position at the
  /// start, of others 0. [m], [rad]; a second; [N], [N m]
  std::optional<Function> target;
  /// Stiffness and damping of a position drive, effort = stiffness (target - position) + damping (rate of the target -
  /// velocity); without stiffness the joint is where the target is, as far as its effort allows.
  double stiffness = 0.0;        ///< [N/m], [N m/rad]
  double damping = 0.0;          ///< [N s/m], [N m s/rad]
  std::optional<double> effort;  ///< limit of the drive; without one that of the model [N], [N m]
  double position = 0.0;         ///< at the start [m], [rad]
};

enum class BaseKind : std::uint8_t { fixed = 0, free = 1, moving = 2 };

struct BaseDefinition {
  BaseKind kind = BaseKind::fixed;
  Pose pose;                              ///< at the start
  std::array<Function, 3> velocity;       ///< velocity of a moving base's origin, world axes [m/s]
  std::array<Function, 3> rotation_rate;  ///< world axes [rad/s]
};

/// A link that meets the material, as a rigid body of the scene.
struct LinkContact {
  int link = 0;      ///< in RobotModel::links
  std::string body;  ///< name of the rigid body
};

/// A force-torque sensor at a joint.
struct SensorDefinition {
  int joint = 0;        ///< in RobotModel::joints
  bool gravity = true;  ///< true if it feels the weight of what hangs on it, as a sensor does that is not tared
};

struct RobotDefinition {
  std::string name;
  RobotModel model;
  BaseDefinition base;
  std::vector<JointDefinition> joints;  ///< one for each joint that moves and mimics none, in their order
  std::vector<LinkContact> contacts;
  std::vector<SensorDefinition> sensors;
};

}  // namespace mpm
