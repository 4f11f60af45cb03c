#include "mpm_ros/command/command_log.hpp"

#include <fmt/format.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include <new>
#include <stdexcept>
#include <utility>

#include "mpm/math/input_file.hpp"
#include "mpm_ros/message/bag_damage.hpp"
#include "mpm_ros/message/bag_error.hpp"
#include "mpm_ros/message/bag_parts.hpp"

namespace mpm_ros {

CommandLog::CommandLog(std::vector<mpm_ros::Command> commands) : commands_(std::move(commands)) {
  for (std::size_t i = 1; i < commands_.size(); ++i) {
    if (commands_[i].effect_ns < commands_[i - 1].effect_ns) {
      throw BagError(
          fmt::format("command {} takes effect before the one it follows; the log holds more than one run", i));
    }
  }
}

std::vector<AppliedCommand> CommandLog::take(const mpm::Simulation& simulation) {
  std::vector<AppliedCommand> due;
  for (; next_ < commands_.size() && commands_[next_].effect_ns <= simulation.time(); ++next_) {
    const mpm_ros::Command& command = commands_[next_];
    if (command.effect_ns != simulation.time()) {
      throw BagError(
          fmt::format("a recorded command for '{}' took effect at {} ns, which is no sync point of this run; "
                      "use the scene that was recorded",
                      command.body, command.effect_ns));
    }
    due.push_back(from_message(command, simulation));
  }
  return due;
}

void CommandLog::skip_to(std::int64_t time) {
  for (next_ = 0; next_ < commands_.size() && commands_[next_].effect_ns < time;) ++next_;
}

CommandLog read_commands(const std::string& bag_path) {
  std::vector<mpm_ros::Command> commands;
  try {
    for (const std::string& part : parts_of(bag_path)) {
      if (const std::string refused = mpm::refused_input(part); !refused.empty())
        throw BagError(fmt::format("bag {}: {}", part, refused));
      if (const std::string damage = bag_damage(part); !damage.empty())
        throw BagError(fmt::format("bag {}: {}", part, damage));
      rosbag::Bag bag(part, rosbag::bagmode::Read);
      rosbag::View view(bag, rosbag::TypeQuery(ros::message_traits::datatype<mpm_ros::Command>()));
      for (const rosbag::MessageInstance& instance : view) {
        if (const auto command = instance.instantiate<mpm_ros::Command>()) commands.push_back(*command);
      }
    }
  } catch (const ros::Exception& error) {
    throw BagError(fmt::format("bag {} cannot be read: {}", bag_path, error.what()));
  } catch (const std::bad_alloc&) {
    throw BagError(
        fmt::format("bag {} is damaged: a command in it says to be longer than there is memory for", bag_path));
  } catch (const std::length_error&) {
    throw BagError(
        fmt::format("bag {} is damaged: a command in it says to be longer than there is memory for", bag_path));
  }
  if (commands.empty()) throw BagError(fmt::format("bag {} holds no commands (mpm_ros/Command)", bag_path));
  return CommandLog(std::move(commands));
}

}  // namespace mpm_ros
