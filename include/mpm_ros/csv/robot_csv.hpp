// joints.csv: position, velocity, effort and target of each joint, wrenches of sensors; robots.csv: base and energies
// of each robot. No file of a scene without robots.
#pragma once

#include <mpm_ros/RobotState.h>

#include <optional>
#include <string>
#include <vector>

#include "mpm_ros/csv/csv_writer.hpp"

namespace mpm_ros {

class RobotsCsv {
 public:
  explicit RobotsCsv(const std::string& folder) : folder_(folder) {}
  /// `time` [s] is the end of the interval; robots, joints and their order are those of the first row. @throws CsvError
  void add(double time, const std::vector<RobotState>& robots);
  void close();

 private:
  std::string folder_;
  std::optional<CsvWriter> joints_, robots_;
};

}  // namespace mpm_ros
