#include "mpm_ros/report/extreme.hpp"

namespace mpm_ros {

void Extreme::offer(const mpm::Vec3& candidate, std::int64_t when) {
  if (candidate.norm() <= norm) return;
  norm = candidate.norm();
  vector = candidate;
  time = when;
}

}  // namespace mpm_ros
