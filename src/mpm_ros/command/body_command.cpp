#include "mpm_ros/command/body_command.hpp"

#include <fmt/format.h>

#include <cmath>

#include "mpm/simulation/projected.hpp"
#include "mpm_ros/message/bag_error.hpp"
#include "mpm_ros/message/conversions.hpp"

namespace mpm_ros {

namespace {

/// Reach of a body from its origin [m]; endless axes do not count.
double reach_of(const mpm::RigidBody& body) {
  const mpm::Box bounds = body.surface().bounds();
  const mpm::Vec3 corner = bounds.min.cwiseAbs().cwiseMax(bounds.max.cwiseAbs());
  return corner.unaryExpr([](double c) { return std::isfinite(c) ? c : 0.0; }).norm();
}

/// Largest distance that the command moves a point of its body in a sync period [m]; infinite when it overflows.
double travel_of(const AppliedCommand& command, const mpm::Simulation& simulation) {
  const mpm::RigidBody& body = simulation.rigid_body(command.body);
  const double sync = mpm::seconds_of(simulation.sync_period());
  // Motion that the geometry does not have is none: a link beside the plane of a planar scene.
  const mpm::GeometryKind geometry = simulation.definition().geometry;
  if (command.kind == CommandKind::wrench) {
    const mpm::FreeMotion* free = body.free_motion();
    if (free == nullptr) return 0.0;  // refused by the body
    const mpm::FreeDefinition& of = free->definition();
    double acceleration = 0.0;  // gain of a period, which it may travel in the next
    for (int k = 0; k < 3; ++k) {
      if (of.axes[k]) acceleration += std::abs(command.wrench.force[k]) / of.mass;
      if (of.axes[3 + k]) acceleration += std::abs(command.wrench.torque[k]) / of.inertia(k, k) * reach_of(body);
    }
    return sync * sync * acceleration;
  }
  if (command.kind == CommandKind::velocity) {
    const mpm::Twist twist = mpm::projected(command.twist, geometry, body.definition());
    return sync * (twist.linear.norm() + twist.angular.norm() * reach_of(body));
  }
  const mpm::Pose pose = mpm::projected(command.pose, geometry, body.definition());
  const double periods = mpm::seconds_of(command.arrival - command.effect) / sync;
  const double turn = pose.orientation.angularDistance(body.pose().orientation);
  return ((pose.position - body.pose().position).norm() + turn * reach_of(body)) / periods;
}

/// @throws mpm::RigidError for a velocity that a plane, or a line, does not have
void check_plane(const AppliedCommand& command, const mpm::Simulation& simulation) {
  const mpm::GeometryKind geometry = simulation.definition().geometry;
  if (command.kind != CommandKind::velocity || geometry == mpm::GeometryKind::axisymmetric) return;
  const mpm::RigidBody& body = simulation.rigid_body(command.body);
  const mpm::Twist kept = mpm::projected(command.twist, geometry, body.definition());
  const double moved = (command.twist.linear - kept.linear).norm(),
               turned = (command.twist.angular - kept.angular).norm();
  // Not more than the round-off of a change of axes.
  constexpr double kRoundOff = 1e-9;
  if (!(moved > kRoundOff * command.twist.linear.norm()) && !(turned > kRoundOff * command.twist.angular.norm()))
    return;
  throw mpm::RigidError(fmt::format(
      "the velocity ({:g}, {:g}, {:g}) m/s with the rotation ({:g}, {:g}, {:g}) rad/s is not one of a {} scene: '{}' "
      "moves {}; set the rest to zero",
      command.twist.linear.x(), command.twist.linear.y(), command.twist.linear.z(), command.twist.angular.x(),
      command.twist.angular.y(), command.twist.angular.z(), mpm::geometry_name(geometry), body.name(),
      geometry == mpm::GeometryKind::line ? "along x" : "along x and z and turns about y"));
}

}  // namespace

void check_travel(const AppliedCommand& command, const mpm::Simulation& simulation) {
  check_plane(command, simulation);
  mpm::Vec3 size = simulation.definition().grid.max - simulation.definition().grid.min;
  for (const int axis : mpm::axes_beside(simulation.definition().geometry)) size[axis] = 0.0;  // nothing moves there
  const double longest = size.norm(), travel = travel_of(command, simulation);
  // Not "travel > longest": what is not a number is left to the body's own check.
  if (!(travel > longest)) return;
  throw mpm::RigidError(fmt::format(
      "it would move '{}' by {:.3g} m in one sync period of {:g} s, more than the domain's diagonal of "
      "{:.3g} m; check its units, or reach a far pose in more time",
      simulation.rigid_body(command.body).name(), travel, mpm::seconds_of(simulation.sync_period()), longest));
}

std::string jump_of(const AppliedCommand& command, const mpm::Simulation& simulation) {
  if (command.kind != CommandKind::pose) return {};
  const double cell = simulation.definition().grid.cell.minCoeff(), travel = travel_of(command, simulation);
  if (!(travel > cell)) return {};
  const double sync = mpm::seconds_of(simulation.sync_period());
  const mpm::RigidBody& body = simulation.rigid_body(command.body);
  const mpm::Vec3 &from = body.pose().position, &to = command.pose.position;
  return fmt::format(
      "'{}' jumps {:.3g} cells, from ({:.4g}, {:.4g}, {:.4g}) to ({:.4g}, {:.4g}, {:.4g}) m: the pose it is to reach "
      "by "
      "{:.6f} s asks for {:.3g} m/s, {:.3g} cells in a sync period; give it limits in the scene, or begin where it "
      "stands",
      body.name(), (to - from).norm() / cell, from.x(), from.y(), from.z(), to.x(), to.y(), to.z(),
      mpm::seconds_of(command.arrival), travel / sync, travel / cell);
}

void apply(const AppliedCommand& command, mpm::Simulation& simulation) {
  check_travel(command, simulation);
  if (command.kind == CommandKind::wrench) {
    simulation.apply_wrench(command.body, command.wrench);
    return;
  }
  if (command.kind == CommandKind::velocity) {
    simulation.command_velocity(command.body, command.twist);
  } else {
    simulation.command_pose(command.body, command.pose, command.arrival);
  }
}

std::vector<AppliedCommand> stop_commands(int body, const mpm::Simulation& simulation) {
  std::vector<AppliedCommand> commands;
  AppliedCommand stop;
  stop.body = body;
  stop.effect = simulation.time();
  const mpm::FreeMotion* free = simulation.rigid_body(body).free_motion();
  if (free == nullptr || !free->definition().all_free()) commands.push_back(stop);
  stop.kind = CommandKind::wrench;
  if (free != nullptr) commands.push_back(stop);
  return commands;
}

mpm_ros::Command to_message(const AppliedCommand& command, const std::string& body, const std::string& world_frame,
                            const Stamps& stamps) {
  mpm_ros::Command message;
  message.header.stamp = stamps.at(command.effect);
  message.header.frame_id = world_frame;
  message.body = body;
  message.kind = static_cast<std::uint8_t>(command.kind);
  message.pose.orientation.w = 1.0;
  message.requested = command.requested;
  message.stamp_ignored = command.stamp_ignored ? 1 : 0;
  message.effect_ns = command.effect;
  if (command.kind == CommandKind::velocity) {
    message.twist = to_message(command.twist);
  } else if (command.kind == CommandKind::wrench) {
    message.wrench = to_message(command.wrench);
  } else {
    message.pose = to_message(command.pose);
    message.arrival = stamps.at(command.arrival);
    message.arrival_ns = command.arrival;
  }
  return message;
}

AppliedCommand from_message(const mpm_ros::Command& message, const mpm::Simulation& simulation) {
  AppliedCommand command;
  command.body = simulation.find_commanded(message.body);
  if (command.body < 0) {
    throw BagError(fmt::format("a recorded command is for '{}', which the scene does not have", message.body));
  }
  if (message.kind != mpm_ros::Command::VELOCITY && message.kind != mpm_ros::Command::POSE &&
      message.kind != mpm_ros::Command::WRENCH) {
    throw BagError(fmt::format("a recorded command for '{}' is of unknown kind {}", message.body, message.kind));
  }
  command.kind = static_cast<CommandKind>(message.kind);
  command.twist = from_message(message.twist);
  command.wrench = from_message(message.wrench);
  command.pose = from_message(message.pose);
  command.effect = message.effect_ns;
  command.arrival = message.arrival_ns;
  command.requested = message.requested;
  command.stamp_ignored = message.stamp_ignored != 0;
  return command;
}

}  // namespace mpm_ros
