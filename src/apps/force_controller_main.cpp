// Presses a rigid body down into soft material until it meets a target force: admittance control, an example to copy.
//
// The body moves down at a speed proportional to the missing force, gain * (target - force), up to a limit; the force
// is the mean of the last control period, filtered by a first-order low-pass. Weak: the material's stiffness is in the
// loop, which is slow where the stiffness is low and oscillates where gain * stiffness * (period + filter) approaches
// 1.
//
// In lockstep each control period is a call of the simulator's service `step` with the command in it: no message can be
// late, and two runs are equal to the bit. Otherwise it subscribes to bodies/<body>/wrench (the mean of a period: start
// the simulator with ~wrench_rate at 1/~period) and answers each message on bodies/<body>/cmd_vel_stamped, ~lead ahead.
//
// Private parameters: ~body; ~target [N]; ~gain [m/s/N]; ~max_speed [m/s]; ~filter [s], time constant; ~lockstep;
// ~period [s] of control; ~lead [s]; ~duration [s] of simulated time, 0: unlimited; ~tolerance and ~hold [s]: the force
// has settled when it was within tolerance * target for the time hold.
// Exit codes, when ~duration is over: 0 settled, 1 not settled or no simulator, 2 a parameter that makes no sense.
#include <geometry_msgs/TwistStamped.h>
#include <geometry_msgs/WrenchStamped.h>
#include <mpm_ros/Step.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "mpm_ros/node/master.hpp"
#include "mpm_ros/node/parameter_sources.hpp"

namespace {

struct Settings {
  bool lockstep = true;
  std::string body = "probe";
  double target = 10.0, gain = 0.01, max_speed = 0.05, filter = 0.02, period = 0.01, lead = 0.02, duration = 0.0,
         tolerance = 0.02, hold = 1.0;
};

Settings read_settings(mpm_ros::ParameterReader& parameters) {
  Settings settings;
  parameters.read("lockstep", settings.lockstep);
  parameters.read("body", settings.body);
  parameters.read("target", settings.target, 0.0, true);
  parameters.read("gain", settings.gain, 0.0, true);
  parameters.read("max_speed", settings.max_speed, 0.0, true);
  parameters.read("filter", settings.filter, 0.0);
  parameters.read("period", settings.period, 0.0, true);
  parameters.read("lead", settings.lead, 0.0);
  parameters.read("duration", settings.duration, 0.0);
  parameters.read("tolerance", settings.tolerance, 0.0, true);
  parameters.read("hold", settings.hold, 0.0, true);
  return settings;
}

class Controller {
 public:
  explicit Controller(const Settings& settings)
      : settings_(settings), share_(settings.period / (settings.period + settings.filter)) {}

  /// Velocity along z [m/s] for the coming period; `force`: upward force on the body, the mean of the last period [N].
  double update(double force) {
    filtered_ += share_ * (force - filtered_);
    const double down = settings_.gain * (settings_.target - filtered_);
    return -std::clamp(down, -settings_.max_speed, settings_.max_speed);
  }

 private:
  const Settings& settings_;
  const double share_;  // weight of a new value in the filter
  double filtered_ = 0.0;
};

/// The history of the force over simulated time.
class Record {
 public:
  explicit Record(const Settings& settings) : settings_(settings) {}

  void add(double time, double force) {
    if (time < time_) *this = Record(settings_);  // the simulator was reset
    if (start_ < 0.0) start_ = time;
    if (touch_ < 0.0 && force > 0.0) touch_ = time;
    if (std::abs(force - settings_.target) > settings_.tolerance * settings_.target) outside_ = time;
    time_ = time;
    force_ = force;
    largest_ = std::max(largest_, force);
    ROS_INFO_THROTTLE(1.0, "%.2f s: %.3f N of %g N", time_, force_, settings_.target);
  }

  bool over() const { return settings_.duration > 0.0 && time_ - start_ >= settings_.duration; }

  /// Reports the result and returns the exit code.
  int judge() const {
    if (touch_ < 0.0) {
      ROS_ERROR("the body has touched nothing in %.2f s", time_ - start_);
      return 1;
    }
    const double overshoot = 100.0 * std::max(0.0, largest_ / settings_.target - 1.0);
    const bool settled = time_ - outside_ >= settings_.hold;
    ROS_INFO("%.3f N of %g N after %.2f s; %s within %g %%, %.2f s after touch; overshoot %.1f %%", force_,
             settings_.target, time_ - start_, settled ? "settled" : "not settled", 100.0 * settings_.tolerance,
             outside_ - touch_, overshoot);
    return settled ? 0 : 1;
  }

