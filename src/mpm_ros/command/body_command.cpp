#include "mpm_ros/command/body_command.hpp"

#include <fmt/format.h>

#include "mpm_ros/message/bag_error.hpp"
#include "mpm_ros/message/conversions.hpp"

namespace mpm_ros {

void apply(const AppliedCommand& command, mpm::Simulation& simulation) {
  if (command.kind == CommandKind::velocity) {
    simulation.command_velocity(command.body, command.twist);
  } else {
    simulation.command_pose(command.body, command.pose, command.arrival);
  }
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
  message.effect_ns = command.effect;
  if (command.kind == CommandKind::velocity) {
    message.twist = to_message(command.twist);
  } else {
    message.pose = to_message(command.pose);
    message.arrival = stamps.at(command.arrival);
    message.arrival_ns = command.arrival;
  }
  return message;
}

AppliedCommand from_message(const mpm_ros::Command& message, const mpm::Simulation& simulation) {
  AppliedCommand command;
  command.body = simulation.find_body(message.body);
  if (command.body < 0) {
    throw BagError(fmt::format("a recorded command is for '{}', which the scene does not have", message.body));
  }
  if (message.kind != mpm_ros::Command::VELOCITY && message.kind != mpm_ros::Command::POSE) {
    throw BagError(fmt::format("a recorded command for '{}' is of unknown kind {}", message.body, message.kind));
  }
  command.kind = static_cast<CommandKind>(message.kind);
  command.twist = from_message(message.twist);
  command.pose = from_message(message.pose);
  command.effect = message.effect_ns;
  command.arrival = message.arrival_ns;
  command.requested = message.requested;
  return command;
}

}  // namespace mpm_ros
