#include "mpm_ros/record/robot_outputs.hpp"

#include <utility>

#include "mpm_ros/message/conversions.hpp"
#include "mpm_ros/message/topics.hpp"

namespace mpm_ros {

sensor_msgs::JointState RobotOutputs::joints(const mpm::RobotReport& now, const mpm::RobotReport& last,
                                             double interval) {
  sensor_msgs::JointState message;
  for (std::size_t j = 0; j < now.joints.size(); ++j) {
    const mpm::JointReport& joint = now.joints[j];
    message.name.push_back(joint.name);
    message.position.push_back(joint.position);
    message.velocity.push_back(joint.velocity);
    message.effort.push_back(interval > 0.0 ? (joint.impulse - last.joints[j].impulse) / interval : 0.0);
  }
  return message;
}

std::vector<SensorMessage> RobotOutputs::sensors(const mpm::RobotReport& now, const mpm::RobotReport& last,
                                                 double interval) {
  std::vector<SensorMessage> messages;
  for (std::size_t s = 0; s < now.sensors.size(); ++s) {
    const mpm::SensorReport& sensor = now.sensors[s];
    mpm::Wrench mean;
    if (interval > 0.0) {
      mean.force = (sensor.impulse.force - last.sensors[s].impulse.force) / interval;
      mean.torque = (sensor.impulse.torque - last.sensors[s].impulse.torque) / interval;
    }
    messages.push_back(
        {topics::of_robot(now.name, "sensors/" + sensor.joint + "/wrench"), sensor.link, to_message(mean)});
  }
  return messages;
}

std::vector<mpm::BodyState> RobotOutputs::bases(const std::vector<mpm::RobotDefinition>& robots,
                                                const std::vector<mpm::RobotReport>& now,
                                                const std::string& world_frame) {
  std::vector<mpm::BodyState> bases;
  for (std::size_t robot = 0; robot < robots.size(); ++robot) {
    mpm::BodyState base;
    base.name = robots[robot].model.links.front().name;
    base.pose = now[robot].base;
    if (base.name != world_frame) bases.push_back(base);
  }
  return bases;
}

RobotOutputs::Interval RobotOutputs::take(std::vector<mpm::RobotReport> now, double time) {
  if (last_.empty()) last_ = now;
  Interval interval{std::move(now), std::move(last_), time - time_};
  last_ = interval.now;
  time_ = time;
  return interval;
}

void RobotOutputs::serialise(mpm::StateArchive& archive) {
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