 private:
  Settings settings_;
  double start_ = -1.0, touch_ = -1.0;  // time of the first message, and of the first force above zero [s]
  double outside_ = 0.0;                // last time out of tolerance [s]
  double time_ = 0.0, force_ = 0.0, largest_ = 0.0;
};

double force_on(const std::string& body, const mpm_ros::ContactForces& contacts) {
  for (const mpm_ros::ContactForce& contact : contacts.bodies) {
    if (contact.name == body) return contact.wrench.force.z;
  }
  throw std::runtime_error("the scene has no rigid body '" + body + "'; set ~body");
}

int control_in_lockstep(ros::NodeHandle& node, const Settings& settings) {
  // Waits in wall time: in lockstep simulated time stands still until the first step, and so would a wait in it.
  const std::string name = node.resolveName("step");
  while (ros::ok() && !ros::service::exists(name, false)) ros::WallDuration(0.05).sleep();
  ros::ServiceClient service = node.serviceClient<mpm_ros::Step>(name, true);  // one connection for all calls
  Controller controller(settings);
  Record record(settings);
  mpm_ros::Step step;
  step.request.duration = settings.period;
  step.request.commands.resize(1);
  step.request.commands[0].body = settings.body;
  step.request.commands[0].kind = mpm_ros::Command::VELOCITY;
  double force = 0.0;
  while (ros::ok() && !record.over()) {
    step.request.commands[0].twist.linear.z = controller.update(force);
    if (!service.call(step)) throw std::runtime_error("the simulator has gone: " + name + " does not answer");
    if (!step.response.success) throw std::runtime_error(name + ": " + step.response.message);
    force = force_on(settings.body, step.response.contact_forces);
    record.add(step.response.time, force);
  }
  return record.judge();
}

int control_by_topics(ros::NodeHandle& node, const Settings& settings) {
  Controller controller(settings);
  Record record(settings);
  const std::string topics = "bodies/" + settings.body + "/";
  geometry_msgs::TwistStamped command;
  command.header.frame_id = "world";
  ros::Publisher publisher = node.advertise<geometry_msgs::TwistStamped>(topics + "cmd_vel_stamped", 10);
  const auto answer = [&](const geometry_msgs::WrenchStamped::ConstPtr& message) {
    command.header.stamp = message->header.stamp + ros::Duration(settings.lead);
    command.twist.linear.z = controller.update(message->wrench.force.z);
    publisher.publish(command);
    record.add(message->header.stamp.toSec(), message->wrench.force.z);
  };
  const ros::Subscriber subscriber = node.subscribe<geometry_msgs::WrenchStamped>(
      topics + "wrench", 10, answer, ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay());
  while (ros::ok() && !record.over()) {
    ros::getGlobalCallbackQueue()->callOne(ros::WallDuration(0.1));
    if (subscriber.getNumPublishers() == 0) {
      ROS_WARN_THROTTLE(5.0, "nobody publishes %s", subscriber.getTopic().c_str());
    }
  }
  command.header.stamp = ros::Time();  // at once
  command.twist.linear.z = 0.0;
  publisher.publish(command);
  return record.judge();
}

}  // namespace

int main(int argc, char** argv) {
  const mpm_ros::ParameterSources sources(argc, argv);
  if (const auto refused = mpm_ros::begin_ros(argc, argv, "force_controller")) return *refused;
  ros::NodeHandle node;
  Settings settings;
  try {
    const mpm_ros::ForgetParameters forget(sources);
    const mpm_ros::ParameterValues values = mpm_ros::fetch_parameters(ros::NodeHandle("~"));
    mpm_ros::ParameterReader parameters(values);
    settings = read_settings(parameters);
    for (const std::string& line : parameters.unknown()) ROS_WARN_STREAM(line);
  } catch (const std::runtime_error& error) {
    ROS_FATAL_STREAM(error.what());
    return 2;
  }
  try {
    return settings.lockstep ? control_in_lockstep(node, settings) : control_by_topics(node, settings);
  } catch (const std::runtime_error& error) {
    ROS_FATAL_STREAM(error.what());
    return 1;
  }
}
