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

namespace {

/// @throws BagError when an effect comes before that of the one before it
template <class Message>
void check_order(const std::vector<Message>& commands) {
  for (std::size_t i = 1; i < commands.size(); ++i) {
    if (commands[i].effect_ns < commands[i - 1].effect_ns) {
      throw BagError(
          fmt::format("command {} takes effect before the one it follows; the log holds more than one run", i));
    }
  }
}

/// The commands from `next` on whose time has come, as `read` makes them. `who`: whom a command is for.
template <class Taken, class Message, class Who, class Read>
std::vector<Taken> take_due(const std::vector<Message>& commands, std::size_t& next, std::int64_t now, Who&& who,
                            Read&& read) {
  std::vector<Taken> due;
  for (; next < commands.size() && commands[next].effect_ns <= now; ++next) {
    const Message& command = commands[next];
    if (command.effect_ns != now) {
      throw BagError(
          fmt::format("a recorded command for '{}' took effect at {} ns, which is no sync point of this run; "
                      "use the scene that was recorded",
                      who(command), command.effect_ns));
    }
    due.push_back(read(command));
  }
  return due;
}

template <class Message>
std::size_t first_at(const std::vector<Message>& commands, std::int64_t time) {
  std::size_t next = 0;
  while (next < commands.size() && commands[next].effect_ns < time) ++next;
  return next;
}

}  // namespace

CommandLog::CommandLog(std::vector<mpm_ros::Command> commands, std::vector<mpm_ros::JointCommand> joints,
                       std::vector<mpm_ros::StateSet> states)
    : commands_(std::move(commands)), joints_(std::move(joints)), states_(std::move(states)) {
  check_order(commands_);
  check_order(joints_);
  check_order(states_);
}

std::vector<AppliedCommand> CommandLog::take(const mpm::Simulation& simulation) {
  return take_due<AppliedCommand>(
      commands_, next_, simulation.time(), [](const mpm_ros::Command& command) { return command.body; },
      [&](const mpm_ros::Command& command) { return from_message(command, simulation); });
}

std::vector<JointOrder> CommandLog::take_joints(const mpm::Simulation& simulation) {
  return take_due<JointOrder>(
      joints_, next_joint_, simulation.time(), [](const mpm_ros::JointCommand& command) { return command.robot; },
      [&](const mpm_ros::JointCommand& command) { return from_message(command, simulation); });
}

std::vector<mpm::StateSet> CommandLog::take_states(const mpm::Simulation& simulation) {
  return take_due<mpm::StateSet>(
      states_, next_state_, simulation.time(), [](const mpm_ros::StateSet& state) { return state.model_name; },
      [](const mpm_ros::StateSet& state) { return from_message(state); });
}

void CommandLog::skip_to(std::int64_t time) {
  next_ = first_at(commands_, time);
  next_joint_ = first_at(joints_, time);
  next_state_ = first_at(states_, time);
}

CommandLog read_commands(const std::string& bag_path) {
  std::vector<mpm_ros::Command> commands;
  std::vector<mpm_ros::JointCommand> joints;
  std::vector<mpm_ros::StateSet> states;
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
      rosbag::View joint_view(bag, rosbag::TypeQuery(ros::message_traits::datatype<mpm_ros::JointCommand>()));
      for (const rosbag::MessageInstance& instance : joint_view) {
        if (const auto command = instance.instantiate<mpm_ros::JointCommand>()) joints.push_back(*command);
      }
      rosbag::View state_view(bag, rosbag::TypeQuery(ros::message_traits::datatype<mpm_ros::StateSet>()));
      for (const rosbag::MessageInstance& instance : state_view) {
        if (const auto state = instance.instantiate<mpm_ros::StateSet>()) states.push_back(*state);
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
  if (commands.empty() && joints.empty() && states.empty()) {
    throw BagError(fmt::format("bag {} holds no commands (mpm_ros/Command, JointCommand or StateSet)", bag_path));
  }
  return CommandLog(std::move(commands), std::move(joints), std::move(states));
}

}  // namespace mpm_ros
