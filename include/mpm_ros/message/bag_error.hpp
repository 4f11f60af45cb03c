// The error of bags.
#pragma once

#include <stdexcept>

namespace mpm_ros {

/// A bag that cannot be written, read or replayed. what() is one line with the reason.
class BagError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace mpm_ros
