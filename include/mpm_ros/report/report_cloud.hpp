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

/// The first field that holds a value which is not finite, if any. @throws BagError as columns_of()
std::optional<std::string> field_not_finite(const sensor_msgs::PointCloud2& cloud);

}  // namespace mpm_ros
