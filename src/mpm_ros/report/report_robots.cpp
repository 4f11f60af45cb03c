#include "mpm_ros/report/report_robots.hpp"

#include <nlohmann/json.hpp>

#include "mpm/math/nanoseconds.hpp"
#include "mpm/robot/definition.hpp"
#include "mpm_ros/message/quantities.hpp"
#include "mpm_ros/message/robot_messages.hpp"
#include "mpm_ros/report/report_json.hpp"
#include "mpm_ros/report/report_tables.hpp"

namespace mpm_ros {
namespace {

using Json = nlohmann::ordered_json;

std::string drive_name(std::uint8_t drive) {
  return drive < mpm::kJointDriveNames.size() ? mpm::kJointDriveNames[drive] : "unknown";
}

std::string joint_table(const std::vector<RobotStatistics>& robots) {
  TextTable table({"joint", "drive", "", "start", "end", "least", "most", "largest", "at [s]"});
  const auto row = [&table](const std::string& joint, const std::string& drive, const std::string& what,
                            const NumberRange& range) {
    table.add({joint, drive, what, number(range.first), number(range.last), number(range.least), number(range.most),
               number(range.largest), number(mpm::nearest_seconds(range.time))});
  };
  bool any = false;
  for (const RobotStatistics& robot : robots) {
    for (const JointStatistics& joint : robot.joints) {
      any = true;
      const std::string name = robot.name() + "/" + joint.name;
      const JointUnits& units = joint_units(joint.prismatic);
      row(name, drive_name(joint.drive), "position [" + units.position + "]", joint.position);
      row(name, "", "velocity [" + units.velocity + "]", joint.velocity);
      row(name, "", "effort [" + units.effort + "]", joint.effort);
    }
  }
  if (!any) return {};
  return "Robots: joints; efforts of the drives are means between two messages\n" + table.text();
}

std::string sensor_table(const std::vector<RobotStatistics>& robots) {
  TextTable table({"sensor", "", "size", "x  y  z", "at [s]"});
  bool any = false;
  for (const RobotStatistics& robot : robots) {
    for (const SensorStatistics& sensor : robot.sensors) {
      any = true;
      for (const auto& [what, peak] : {std::pair("peak |F| [N]", &sensor.force), {"peak |T| [N m]", &sensor.torque}}) {
        table.add({robot.name() + "/" + sensor.joint, what, number(peak->norm), triple(peak->vector),
                   number(mpm::nearest_seconds(peak->time))});
      }
    }
  }
  if (!any) return {};
  return "Sensors: wrench through a joint to its child, in the child's axes\n" + table.text();
}

/// Those that are zero from start to end are left out.
std::string energy_table(const std::vector<RobotStatistics>& robots) {
  TextTable table({"energy [J]", "", "start", "end", "change"});
  for (const RobotStatistics& robot : robots) {
    const std::vector<EnergyFigure> first = energies_of(robot.first), last = energies_of(robot.last);
    for (std::size_t i = 0; i < last.size(); ++i) {
      const double start = first[i].value, end = last[i].value;
      if (start != 0.0 || end != 0.0)
        table.add({robot.name(), last[i].heading, number(start), number(end), number(end - start)});
    }
  }
  return "Energies of robots\n" + table.text();
}

Json range_json(const NumberRange& range) {
  return {{"start", range.first}, {"end", range.last}, {"min", range.least}, {"max", range.most}};
}

Json peak_json(const NumberRange& range) {
  return {{"value", range.largest}, {"time", mpm::nearest_seconds(range.time)}};
}

Json energy_json(const RobotState& robot) {
  Json json;
  for (const EnergyFigure& energy : energies_of(robot)) json[energy.key] = energy.value;
  return json;
}

}  // namespace

std::string robot_tables(const std::vector<RobotStatistics>& robots) {
  if (robots.empty()) return {};
  return joint_table(robots) + sensor_table(robots) + energy_table(robots) + "\n";
}

Json robots_json(const std::vector<RobotStatistics>& robots) {
  Json json = Json::object();
  for (const RobotStatistics& robot : robots) {
    Json& one = json[robot.name()];
    one["joints"] = Json::object();
    one["sensors"] = Json::object();
    for (const JointStatistics& joint : robot.joints) {
      one["joints"][joint.name] = {{"unit", joint_units(joint.prismatic).position},
                                   {"drive", drive_name(joint.drive)},
                                   {"position", range_json(joint.position)},
                                   {"velocity", range_json(joint.velocity)},
                                   {"effort", range_json(joint.effort)},
                                   {"peak_velocity", peak_json(joint.velocity)},
                                   {"peak_effort", peak_json(joint.effort)}};
    }
    for (const SensorStatistics& sensor : robot.sensors) {
      one["sensors"][sensor.joint] = {
          {"link", sensor.link}, {"peak_force", json_of(sensor.force)}, {"peak_torque", json_of(sensor.torque)}};
    }
    one["energy"] = {{"start", energy_json(robot.first)}, {"end", energy_json(robot.last)}};
  }
  return json;
}

}  // namespace mpm_ros
