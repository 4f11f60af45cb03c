#include "mpm_ros/message/local_frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace mpm_ros {

bool is_place(const std::string& field) {
  const bool axis = !field.empty() && field.front() >= 'x' && field.front() <= 'z';
  return axis && (field.size() == 1 || field.substr(1) == "0");
}

namespace {

constexpr double kResolved = 0.01;              ///< part of a cell
constexpr double kFloatStep = 1.0 / (1 << 23);  ///< largest distance of float32 numbers, as a part of them

bool is_place_of(const sensor_msgs::PointField& field) {
  return is_place(field.name) && field.datatype == sensor_msgs::PointField::FLOAT32;
}

}  // namespace

LocalFrame local_frame(const mpm::GridDefinition& grid, const std::string& world) {
  LocalFrame frame{world, world};
  for (int axis = 0; axis < 3; ++axis) {
    const double size = grid.max[axis] - grid.min[axis];
    const double farthest = std::max(std::abs(grid.min[axis]), std::abs(grid.max[axis]));
    if (!(size > 0.0) || farthest * kFloatStep <= kResolved * grid.cell[axis]) continue;
    const double step = std::pow(10.0, std::floor(std::log10(size)));
    frame.origin[axis] = step * std::round(0.5 * (grid.min[axis] + grid.max[axis]) / step);
    if (frame.origin[axis] != 0.0) frame.name = world + "_local";
  }
  return frame;
}

std::string note_on(const LocalFrame& frame) {
  if (!frame.apart()) return {};
  return fmt::format(
      "clouds and markers are in the frame {} at ({:.10g}, {:.10g}, {:.10g}) m, since their float32 numbers cannot "
      "tell "
      "places apart that far from the origin; poses, forces, tables and files for ParaView are in {}",
      frame.name, frame.origin.x(), frame.origin.y(), frame.origin.z(), frame.world);
}

tf2_msgs::TFMessage static_transform(const LocalFrame& frame, const ros::Time& stamp) {
  geometry_msgs::TransformStamped transform;
  transform.header.stamp = stamp;
  transform.header.frame_id = frame.world;
  transform.child_frame_id = frame.name;
  transform.transform.translation.x = frame.origin.x();
  transform.transform.translation.y = frame.origin.y();
  transform.transform.translation.z = frame.origin.z();
  transform.transform.rotation.w = 1.0;
  tf2_msgs::TFMessage message;
  message.transforms.push_back(transform);
  return message;
}

std::map<std::string, mpm::Vec3> origins_of(const tf2_msgs::TFMessage& message) {
  std::map<std::string, mpm::Vec3> origins;
  for (const geometry_msgs::TransformStamped& one : message.transforms) {
    const geometry_msgs::Vector3& place = one.transform.translation;
    if (std::abs(one.transform.rotation.w) == 1.0) origins[one.child_frame_id] = {place.x, place.y, place.z};
  }
  return origins;
}

sensor_msgs::PointCloud2 in_world(const sensor_msgs::PointCloud2& cloud, const mpm::Vec3& origin) {
  struct Part {
    std::uint32_t from, to, bytes;
    int axis;  ///< axis of a place; -1: copied as it is
  };
  const auto size_of = [](const sensor_msgs::PointField& field) -> std::uint32_t {
    return field.datatype == sensor_msgs::PointField::FLOAT64 ? 8 : 4;
  };
  sensor_msgs::PointCloud2 result;
  result.header = cloud.header;
  result.height = cloud.height;
  result.width = cloud.width;
  result.is_bigendian = cloud.is_bigendian;
  result.is_dense = cloud.is_dense;
  std::vector<Part> parts;
  for (const sensor_msgs::PointField& field : cloud.fields) {
    const int axis = is_place_of(field) ? field.name.front() - 'x' : -1;
    parts.push_back({field.offset, result.point_step, size_of(field), axis});
    sensor_msgs::PointField copy = field;
    copy.offset = result.point_step;
    if (axis >= 0) copy.datatype = sensor_msgs::PointField::FLOAT64;
    result.point_step += size_of(copy);
    result.fields.push_back(copy);
  }
  const std::size_t points = static_cast<std::size_t>(cloud.width) * cloud.height;
  for (const Part& part : parts) {
    // A damaged message is left to whoever reads the cloud, who says so.
    if (part.from + part.bytes > cloud.point_step || cloud.data.size() < points * cloud.point_step) return cloud;
  }
  result.row_step = result.point_step * cloud.width;
  result.data.resize(points * result.point_step);
  for (std::size_t p = 0; p < points; ++p) {
    const std::uint8_t* from = cloud.data.data() + p * cloud.point_step;
    std::uint8_t* to = result.data.data() + p * result.point_step;
    for (const Part& part : parts) {
      if (part.axis < 0) {
        std::memcpy(to + part.to, from + part.from, part.bytes);
        continue;
      }
      float near = 0.0F;
      std::memcpy(&near, from + part.from, sizeof near);
      const double place = origin[part.axis] + static_cast<double>(near);
      std::memcpy(to + part.to, &place, sizeof place);
    }
  }
  return result;
}

void move_to(const LocalFrame& frame, visualization_msgs::MarkerArray& markers) {
  if (!frame.apart()) return;
  const auto move = [&frame](geometry_msgs::Point& point) {
    point.x -= frame.origin.x();
    point.y -= frame.origin.y();
    point.z -= frame.origin.z();
  };
  for (visualization_msgs::Marker& marker : markers.markers) {
    if (marker.header.frame_id != frame.world) continue;
    marker.header.frame_id = frame.name;
    for (geometry_msgs::Point& point : marker.points) move(point);
    if (marker.points.empty()) move(marker.pose.position);
  }
}

}  // namespace mpm_ros
