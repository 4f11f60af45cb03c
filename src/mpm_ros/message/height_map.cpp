#include "mpm_ros/message/height_map.hpp"

#include <fmt/format.h>

#include <cmath>

namespace mpm_ros {

mpm::HeightGrid height_grid(const HeightMap& message, const std::string& topic, const std::string& world_frame) {
  const auto refuse = [&](const std::string& what) {
    throw mpm::Error(fmt::format("the map of heights on {} {}", topic, what));
  };
  const std::string& frame = message.header.frame_id;
  if (!frame.empty() && frame != world_frame)
    refuse(fmt::format("is in the frame '{}'; send it in the world frame '{}'", frame, world_frame));
  if (!(message.resolution > 0.0) || !std::isfinite(message.resolution))
    refuse(fmt::format("has a resolution of {} m; send the distance between points", message.resolution));
  if (message.columns < 2 || message.rows < 1 ||
      static_cast<std::uint64_t>(message.columns) * message.rows != message.heights.size()) {
    refuse(fmt::format("has {} heights for {} x {} points; send one each, and two points at least along each axis",
                       message.heights.size(), message.columns, message.rows));
  }
  if (!std::isfinite(message.origin.x + message.origin.y + message.origin.z))
    refuse("has an origin that is not finite; send where its first point lies");
  mpm::HeightGrid grid;
  grid.columns = static_cast<int>(message.columns);
  grid.rows = static_cast<int>(message.rows);
  grid.low = {message.origin.x, message.origin.y};
  grid.high = grid.low + message.resolution * mpm::Vec2(grid.columns - 1, grid.rows - 1);
  grid.heights.reserve(message.heights.size());
  for (const float height : message.heights) grid.heights.push_back(message.origin.z + height);
  return grid;
}

}  // namespace mpm_ros
