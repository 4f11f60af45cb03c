// The error of reports.
#pragma once

#include <stdexcept>

namespace mpm_ros {

/// Error that stands in the way of a report beside the bag itself: a folder, a script, options that do not go together.
/// what() is one line.
class ReportError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace mpm_ros
