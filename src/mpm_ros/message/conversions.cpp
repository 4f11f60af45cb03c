#include "mpm_ros/message/conversions.hpp"

#include <fmt/format.h>

#include <cmath>

#include "mpm_ros/message/quantities.hpp"

namespace mpm_ros {

static_assert(static_cast<int>(mpm::Drive::functions) == mpm_ros::BodyState::FUNCTIONS);
static_assert(static_cast<int>(mpm::Drive::velocity) == mpm_ros::BodyState::VELOCITY);
static_assert(static_cast<int>(mpm::Drive::pose) == mpm_ros::BodyState::POSE);

namespace {

/// Names the first component that is not finite, or is empty.
template <typename Message>
std::string non_finite(const Message& message, const char* name) {
  if (!std::isfinite(message.x)) return fmt::format("{}.x is {}", name, message.x);
  if (!std::isfinite(message.y)) return fmt::format("{}.y is {}", name, message.y);
  if (!std::isfinite(message.z)) return fmt::format("{}.z is {}", name, message.z);
  return {};
}

mpm::Quat quaternion(const geometry_msgs::Quaternion& message) { return {message.w, message.x, message.y, message.z}; }

}  // namespace

geometry_msgs::Vector3 to_vector(const mpm::Vec3& value) {
  geometry_msgs::Vector3 message;
  message.x = value.x();
  message.y = value.y();
  message.z = value.z();
  return message;
}

geometry_msgs::Point to_point(const mpm::Vec3& value) {
  geometry_msgs::Point message;
  message.x = value.x();
  message.y = value.y();
  message.z = value.z();
  return message;
}

geometry_msgs::Pose to_message(const mpm::Pose& pose) {
  geometry_msgs::Pose message;
  message.position = to_point(pose.position);
  message.orientation.w = pose.orientation.w();
  message.orientation.x = pose.orientation.x();
  message.orientation.y = pose.orientation.y();
  message.orientation.z = pose.orientation.z();
  return message;
}

geometry_msgs::Pose to_pose(const geometry_msgs::Transform& transform) {
  geometry_msgs::Pose pose;
  pose.position.x = transform.translation.x;
  pose.position.y = transform.translation.y;
  pose.position.z = transform.translation.z;
  pose.orientation = transform.rotation;
  return pose;
}

geometry_msgs::Twist to_message(const mpm::Twist& twist) {
  geometry_msgs::Twist message;
  message.linear = to_vector(twist.linear);
  message.angular = to_vector(twist.angular);
  return message;
}

geometry_msgs::Wrench to_message(const mpm::Wrench& wrench) {
  geometry_msgs::Wrench message;
  message.force = to_vector(wrench.force);
  message.torque = to_vector(wrench.torque);
  return message;
}

mpm::Vec3 from_message(const geometry_msgs::Vector3& message) { return {message.x, message.y, message.z}; }

mpm::Vec3 from_message(const geometry_msgs::Point& message) { return {message.x, message.y, message.z}; }

mpm::Wrench from_message(const geometry_msgs::Wrench& message) {
  return {from_message(message.force), from_message(message.torque)};
}

mpm::Twist from_message(const geometry_msgs::Twist& message) {
  return {from_message(message.linear), from_message(message.angular)};
}

mpm::Pose from_message(const geometry_msgs::Pose& message) {
  return {from_message(message.position), quaternion(message.orientation)};
}

std::string problem_of(const geometry_msgs::Twist& message) {
  const std::string linear = non_finite(message.linear, "linear");
  return linear.empty() ? non_finite(message.angular, "angular") : linear;
}

std::string problem_of(const geometry_msgs::Pose& message) {
  if (std::string problem = non_finite(message.position, "position"); !problem.empty()) return problem;
  if (std::string problem = non_finite(message.orientation, "orientation"); !problem.empty()) return problem;
  if (!std::isfinite(message.orientation.w)) return fmt::format("orientation.w is {}", message.orientation.w);
  const double norm = quaternion(message.orientation).norm();
  if (std::abs(norm - 1.0) > kQuaternionTolerance) {
    return fmt::format("the orientation's quaternion has norm {:g}, not 1", norm);
  }
  return {};
}

mpm::Pose checked_pose(const geometry_msgs::Pose& message) {
  mpm::Pose pose = from_message(message);
  pose.orientation.normalize();
  return pose;
}

mpm_ros::BodyState to_message(const mpm::BodyState& state) {
  mpm_ros::BodyState message;
  message.name = state.name;
  message.pose = to_message(state.pose);
  message.twist = to_message(state.twist);
  message.drive = static_cast<std::uint8_t>(state.drive);
  message.mass = state.mass;
  return message;
}

mpm_ros::ContactForce to_message(const mpm::ContactReport& report) {
  mpm_ros::ContactForce message;
  message.name = report.body;
  fill(message, report, contact_quantities());
  return message;
}

mpm_ros::ContactPair to_message(const mpm::PairReport& report) {
  mpm_ros::ContactPair message;
  message.name = report.name;
  fill(message, report, pair_quantities());
  return message;
}

namespace {

/// A number of a module that no line of the list is about, by the key of its figure or by its column.
void add_other(mpm_ros::SolverState& message, const std::string& name, const std::string& unit, double value) {
  for (const StateQuantity& one : state_quantities()) {
    if (one.column == name || (!one.figures.empty() && one.figures.front().key == name)) return;
  }
  NamedValue& other = message.values.emplace_back();
  other.name = name;
  other.unit = unit;
  other.value = {value};
}

}  // namespace

Volumes to_message(const std::vector<mpm::VolumeReport>& volumes) {
  Volumes message;
  for (const mpm::VolumeReport& volume : volumes) {
    Volume& one = message.volumes.emplace_back();
    one.name = volume.name;
    one.mass = volume.mass;
    one.volume = volume.volume;
    one.centre.x = volume.centre.x();
    one.centre.y = volume.centre.y();
    one.centre.z = volume.centre.z();
    one.mass_in = volume.mass_in;
    one.mass_out = volume.mass_out;
  }
  return message;
}

Cracks to_message(const std::vector<mpm::CrackReport>& cracks, const std::vector<mpm::CrackTipReport>& tips) {
  Cracks message;
  for (const mpm::CrackReport& crack : cracks) {
    Crack& to = message.cracks.emplace_back();
    to.name = crack.name;
    to.length = crack.length;
    to.open_length = crack.open_length;
    for (std::size_t k = 0; k < crack.points.size(); ++k) {
      to.points.push_back(to_point(crack.points[k]));
      to.above.push_back(to_point(crack.above[k]));
      to.below.push_back(to_point(crack.below[k]));
      to.debonded.push_back(crack.debonded[k] ? 1 : 0);
    }
    to.normal_traction = crack.normal_traction;
    to.shear_traction = crack.shear_traction;
  }
  for (const mpm::CrackTipReport& tip : tips) {
    CrackTip& to = message.tips.emplace_back();
    to.crack = tip.crack;
    to.end = tip.end;
    to.place = to_point(tip.place);
    to.direction = to_vector(tip.direction);
    to.state = tip.state;
    to.growth = tip.growth;
    to.material = tip.material;
    fill(to, tip, tip_quantities());
  }
  return message;
}

mpm_ros::SolverState to_message(const mpm::SolverState& state) {
  mpm_ros::SolverState message;
  fill(message, state, state_quantities());
  for (const mpm::NamedEnergy& energy : state.energy.list()) add_other(message, energy.name, "J", energy.value);
  if (state.energy.closed()) add_other(message, kBalance, "J", state.energy.balance());
  for (const mpm::NamedNumber& number : state.numbers) add_other(message, number.name, number.unit, number.value);
  message.dt_limited_by = state.step.limited_by;
  for (const mpm::NamedImpulse& impulse : state.audit.impulses) {
    mpm_ros::Impulse entry;
    entry.name = impulse.name;
    entry.impulse = to_vector(impulse.impulse);
    message.impulses.push_back(entry);
  }
  return message;
}

mpm::Wrench in_body_axes(const mpm::Wrench& world, const mpm::Quat& orientation) {
  const mpm::Quat inverse = orientation.conjugate();
  return {inverse * world.force, inverse * world.torque};
}

tf2_msgs::TFMessage to_transforms(const std::vector<mpm::BodyState>& bodies, const std::string& world_frame,
                                  const ros::Time& stamp) {
  tf2_msgs::TFMessage message;
  for (const mpm::BodyState& body : bodies) {
    geometry_msgs::TransformStamped transform;
    transform.header.stamp = stamp;
    transform.header.frame_id = world_frame;
    transform.child_frame_id = body.name;
    const geometry_msgs::Pose pose = to_message(body.pose);
    transform.transform.translation = to_vector(body.pose.position);
    transform.transform.rotation = pose.orientation;
    message.transforms.push_back(transform);
  }
  return message;
}

std::string hash_text(std::uint64_t hash) { return fmt::format("{:016x}", hash); }

}  // namespace mpm_ros
