// A recording that is split lies in several bags: F.bag, F_part0002.bag, F_part0003.bag, … In the order of their names
// they are in the order of time; the bags of a run after a reset (F_2.bag) are not taken for parts.
#pragma once

#include <string>
#include <vector>

namespace mpm_ros {

/// The name of a part, counted from 1, which is `bag` itself.
std::string part_path(const std::string& bag, int part);

/// `bag` and the parts after it that are there, up to the first that is not.
std::vector<std::string> parts_of(const std::string& bag);

/// Takes away the later parts that an earlier recording of this name left. Returns how many.
/// @throws BagError when one cannot be removed
int remove_later_parts(const std::string& bag);

}  // namespace mpm_ros
