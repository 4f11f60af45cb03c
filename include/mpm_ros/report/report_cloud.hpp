// The columns of a particle cloud: named scalars of one value a particle, x, y, z and id among them.
#pragma once

#include <sensor_msgs/PointCloud2.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mpm_ros/csv/csv_tables.hpp"

namespace mpm_ros {

/// A cloud taken apart.
struct CloudColumns {
  std::vector<std::uint32_t> ids;       ///< 0, 1, … when the cloud has no field `id`
  std::vector<ParticleColumn> columns;  ///< the float32 and float64 fields, with the units they have in this package
};

/// @throws BagError when the data are fewer than the fields need, or big-endian
CloudColumns columns_of(const sensor_msgs::PointCloud2& cloud);

/// One field of a cloud, read where it lies.
class CloudField {
 public:
  /// @throws BagError as columns_of()
  CloudField(const sensor_msgs::PointCloud2& cloud, const std::string& name);
  /// True if the cloud has a field of that name, of a type that is read: float32, float64 or uint32.
  bool found() const { return field_ != nullptr; }
  std::size_t size() const { return size_; }  ///< particles
  /// Value of a particle, 0 to size() - 1; only when found().
  double at(std::size_t particle) const;

 private:
  const sensor_msgs::PointCloud2& cloud_;
  const sensor_msgs::PointField* field_ = nullptr;
  std::size_t size_;
};

/// "Pa" and so on of a field of this package; empty for others.
std::string unit_of_field(const std::string& name);

/// The first field that holds a value which is not finite, if any. @throws BagError as columns_of()
std::optional<std::string> field_not_finite(const sensor_msgs::PointCloud2& cloud);

}  // namespace mpm_ros
