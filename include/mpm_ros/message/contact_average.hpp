// Contact reports of consecutive intervals, joined into one: the simulation is asked at every sync point, while
// messages and services cover longer intervals of their own.
#pragma once

#include <vector>

#include "mpm/simulation/report.hpp"

namespace mpm_ros {

class ContactAverage {
 public:
  /// One report a body, always in the same order; interval after interval.
  void add(const std::vector<mpm::ContactReport>& reports);
  /// Means: impulse over time. Arm: mean by normal impulse. Peak: of the step with the largest force. Impulse, nodes
  /// and origin: of the last report. Starts anew.
  std::vector<mpm::ContactReport> take();

 private:
  std::vector<mpm::ContactReport> sum_;  // its means are those so far
};

}  // namespace mpm_ros
