#include "mpm/robot/poses.hpp"

namespace mpm {
namespace {

double start_position(const RobotDefinition& robot, int joint) {
  if (const auto& mimic = robot.model.joints[joint].mimic) {
    return mimic->factor * start_position(robot, mimic->joint) + mimic->offset;
  }
  for (const JointDefinition& definition : robot.joints) {
    if (definition.joint == joint) return definition.position;
  }
  return 0.0;
}

}  // namespace

std::vector<Pose> start_poses(const RobotDefinition& robot) {
  std::vector<Pose> poses = {robot.base.pose};
  for (std::size_t j = 0; j < robot.model.joints.size(); ++j) {
    const ModelJoint& joint = robot.model.joints[j];
    const Pose& parent = poses[joint.parent];
    Pose pose{parent.to_world(joint.origin.position), parent.orientation * joint.origin.orientation};
    if (joint.moves()) {
      const double position = start_position(robot, static_cast<int>(j));
      if (joint.kind == ModelJoint::Kind::revolute) {
        pose.orientation = pose.orientation * Quat(Eigen::AngleAxisd(position, joint.axis));
      } else {
        pose.position += pose.orientation * (position * joint.axis);
      }
    }
    poses.push_back(pose);
  }
  return poses;
}

}  // namespace mpm
