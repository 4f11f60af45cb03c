// A sweep as a table: a row a run, with its parameters, its metrics, and how it ended.
#pragma once

#include <string>
#include <vector>

#include "mpm_ros/sweep/study.hpp"

namespace mpm_ros {

struct SweepTable {
  /// "run", the paths of parameters with their unit ("materials.sand.young [MPa]") where all values have the same one,
  /// names of metrics, "state", "reason".
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
  std::size_t parameters = 0, metrics = 0;  ///< numbers of the columns that they are
  int done = 0, failed = 0, stopped = 0, open = 0;

  int runs() const { return done + failed + stopped + open; }
  /// "198 done, 2 failed"
  std::string counts() const;
};

/// Reads the plan and the results of a study. @throws mpm::Error
SweepTable read_sweep(const Study& study);
/// Writes it as CSV, whole or not at all. @throws SweepError
void write_sweep(const SweepTable& table, const std::string& path);

}  // namespace mpm_ros
