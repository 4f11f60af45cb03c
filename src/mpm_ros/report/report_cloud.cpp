#include "mpm_ros/report/report_cloud.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <numeric>

#include "mpm/simulation/simulation.hpp"
#include "mpm_ros/message/bag_error.hpp"

namespace mpm_ros {
namespace {

std::size_t size_of(const sensor_msgs::PointField& field) {
  switch (field.datatype) {
    case sensor_msgs::PointField::FLOAT64:
      return 8;
    case sensor_msgs::PointField::FLOAT32:
    case sensor_msgs::PointField::INT32:
    case sensor_msgs::PointField::UINT32:
      return 4;
    case sensor_msgs::PointField::INT16:
    case sensor_msgs::PointField::UINT16:
      return 2;
    default:
      return 1;
  }
}

bool is_real(const sensor_msgs::PointField& field) {
  return field.datatype == sensor_msgs::PointField::FLOAT32 || field.datatype == sensor_msgs::PointField::FLOAT64;
}

/// The number of points, once it is sure that every field of every point lies inside the data.
std::size_t checked_count(const sensor_msgs::PointCloud2& cloud) {
  const std::size_t count = static_cast<std::size_t>(cloud.width) * cloud.height;
  bool fits = cloud.data.size() >= count * cloud.point_step;
  for (const sensor_msgs::PointField& field : cloud.fields) {
    fits = fits && field.offset + size_of(field) <= cloud.point_step;
  }
  if (!fits) {
    throw BagError(
        fmt::format("particles at stamp {} s: {} points of {} bytes do not fit into {} bytes; the message "
                    "is damaged",
                    cloud.header.stamp.toSec(), count, cloud.point_step, cloud.data.size()));
  }
  if (cloud.is_bigendian) throw BagError("particles: big-endian clouds are not read; record on this kind of machine");
  return count;
}

template <typename Value>
Value value_at(const sensor_msgs::PointCloud2& cloud, std::size_t point, std::uint32_t offset) {
  Value value;
  std::memcpy(&value, cloud.data.data() + point * cloud.point_step + offset, sizeof(Value));
  return value;
}

float real_at(const sensor_msgs::PointCloud2& cloud, std::size_t point, const sensor_msgs::PointField& field) {
  if (field.datatype == sensor_msgs::PointField::FLOAT32) return value_at<float>(cloud, point, field.offset);
  return static_cast<float>(value_at<double>(cloud, point, field.offset));
}

}  // namespace

std::string unit_of_field(const std::string& name) {
  for (const auto& [field, unit] : mpm::Simulation::particle_fields()) {
    if (field == name) return unit;
  }
  return "";
}

CloudField::CloudField(const sensor_msgs::PointCloud2& cloud, const std::string& name)
    : cloud_(cloud), size_(checked_count(cloud)) {
  for (const sensor_msgs::PointField& field : cloud.fields) {
    const bool read = is_real(field) || field.datatype == sensor_msgs::PointField::UINT32;
    if (field.name == name && read) field_ = &field;
  }
}

double CloudField::at(std::size_t particle) const {
  switch (field_->datatype) {
    case sensor_msgs::PointField::FLOAT64:
      return value_at<double>(cloud_, particle, field_->offset);
    case sensor_msgs::PointField::UINT32:
      return value_at<std::uint32_t>(cloud_, particle, field_->offset);
    default:
      return value_at<float>(cloud_, particle, field_->offset);
  }
}

CloudColumns columns_of(const sensor_msgs::PointCloud2& cloud) {
  const std::size_t count = checked_count(cloud);
  CloudColumns result;
  result.ids.resize(count);
  std::iota(result.ids.begin(), result.ids.end(), 0U);
  for (const sensor_msgs::PointField& field : cloud.fields) {
    if (field.name == "id" && field.datatype == sensor_msgs::PointField::UINT32) {
      for (std::size_t i = 0; i < count; ++i) result.ids[i] = value_at<std::uint32_t>(cloud, i, field.offset);
    }
    if (!is_real(field)) continue;
    ParticleColumn column{field.name, unit_of_field(field.name), std::vector<float>(count), {}};
    for (std::size_t i = 0; i < count; ++i) column.values[i] = real_at(cloud, i, field);
    if (field.datatype == sensor_msgs::PointField::FLOAT64) {
      for (std::size_t i = 0; i < count; ++i) column.fine.push_back(value_at<double>(cloud, i, field.offset));
    }
    result.columns.push_back(std::move(column));
  }
  return result;
}

std::optional<std::string> field_not_finite(const sensor_msgs::PointCloud2& cloud) {
  const std::size_t count = checked_count(cloud);
  for (const sensor_msgs::PointField& field : cloud.fields) {
    if (!is_real(field)) continue;
    for (std::size_t i = 0; i < count; ++i) {
      if (!std::isfinite(real_at(cloud, i, field))) return field.name;
    }
  }
  return std::nullopt;
}

}  // namespace mpm_ros
