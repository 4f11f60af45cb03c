#include "mpm_ros/record/robot_outputs.hpp"

#include <utility>

#include "mpm/math/nanoseconds.hpp"
#include "mpm_ros/message/robot_messages.hpp"
#include "mpm_ros/message/topics.hpp"

namespace mpm_ros {

void RobotOutputs::write() {
  written_at_ = simulation_.time();
  if (simulation_.definition().robots.empty()) return;
  std::vector<mpm::RobotReport> now = simulation_.robots();
  if (last_.empty()) last_ = now;
  const double time = mpm::seconds_of(simulation_.time());
  put(now, last_, time - time_);
  last_ = std::move(now);
  time_ = time;
}

void RobotOutputs::write_present() {
  if (simulation_.definition().robots.empty()) return;
  const std::vector<mpm::RobotReport> now = simulation_.robots();
  put(now, now, 0.0);
}

void RobotOutputs::put(const std::vector<mpm::RobotReport>& now, const std::vector<mpm::RobotReport>& start,
                       double interval) {
  RobotStates message;
  message.header = sinks_.header();
  message.robots = to_message(now, start, interval);
  for (const RobotState& robot : message.robots) {
    const std::string joints = topics::of_robot(robot.name, topics::kJointStates);
    if (sinks_.wanted(joints)) {
      sensor_msgs::JointState state = joint_state_of(robot);
      state.header = sinks_.header({});
      sinks_.put(joints, state);
    }
    for (const JointWrench& sensor : robot.sensors) {
      const std::string topic = topics::of_robot(robot.name, "sensors/" + sensor.joint + "/wrench");
      if (!sinks_.wanted(topic)) continue;
      geometry_msgs::WrenchStamped wrench;
      wrench.header = sinks_.header(sensor.link);
      wrench.wrench = sensor.wrench;
      sinks_.put(topic, wrench);
    }
  }
  if (sinks_.wanted(topics::kRobots)) sinks_.put(topics::kRobots, message);
}

std::vector<mpm::BodyState> RobotOutputs::bases(const std::string& world_frame) const {
  const std::vector<mpm::RobotDefinition>& robots = simulation_.definition().robots;
  std::vector<mpm::BodyState> bases;
  if (robots.empty()) return bases;
  const std::vector<mpm::RobotReport> now = simulation_.robots();
  for (std::size_t robot = 0; robot < robots.size(); ++robot) {
    mpm::BodyState base;
    base.name = robots[robot].model.links.front().name;
    base.pose = now[robot].base;
    if (base.name != world_frame) bases.push_back(base);
  }
  return bases;
}

void RobotOutputs::serialise(mpm::StateArchive& archive) {
  if (simulation_.definition().robots.empty()) return;
  const mpm::StateArchive::Group group(archive, "robots");
  if (archive.reading()) last_ = simulation_.robots();
  archive.value("time", time_);
  std::vector<double> impulses;
  for (const mpm::RobotReport& robot : last_) {
    for (const mpm::JointReport& joint : robot.joints) impulses.push_back(joint.impulse);
    for (const mpm::SensorReport& sensor : robot.sensors) {
      for (int k = 0; k < 3; ++k) impulses.push_back(sensor.impulse.force[k]);
      for (int k = 0; k < 3; ++k) impulses.push_back(sensor.impulse.torque[k]);
    }
  }
  archive.list("impulses", impulses);
  std::size_t next = 0;
  const auto read = [&](double& into) {
    if (next < impulses.size()) into = impulses[next];
    ++next;
  };
  for (mpm::RobotReport& robot : last_) {
    for (mpm::JointReport& joint : robot.joints) read(joint.impulse);
    for (mpm::SensorReport& sensor : robot.sensors) {
      for (int k = 0; k < 3; ++k) read(sensor.impulse.force[k]);
      for (int k = 0; k < 3; ++k) read(sensor.impulse.torque[k]);
    }
  }
}

}  // namespace mpm_ros
