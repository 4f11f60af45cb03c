#include "mpm_ros/message/ground_messages.hpp"

#include <sensor_msgs/image_encodings.h>

#include <cstring>

namespace mpm_ros {
namespace {

constexpr std::uint32_t kFloatBytes = 4;  // bytes of a float32

double spacing(double low, double high, int points) { return points > 1 ? (high - low) / (points - 1) : 0.0; }

}  // namespace

HeightMap to_message(const mpm::HeightGrid& map, double level) {
  HeightMap message;
  message.resolution = spacing(map.low.x(), map.high.x(), map.columns);
  message.columns = static_cast<std::uint32_t>(map.columns);
  message.rows = static_cast<std::uint32_t>(map.rows);
  message.origin.x = map.low.x();
  message.origin.y = map.low.y();
  message.origin.z = level;
  message.heights.reserve(map.heights.size());
  for (const double height : map.heights) message.heights.push_back(static_cast<float>(height - level));
  return message;
}

sensor_msgs::PointCloud2 to_cloud(const mpm::HeightGrid& map, const std::vector<double>& before,
                                  const LocalFrame& frame) {
  sensor_msgs::PointCloud2 cloud;
  for (const char* name : {"x", "y", "z", "change"}) {
    sensor_msgs::PointField field;
    field.name = name;
    field.offset = kFloatBytes * static_cast<std::uint32_t>(cloud.fields.size());
    field.datatype = sensor_msgs::PointField::FLOAT32;
    field.count = 1;
    cloud.fields.push_back(field);
  }
  cloud.width = static_cast<std::uint32_t>(map.columns);
  cloud.height = static_cast<std::uint32_t>(map.rows);
  cloud.is_bigendian = 0;
  cloud.is_dense = 0;  // some may be NaN
  cloud.point_step = kFloatBytes * static_cast<std::uint32_t>(cloud.fields.size());
  cloud.row_step = cloud.point_step * cloud.width;
  cloud.data.resize(static_cast<std::size_t>(cloud.row_step) * cloud.height);
  std::uint8_t* out = cloud.data.data();
  const double wide = spacing(map.low.x(), map.high.x(), map.columns);
  const double deep = spacing(map.low.y(), map.high.y(), map.rows);
  for (int row = 0; row < map.rows; ++row) {
    for (int column = 0; column < map.columns; ++column, out += cloud.point_step) {
      const auto at = static_cast<std::size_t>(row) * map.columns + column;
      const mpm::Vec3 place(map.low.x() + column * wide, map.low.y() + row * deep, map.heights[at]);
      const float point[] = {
          static_cast<float>(place.x() - frame.origin.x()), static_cast<float>(place.y() - frame.origin.y()),
          static_cast<float>(place.z() - frame.origin.z()), static_cast<float>(map.heights[at] - before[at])};
      std::memcpy(out, point, sizeof point);
    }
  }
  return cloud;
}

sensor_msgs::Image to_image(const mpm::HeightGrid& map) {
  sensor_msgs::Image image;
  image.width = static_cast<std::uint32_t>(map.columns);
  image.height = static_cast<std::uint32_t>(map.rows);
  image.encoding = sensor_msgs::image_encodings::TYPE_32FC1;
  image.is_bigendian = 0;
  image.step = kFloatBytes * image.width;
  image.data.resize(static_cast<std::size_t>(image.step) * image.height);
  std::uint8_t* out = image.data.data();
  for (int row = map.rows - 1; row >= 0; --row) {
    for (int column = 0; column < map.columns; ++column, out += kFloatBytes) {
      const auto height = static_cast<float>(map.heights[static_cast<std::size_t>(row) * map.columns + column]);
      std::memcpy(out, &height, kFloatBytes);
    }
  }
  return image;
}

}  // namespace mpm_ros
