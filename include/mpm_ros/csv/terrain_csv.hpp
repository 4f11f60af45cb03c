// terrain_NNNN.csv: a map of the ground's height a file, a row for each point; terrain.csv lists the files with their
// times. No file of a run without maps.
#pragma once

#include <mpm_ros/HeightMap.h>

#include <cstdint>
#include <optional>
#include <string>

#include "mpm_ros/csv/csv_writer.hpp"

namespace mpm_ros {

class TerrainCsv {
 public:
  explicit TerrainCsv(const std::string& folder) : folder_(folder) {}
  /// `time` [s]. A point without ground has an empty cell in place of its height. @throws CsvError
  void add(double time, const HeightMap& map);
  void close();

 private:
  std::string folder_;
  std::uint64_t count_ = 0;
  std::optional<CsvWriter> index_;
};

}  // namespace mpm_ros
