#include "mpm_ros/report/report_messages.hpp"

#include "mpm/math/nanoseconds.hpp"
#include "mpm_ros/message/conversions.hpp"

namespace mpm_ros {

std::vector<mpm::BodyState> body_states_of(const BodyStates& message) {
  std::vector<mpm::BodyState> states;
  for (const BodyState& body : message.bodies) {
    states.push_back(
        {body.name, from_message(body.pose), from_message(body.twist), static_cast<mpm::Drive>(body.drive), body.mass});
  }
  return states;
}

std::string command_kind_name(std::uint8_t kind) {
  if (kind == Command::WRENCH) return "wrench";
  return kind == Command::POSE ? "pose" : "velocity";
}

CommandRow command_row_of(std::int64_t time, const Command& message) {
  CommandRow row;
  row.time = mpm::nearest_seconds(time);
  row.body = message.body;
  row.kind = command_kind_name(message.kind);
  row.wrench = from_message(message.wrench);
  row.twist = from_message(message.twist);
  row.pose = from_message(message.pose);
  row.arrival = mpm::nearest_seconds(message.arrival_ns);
  return row;
}

}  // namespace mpm_ros
