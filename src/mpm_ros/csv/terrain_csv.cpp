#include "mpm_ros/csv/terrain_csv.hpp"

#include <cmath>

namespace mpm_ros {

void TerrainCsv::add(double time, const HeightMap& map) {
  if (!index_) {
    index_.emplace(folder_ + "/terrain.csv",
                   std::vector<std::string>{"file", "time [s]", "columns [1]", "rows [1]", "resolution [m]"});
  }
  const std::string file = fmt::format("terrain_{:04}.csv", count_++);
  CsvWriter writer(folder_ + "/" + file, {"x [m]", "y [m]", "height [m]"});
  std::size_t at = 0;
  for (std::uint32_t row = 0; row < map.rows; ++row) {
    for (std::uint32_t column = 0; column < map.columns; ++column) {
      writer << map.origin.x + column * map.resolution << map.origin.y + row * map.resolution;
      const double height = map.origin.z + static_cast<double>(map.heights.at(at++));
      std::isnan(height) ? writer << std::string() : writer << height;
      writer.end_row();
    }
  }
  writer.close();
  *index_ << file << time << static_cast<std::uint64_t>(map.columns) << static_cast<std::uint64_t>(map.rows)
          << map.resolution;
  index_->end_row();
}

void TerrainCsv::close() {
  if (index_) index_->close();
}

}  // namespace mpm_ros
