// Commands to a rigid body and its motion between sync points.
#include "mpm/rigid/rigid_body.hpp"

#include <cmath>
#include <sstream>
#include <utility>

#include "mpm/math/nanoseconds.hpp"

namespace mpm {

namespace {

std::string text_of(const Vec3& v) {
  std::ostringstream text;
  text << "(" << v.x() << ", " << v.y() << ", " << v.z() << ")";
  return text.str();
}

}  // namespace

Pose checked_pose(const Pose& pose, const std::string& what) {
  const std::string start = what + ": ";
  if (!pose.position.allFinite()) throw RigidError(start + "position " + text_of(pose.position) + " is not finite");
  if (!pose.orientation.coeffs().allFinite()) throw RigidError(start + "orientation is not finite");
  const double length = pose.orientation.norm();
  if (!(std::abs(length - 1.0) <= 1e-3)) {
    std::ostringstream text;
    text << start << "orientation is a quaternion of length " << length << "; send one of length 1";
    throw RigidError(text.str());
  }
  return {pose.position, pose.orientation.normalized()};
}

RigidBody::RigidBody(RigidBodyDefinition definition) : definition_(std::move(definition)) {
  const std::string start = "rigid body '" + definition_.name + "': ";
  if (definition_.name.empty()) throw RigidError("rigid body without a name; give it one");
  if (!definition_.surface) throw RigidError(start + "it has no shape");
  const double friction = definition_.friction.coefficient;
  if (!(friction >= 0.0) || std::isinf(friction)) {
    std::ostringstream text;
    text << start << "friction coefficient is " << friction << "; it must be finite and not negative";
    throw RigidError(text.str());
  }
  if (!(definition_.inner_radius >= 0.0) || std::isinf(definition_.inner_radius)) {
    std::ostringstream text;
    text << start << "inner radius is " << definition_.inner_radius << " m; it must be finite and not negative";
    throw RigidError(text.str());
  }
  definition_.pose = checked_pose(definition_.pose, start + "initial pose");
  if (definition_.inner_radius > 0.0) motion_ = RingMotion(definition_.inner_radius, definition_.outer_radius);
  check(definition_.pose, "initial pose");
  pose_ = definition_.pose;
  if (!definition_.free) return;
  FreeMotion& free = motion_.emplace<FreeMotion>(*definition_.free, definition_.name);
  twist_ = definition_.free->velocity;
  twist_ = twist_at(0.0);
  free.start(pose_, twist_);
}

void RigidBody::check(const Pose& pose, const char* what) const {
  const std::string reason = motion().refused(pose);
  if (!reason.empty()) throw RigidError("rigid body '" + name() + "': " + what + ": " + reason);
}

void RigidBody::command_velocity(const Twist& twist) {
  if (!twist.linear.allFinite() || !twist.angular.allFinite()) {
    throw RigidError("rigid body '" + name() + "': velocity command is not finite: linear " + text_of(twist.linear) +
                     ", angular " + text_of(twist.angular));
  }
  if (const std::string reason = motion().refused_velocity(); !reason.empty()) {
    throw RigidError("rigid body '" + name() + "': " + reason);
  }
  twist_ = motion().merged(twist_, twist);
  drive_ = Drive::velocity;
}

void RigidBody::apply_wrench(const Wrench& wrench) {
  const std::string start = "rigid body '" + name() + "': wrench command ";
  if (!wrench.force.allFinite() || !wrench.torque.allFinite()) {
    throw RigidError(start + "is not finite: force " + text_of(wrench.force) + ", torque " + text_of(wrench.torque));
  }
  if (const LinkMotion* link = link_motion()) throw RigidError(start + "refused: " + link->refused_velocity());
  FreeMotion* free = free_motion();
  if (free == nullptr) throw RigidError(start + "for a body that only moves as prescribed; give it a mass by `free`");
  free->apply_wrench(wrench);
}

void RigidBody::command_pose(const Pose& target, std::int64_t now, std::int64_t arrival) {
  if (const std::string reason = motion().refused_pose(); !reason.empty()) {
    throw RigidError("rigid body '" + name() + "': " + reason);
  }
  const Pose goal = checked_pose(target, "rigid body '" + name() + "': pose command");
  if (arrival <= now) {
    throw RigidError("rigid body '" + name() + "': pose command arrives at " + std::to_string(arrival) +
                     " ns, not after the present " + std::to_string(now) + " ns");
  }
  check(goal, "pose command");
  target_ = goal;
  arrival_ = arrival;
  twist_ = twist_between(pose_, target_, seconds_of(arrival - now));
  drive_ = Drive::pose;
}

void RigidBody::set_state(const Pose& pose, const Twist& twist, const Vec3& gravity) {
  const std::string start = "rigid body '" + name() + "': ";
  const Pose goal = checked_pose(pose, start + "the pose that is set");
  check(goal, "the pose that is set");
  if (!twist.linear.allFinite() || !twist.angular.allFinite()) throw RigidError(start + "the twist is not finite");
  FreeMotion* free = free_motion();
  if (free == nullptr && !(twist.linear.isZero(0.0) && twist.angular.isZero(0.0))) {
    throw RigidError(start + "it moves as is prescribed, and its velocity is commanded; leave the twist out");
  }
  pose_ = goal;
  if (free != nullptr) {
    twist_ = motion().merged(twist, twist_);
    free->put(pose_, twist_, gravity);
  } else if (drive_ == Drive::pose) {
    twist_ = {};
    drive_ = Drive::velocity;
  }
}

Twist RigidBody::twist_at(double time) const {
  if (drive_ != Drive::functions) return twist_;
  Twist twist;
  for (int i = 0; i < 3; ++i) {
    twist.linear[i] = definition_.velocity[i](time);
    twist.angular[i] = definition_.rotation_rate[i](time);
  }
  return motion().merged(twist_, twist);
}

void RigidBody::begin_step(double time, double dt) {
  if (drive_ == Drive::functions) {
    twist_ = twist_at(time + 0.5 * dt);
  } else if (drive_ == Drive::pose && seconds_of(arrival_) - time < (1.0 - 1e-6) * dt) {
    // Arrived: rest. An arrival between two sync points lies within a step: be there at its end. (Less than a millionth
    // short is rounding of the clock, and the twist as it is arrives.)
    twist_ = twist_between(pose_, target_, dt);
  }
}

void RigidBody::end_step(double dt) {
  twist_ = std::visit([&](BodyMotion& motion) { return motion.advance(pose_, twist_, dt); }, motion_);
  check(pose_, "motion");
}

void RigidBody::at_sync(std::int64_t now) {
  if (drive_ == Drive::pose && now >= arrival_) pose_ = target_;
}

void RigidBody::serialise(StateArchive& archive) {
  archive.value("position", pose_.position);
  archive.value("orientation", pose_.orientation);
  archive.value("linear", twist_.linear);
  archive.value("angular", twist_.angular);
  archive.value("drive", drive_);
  archive.value("target_position", target_.position);
  archive.value("target_orientation", target_.orientation);
  archive.value("arrival", arrival_);
  if (FreeMotion* free = free_motion()) {
    const StateArchive::Group group(archive, "free");
    free->serialise(archive);
  }
}

}  // namespace mpm
