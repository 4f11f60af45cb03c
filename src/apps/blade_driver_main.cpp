// Commands a rigid body over a topic, in simulated time: a list of phases, each a trapezoid of velocity.
//
// Private parameters: ~phases, a list of {name, begin, end, ramp, linear: [3], angular: [3]} in s, m/s and rad/s (world
// axes; overlapping phases add up); ~topic; ~frame_id; ~period [s] between commands; ~lead [s], the simulated time by
// which a command is sent before it takes effect, so that it arrives in time.
#include <geometry_msgs/TwistStamped.h>
#include <ros/ros.h>
#include <xmlrpcpp/XmlRpcException.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "mpm_ros/node/master.hpp"
#include "mpm_ros/node/parameter_sources.hpp"

namespace {

struct Phase {
  std::string name;
  double begin = 0.0;  // [s]
  double end = 0.0;
  double ramp = 0.0;              // [s] duration from rest to full speed, and back
  std::array<double, 6> twist{};  // linear [m/s], angular [rad/s], at full speed

  double share(double time) const { return std::clamp(std::min(time - begin, end - time) / ramp, 0.0, 1.0); }
};

double number(const XmlRpc::XmlRpcValue& value) {
  const std::optional<double> number = mpm_ros::number_of(value);
  if (!number) throw std::runtime_error("something else than a number stands where one is wanted");
  return *number;
}

void read_vector(XmlRpc::XmlRpcValue& phase, const char* key, double* result) {
  if (!phase.hasMember(key)) return;
  if (phase[key].size() != 3) throw std::runtime_error(std::string(key) + " has not three components");
  for (int i = 0; i < 3; ++i) result[i] = number(phase[key][i]);
}

std::vector<Phase> read_phases(mpm_ros::ParameterReader& parameters) {
  const XmlRpc::XmlRpcValue* given = parameters.find("phases");
  if (given == nullptr) throw std::runtime_error("it is not given; see the launch file");
  XmlRpc::XmlRpcValue list(*given);
  if (list.getType() != XmlRpc::XmlRpcValue::TypeArray)
    throw std::runtime_error("it is not a list; see the launch file");
  std::vector<Phase> phases;
  for (int i = 0; i < list.size(); ++i) {
    XmlRpc::XmlRpcValue& value = list[i];
    Phase phase;
    phase.name = static_cast<std::string>(value["name"]);
    phase.begin = number(value["begin"]);
    phase.end = number(value["end"]);
    phase.ramp = number(value["ramp"]);
    read_vector(value, "linear", phase.twist.data());
    read_vector(value, "angular", phase.twist.data() + 3);
    if (!(phase.ramp > 0.0 && phase.end > phase.begin)) throw std::runtime_error("end <= begin, or ramp <= 0");
    phases.push_back(phase);
  }
  return phases;
}

std::array<double, 6> twist_at(const std::vector<Phase>& phases, double time) {
  std::array<double, 6> twist{};
  for (const Phase& phase : phases) {
    const double share = phase.share(time);
    for (std::size_t i = 0; i < twist.size(); ++i) twist[i] += share * phase.twist[i];
  }
  return twist;
}

struct Settings {
  std::vector<Phase> phases;
  double period = 0.01;  // [s] between commands
  double lead = 0.1;     // [s]
  std::string frame_id = "world", topic = "bodies/blade/cmd_vel_stamped";
};

Settings read_settings(const mpm_ros::ParameterSources& sources) {
  const mpm_ros::ForgetParameters forget(sources);
  const mpm_ros::ParameterValues values = mpm_ros::fetch_parameters(ros::NodeHandle("~"));
  mpm_ros::ParameterReader parameters(values);
  Settings settings;
  parameters.read("period", settings.period, 0.0, true);
  parameters.read("lead", settings.lead, 0.0);
  parameters.read("frame_id", settings.frame_id);
  parameters.read("topic", settings.topic);
  try {
    settings.phases = read_phases(parameters);
  } catch (const std::runtime_error& error) {
    mpm_ros::ParameterReader::fail("phases", std::string("cannot be used: ") + error.what());
  } catch (const XmlRpc::XmlRpcException& error) {
    mpm_ros::ParameterReader::fail("phases", "cannot be used: " + error.getMessage());
  }
  for (const std::string& line : parameters.unknown()) ROS_WARN_STREAM(line);
  return settings;
}

}  // namespace

int main(int argc, char** argv) {
  const mpm_ros::ParameterSources sources(argc, argv);
  if (const auto refused = mpm_ros::begin_ros(argc, argv, "blade_driver")) return *refused;
  ros::NodeHandle node;
  Settings settings;
  try {
    settings = read_settings(sources);
  } catch (const mpm_ros::ParameterError& error) {
    ROS_FATAL_STREAM(error.what());
    return 2;
  }
  const std::vector<Phase>& phases = settings.phases;
  const double period = settings.period, lead = settings.lead;
  double end = 0.0;
  for (const Phase& phase : phases) end = std::max(end, phase.end);

  geometry_msgs::TwistStamped command;
  command.header.frame_id = settings.frame_id;
  ros::Publisher publisher = node.advertise<geometry_msgs::TwistStamped>(settings.topic, 100);

  // Simulated time starts with the run; without use_sim_time, time starts when the clock is first read.
  const ros::Time start = ros::Time::isSimTime() ? ros::Time() : ros::Time::now();
  std::int64_t next = 1;
  double last = 0.0;
  for (ros::WallRate rate(500.0); ros::ok(); rate.sleep()) {
    const double now = (ros::Time::now() - start).toSec();
    if (publisher.getNumSubscribers() == 0 || now <= 0.0) continue;
    if (now < last) next = 1;  // the run was reset
    last = now;
    // Before the first command the body follows the scene. Commands for past times are not sent.
    next = std::max(next, static_cast<std::int64_t>(now / period) + 1);
    for (; static_cast<double>(next) * period <= std::min(now + lead, end); ++next) {
      const double time = static_cast<double>(next) * period;
      for (const Phase& phase : phases) {
        if (std::max(1LL, std::llround(phase.begin / period)) == next) ROS_INFO("%s", phase.name.c_str());
      }
      const std::array<double, 6> twist = twist_at(phases, time + 0.5 * period);
      command.header.stamp = start + ros::Duration(time);
      command.twist.linear.x = twist[0];
      command.twist.linear.y = twist[1];
      command.twist.linear.z = twist[2];
      command.twist.angular.x = twist[3];
      command.twist.angular.y = twist[4];
      command.twist.angular.z = twist[5];
      publisher.publish(command);
    }
    if (now > end) break;
  }
  return 0;
}
