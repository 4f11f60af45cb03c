// State of a robot that is set from outside between two steps.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mpm/robot/robot.hpp"

namespace mpm {

void Robot::check_state(std::size_t joint, double position, double velocity) const {
  const auto within = [&](const ModelJoint& model, double at) {
    if (at >= model.lower && at <= model.upper) return;
    throw RigidError(fmt::format("robot '{}': joint '{}' is set to {:g}, outside its limits from {:g} to {:g}",
                                 definition_.name, model.name, at, model.lower, model.upper));
  };
  if (!std::isfinite(position) || !std::isfinite(velocity)) {
    throw RigidError(joint_text(joint) + fmt::format("is set to {} with the velocity {}", position, velocity));
  }
  const int own = definition_.joints[joint].joint;
  within(definition_.model.joints[own], position);
  for (const ModelJoint& other : definition_.model.joints) {
    if (other.mimic && other.mimic->joint == own) within(other, other.mimic->factor * position + other.mimic->offset);
  }
}

void Robot::check_twist(const Twist& twist) const {
  if (!twist.linear.allFinite() || !twist.angular.allFinite()) {
    throw RigidError(fmt::format("robot '{}': the twist of its base is not finite", definition_.name));
  }
  if (definition_.base.kind == BaseKind::free || (twist.linear.isZero(0.0) && twist.angular.isZero(0.0))) return;
  throw RigidError(fmt::format("robot '{}': its base {}; leave its twist out", definition_.name,
                               definition_.base.kind == BaseKind::fixed
                                   ? "is fixed and has no velocity"
                                   : "moves as is prescribed, and its velocity is commanded"));
}

void Robot::put_links() {
  find_places();
  for (Link& link : links_) {
    const LinkMotion::Vec6 twist = link.jacobian * velocities_;
    link.body->put(engine_->pose(link.link));
    link.body->set_twist({twist.tail<3>(), twist.head<3>()});
  }
}

void Robot::set_state(const std::optional<Pose>& pose, const Twist& twist, const JointStates& joints,
                      const CheckPlaces& check) {
  if (!pose && joints.names.empty()) {
    throw RigidError(fmt::format("robot '{}': neither a pose of its base nor a joint is given", definition_.name));
  }
  if (joints.positions.size() != joints.names.size() ||
      (!joints.velocities.empty() && joints.velocities.size() != joints.names.size())) {
    throw RigidError(
        fmt::format("robot '{}': {} joints, {} positions and {} velocities; give one of each a joint, or no "
                    "velocities",
                    definition_.name, joints.names.size(), joints.positions.size(), joints.velocities.size()));
  }
  const auto velocity_of = [&](std::size_t k) { return joints.velocities.empty() ? 0.0 : joints.velocities[k]; };
  std::vector<std::size_t> places;
  for (std::size_t k = 0; k < joints.names.size(); ++k) {
    places.push_back(static_cast<std::size_t>(find_joint(joints.names[k])));
    check_state(places.back(), joints.positions[k], velocity_of(k));
  }
  if (pose) check_twist(twist);
  const Pose base = pose ? checked_pose(*pose, fmt::format("robot '{}': its base", definition_.name)) : base_;

  struct Kept {
    Pose pose;
    Twist twist;
  };
  std::vector<Kept> kept;
  for (const Link& link : links_) kept.push_back({link.body->pose(), link.body->twist()});
  const Pose base_before = base_;
  const Eigen::VectorXd positions_before = positions_, velocities_before = velocities_;
  base_ = base;
  if (pose && definition_.base.kind == BaseKind::free) velocities_.head<6>() = in_base_axes(twist);
  for (std::size_t k = 0; k < places.size(); ++k) {
    positions_[static_cast<Eigen::Index>(places[k])] = joints.positions[k];
    velocities_[base_freedoms() + static_cast<Eigen::Index>(places[k])] = velocity_of(k);
  }
  put_links();
  std::vector<const RigidBody*> moved;
  for (std::size_t l = 0; l < links_.size(); ++l) {
    const Pose& now = links_[l].body->pose();
    const bool same =
        now.position == kept[l].pose.position && now.orientation.coeffs() == kept[l].pose.orientation.coeffs();
    if (!same) moved.push_back(links_[l].body);
  }
  try {
    check(moved);
  } catch (const RigidError&) {
    base_ = base_before;
    positions_ = positions_before;
    velocities_ = velocities_before;
    find_places();
    for (std::size_t l = 0; l < links_.size(); ++l) {
      links_[l].body->put(kept[l].pose);
      links_[l].body->set_twist(kept[l].twist);
    }
    throw;
  }

  if (pose && base_motion_ != nullptr) base_motion_->set_state(base_, {}, Vec3::Zero());
  for (std::size_t k = 0; k < places.size(); ++k) {
    // A drive by position stays where it is put: it would go back at once.
    if (definition_.joints[places[k]].drive == JointDrive::position) targets_[places[k]].hold(joints.positions[k]);
  }
  for (Link& link : links_) link.motion->set_acceleration(0.0);
  const double before = energies_.kinetic + energies_.potential;
  energies_.kinetic = 0.5 * velocities_.dot(mass_ * velocities_);
  energies_.potential = engine_->potential();
  energies_.set += energies_.kinetic + energies_.potential - before;
}

}  // namespace mpm
