#include "mpm_ros/csv/robot_csv.hpp"

#include "mpm_ros/message/conversions.hpp"
#include "mpm_ros/message/quantities.hpp"
#include "mpm_ros/message/robot_messages.hpp"

namespace mpm_ros {
namespace {

std::vector<std::string> joint_columns(const std::vector<RobotState>& robots) {
  std::vector<std::string> columns = {"time [s]"};
  for (const RobotState& robot : robots) {
    for (std::size_t j = 0; j < robot.joints.size(); ++j) {
      const std::string joint = robot.name + "/" + robot.joints[j];
      const JointUnits& units = joint_units(robot.prismatic[j] != 0);
      columns.push_back(fmt::format("{} position [{}]", joint, units.position));
      columns.push_back(fmt::format("{} velocity [{}]", joint, units.velocity));
      columns.push_back(fmt::format("{} effort [{}]", joint, units.effort));
      columns.push_back(fmt::format("{} target [{}]", joint, units.target(robot.drive[j])));
    }
    for (const JointWrench& sensor : robot.sensors) {
      const std::string joint = robot.name + "/" + sensor.joint;
      add_vector_columns(columns, joint + " f", "N");
      add_vector_columns(columns, joint + " t", "N m");
    }
  }
  return columns;
}

std::vector<std::string> robot_columns(const std::vector<RobotState>& robots) {
  std::vector<std::string> columns = {"time [s]"};
  for (const RobotState& robot : robots) {
    add_vector_columns(columns, robot.name + " ", "m");
    add_vector_columns(columns, robot.name + " q", "1");
    columns.push_back(robot.name + " qw [1]");
    add_vector_columns(columns, robot.name + " v", "m/s");
    add_vector_columns(columns, robot.name + " w", "rad/s");
    for (const RobotQuantity& one : robot_quantities())
      columns.push_back(fmt::format("{} {} [{}]", robot.name, one.column, one.unit));
  }
  return columns;
}

}  // namespace

void RobotsCsv::add(double time, const std::vector<RobotState>& robots) {
  if (robots.empty()) return;
  if (!joints_) {
    joints_.emplace(folder_ + "/joints.csv", joint_columns(robots));
    robots_.emplace(folder_ + "/robots.csv", robot_columns(robots));
  }
  *joints_ << time;
  *robots_ << time;
  for (const RobotState& robot : robots) {
    for (std::size_t j = 0; j < robot.joints.size(); ++j)
      *joints_ << robot.position[j] << robot.velocity[j] << robot.effort[j] << robot.target[j];
    for (const JointWrench& sensor : robot.sensors)
      *joints_ << from_message(sensor.wrench.force) << from_message(sensor.wrench.torque);
    const mpm::Pose base = from_message(robot.base);
    const mpm::Twist twist = from_message(robot.base_twist);
    *robots_ << base.position << mpm::Vec3(base.orientation.vec()) << base.orientation.w() << twist.linear
             << twist.angular;
    for (const RobotQuantity& one : robot_quantities()) *robots_ << std::get<double>(one.of_message(robot));
  }
  joints_->end_row();
  robots_->end_row();
}

void RobotsCsv::close() {
  if (joints_) joints_->close();
  if (robots_) robots_->close();
}

}  // namespace mpm_ros
