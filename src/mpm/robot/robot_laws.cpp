// Laws of a robot's joints and of a moving base in a step, and how fast they may become in a sync period.
#include <algorithm>
#include <cmath>

#include "mpm/robot/robot.hpp"

namespace mpm {
namespace {

constexpr double kRateStep = 1e-6;  ///< [s] over which the rate of a target is taken for the limit of the step

}  // namespace

LinkMotion::Vec6 Robot::in_base_axes(const Twist& twist) const {
  const Quat back = base_.orientation.conjugate();
  LinkMotion::Vec6 turned;
  turned << back * twist.angular, back * twist.linear;
  return turned;
}

JointActions Robot::actions_of(std::size_t place, double time) const {
  const JointDefinition& joint = definition_.joints[place];
  const ModelJoint& model = definition_.model.joints[joint.joint];
  const double position = positions_[static_cast<Eigen::Index>(place)];
  const JointTarget& target = targets_[place];
  JointActions actions;
  actions.damping = model.damping;
  actions.friction = model.friction;
  actions.limit = joint.effort.value_or(model.effort);
  actions.least = (model.lower - position) / dt_;
  actions.most = (model.upper - position) / dt_;
  for (const ModelJoint& other : definition_.model.joints) {
    if (!other.mimic || other.mimic->joint != joint.joint) continue;
    const double factor = other.mimic->factor, at = factor * position + other.mimic->offset;
    actions.damping += factor * factor * other.damping;
    actions.friction += std::abs(factor) * other.friction;
    if (factor == 0.0) continue;
    const double low = (other.lower - at) / (factor * dt_), high = (other.upper - at) / (factor * dt_);
    actions.least = std::max(actions.least, std::min(low, high));
    actions.most = std::min(actions.most, std::max(low, high));
  }
  const double middle = time + 0.5 * dt_, end = time + dt_;
  switch (joint.drive) {
    case JointDrive::effort:
      actions.effort = target.at(middle);
      break;
    case JointDrive::velocity:
      actions.target = std::clamp(target.at(middle), -model.speed, model.speed);
      if (joint.damping > 0.0) {
        actions.drive = JointActions::Drive::spring;
        actions.at_rest = joint.damping * actions.target;
        actions.slope = joint.damping;
      } else {
        actions.drive = JointActions::Drive::rigid;
      }
      break;
    case JointDrive::position:
      if (joint.stiffness > 0.0) {
        actions.drive = JointActions::Drive::spring;
        actions.at_rest = joint.stiffness * (target.at(end) - position) + joint.damping * target.rate(end, dt_);
        actions.slope = joint.stiffness * dt_ + joint.damping;
      } else {
        actions.drive = JointActions::Drive::rigid;
        actions.target = std::clamp((target.at(end) - position) / dt_, -model.speed, model.speed);
      }
      break;
  }
  return actions;
}

void Robot::set_laws(double time) {
  std::vector<JointLaw>& laws = solution_.laws();
  const int base = base_freedoms();
  if (base_motion_ != nullptr) {
    const LinkMotion::Vec6 twist = in_base_axes(base_motion_->twist());
    for (int k = 0; k < 6; ++k) laws[k] = JointLaw::prescribed(twist[k]);
  }
  for (std::size_t j = 0; j < definition_.joints.size(); ++j) {
    laws[base + j] = JointLaw(actions_of(j, time), dt_);
    const bool position = definition_.joints[j].drive == JointDrive::position;
    last_targets_[j] = targets_[j].at(position ? time + dt_ : time + 0.5 * dt_);
  }
}

double Robot::largest_speed(std::size_t contact, double start, double ahead, double period) const {
  const Link& link = links_[contact];
  const int base = base_freedoms();
  double speed = 0.0;
  // Joints may turn either way: one does not cancel another.
  const auto add = [&](Eigen::Index freedom, double velocity) {
    const auto column = link.jacobian.col(freedom);
    speed += std::abs(velocity) * (column.tail<3>().norm() + link.reach * column.head<3>().norm());
  };
  for (std::size_t j = 0; j < definition_.joints.size(); ++j) {
    const JointDefinition& joint = definition_.joints[j];
    const double most = definition_.model.joints[joint.joint].speed;
    double wanted = 0.0;
    if (joint.drive == JointDrive::velocity) wanted = targets_[j].at(start + ahead);
    if (joint.drive == JointDrive::position) {
      const double way = targets_[j].at(start + ahead) - positions_[static_cast<Eigen::Index>(j)];
      wanted = joint.stiffness > 0.0 ? targets_[j].rate(start + std::max(ahead, kRateStep), kRateStep)
                                     : way / std::max(ahead, period);
    }
    const Eigen::Index freedom = base + static_cast<Eigen::Index>(j);
    add(freedom, std::max(std::abs(velocities_[freedom]), std::min(std::abs(wanted), most)));
  }
  Eigen::Matrix<double, 6, 1> twist = Eigen::Matrix<double, 6, 1>::Zero();
  if (base_motion_ != nullptr) {
    twist = in_base_axes(base_motion_->twist_at(start + ahead));
  } else if (base > 0) {
    twist = velocities_.head<6>();
  }
  for (int k = 0; k < base; ++k) add(k, twist[k]);
  return speed;
}

}  // namespace mpm
