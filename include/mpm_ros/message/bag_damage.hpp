// Check that the records of a bag are as long as they say. rosbag believes the lengths and places that it reads, asks
// for as much memory, and reads from there.
#pragma once

#include <string>

namespace mpm_ros {

/// Fault of a bag, to follow "PATH: "; empty where nothing is, and for files that rosbag refuses by itself:
/// no bag, an older one, or one that was not closed or was cut off. Looks at the lengths of all records, in chunks that
/// are not compressed too, and at the places that indices name; not into messages.
std::string bag_damage(const std::string& path);

}  // namespace mpm_ros
