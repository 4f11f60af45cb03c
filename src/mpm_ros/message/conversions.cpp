#include "mpm_ros/message/conversions.hpp"

#include <fmt/format.h>

#include <cmath>

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
  message.wrench = to_message(report.mean);
  message.peak = to_message(report.peak);
  message.impulse = to_vector(report.impulse);
  message.interval = report.interval;
  message.nodes = static_cast<std::uint32_t>(report.nodes);
  message.contact_area = report.area;
  message.friction_energy = report.friction_energy;
  message.pressing = report.pressing;
  message.friction = to_vector(report.friction);
  message.per_radian = to_vector(report.per_radian);
  message.centre_of_pressure = to_point(report.centre_of_pressure());
  message.arm = to_vector(report.arm);
  return message;
}

mpm::ContactReport from_message(const mpm_ros::ContactForce& message) {
  mpm::ContactReport report;
  report.body = message.name;
  report.mean = from_message(message.wrench);
  report.peak = from_message(message.peak);
  report.impulse = from_message(message.impulse);
  report.interval = message.interval;
  report.nodes = static_cast<int>(message.nodes);
  report.area = message.contact_area;
  report.friction_energy = message.friction_energy;
  report.pressing = message.pressing;
  report.friction = from_message(message.friction);
  report.per_radian = from_message(message.per_radian);
  report.arm = from_message(message.arm);
  report.origin = from_message(message.centre_of_pressure) - report.arm;
  return report;
}

mpm_ros::ContactPair to_message(const mpm::PairReport& report) {
  mpm_ros::ContactPair message;
  message.name = report.name;
  message.force = to_vector(report.force);
  message.friction = to_vector(report.friction);
  message.impulse = to_vector(report.impulse);
  message.interval = report.interval;
  message.pressing = report.pressing;
  message.nodes = static_cast<std::uint32_t>(report.nodes);
  message.contact_area = report.area;
  message.friction_energy = report.friction_energy;
  message.interface_energy = report.interface_energy;
  message.centre_of_pressure = to_point(report.centre);
  return message;
}

mpm::PairReport from_message(const mpm_ros::ContactPair& message) {
  mpm::PairReport report;
  report.name = message.name;
  report.force = from_message(message.force);
  report.friction = from_message(message.friction);
  report.impulse = from_message(message.impulse);
  report.interval = message.interval;
  report.pressing = message.pressing;
  report.nodes = static_cast<int>(message.nodes);
  report.area = message.contact_area;
  report.friction_energy = message.friction_energy;
  report.interface_energy = message.interface_energy;
  report.centre = from_message(message.centre_of_pressure);
  return report;
}

mpm_ros::SolverState to_message(const mpm::SolverState& state) {
  mpm_ros::SolverState message;
  message.time = static_cast<double>(state.time) * 1e-9;
  message.steps = state.step.steps;
  message.dt = state.step.dt_last;
  message.dt_min = state.step.dt_min;
  message.dt_max = state.step.dt_max;
  message.dt_limited_by = state.step.limited_by;
  message.particles = state.particles;
  message.particles_returned = static_cast<std::uint64_t>(state.number("returned"));
  message.energy_kinetic = state.energy.of("kinetic");
  message.energy_elastic = state.energy.of("elastic");
  message.energy_plastic = state.energy.of("plastic");
  message.energy_potential = state.energy.of("potential");
  message.contact_work = state.energy.of("contact_work");
  message.load_work = state.energy.of("load_work");
  message.energy_friction = state.energy.of("friction");
  message.energy_free_kinetic = state.energy.of("free_kinetic");
  message.energy_free_potential = state.energy.of("free_potential");
  message.energy_free_loss = state.energy.of("free_loss");
  message.free_work = state.energy.of("free_work");
  message.energy_pair_friction = state.energy.of("pair_friction");
  message.energy_interface = state.energy.of("interface");
  message.momentum = to_vector(state.audit.momentum);
  message.initial_momentum = to_vector(state.audit.initial_momentum);
  for (const mpm::NamedImpulse& impulse : state.audit.impulses) {
    mpm_ros::Impulse entry;
    entry.name = impulse.name;
    entry.impulse = to_vector(impulse.impulse);
    message.impulses.push_back(entry);
  }
  message.momentum_exchanged = state.audit.exchanged;
  message.momentum_carried = state.audit.carried;
  message.momentum_error = state.audit.residual;
  message.min_j = state.min_j;
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
