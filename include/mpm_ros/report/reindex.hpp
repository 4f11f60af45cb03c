// A bag whose recording was cut short has no index, and no reader opens it. `rosbag reindex` makes one.
#pragma once

#include <string>

namespace mpm_ros {

/// An indexed copy in `folder` of all that is whole in the bag at `path`, which stays as it is. Returns the copy's
/// path.
/// @throws BagError when there is no room for a copy, no rosbag program, or nothing that it can save; says what to do
std::string reindexed_copy(const std::string& path, const std::string& folder);

}  // namespace mpm_ros
