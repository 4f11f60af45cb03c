// Robots in a report: tables of joints, sensors and energies, and the same as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "mpm_ros/report/robot_statistics.hpp"

namespace mpm_ros {

/// A table of which no robot has anything is left out.
std::string robot_tables(const std::vector<RobotStatistics>& robots);

/// By name; doc/analysis.md lists the keys.
nlohmann::ordered_json robots_json(const std::vector<RobotStatistics>& robots);

}  // namespace mpm_ros
