// The largest vector that was met.
#pragma once

#include <cstdint>

#include "mpm/math/geometry.hpp"

namespace mpm_ros {

/// The largest vector met, and when.
struct Extreme {
  double norm = 0.0;
  mpm::Vec3 vector = mpm::Vec3::Zero();
  std::int64_t time = 0;  ///< [ns] since the start
  void offer(const mpm::Vec3& candidate, std::int64_t when);
};

}  // namespace mpm_ros
