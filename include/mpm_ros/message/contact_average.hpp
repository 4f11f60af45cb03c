// Contact reports of consecutive intervals, joined into one: the simulation is asked at every sync point, while
// messages and services cover longer intervals of their own.
#pragma once

#include <vector>

#include "mpm/definition/report.hpp"
#include "mpm/math/state_archive.hpp"

namespace mpm_ros {

/// Contacts over one interval: every rigid body, and every pair of deformable bodies that has a law of contact.
struct Contacts {
  std::vector<mpm::ContactReport> bodies;
  std::vector<mpm::PairReport> pairs;
  /// For checkpoints.
  void serialise(mpm::StateArchive& archive);
};

class ContactAverage {
 public:
  /// One report a body and a pair, always in the same order; interval after interval.
  void add(const Contacts& contacts);
  /// True if nothing was added since the last take().
  bool empty() const { return empty_; }
  /// Each number over all intervals, as its line in quantities.cpp says. Starts anew.
  Contacts take();
  /// For checkpoints.
  void serialise(mpm::StateArchive& archive);

 private:
  bool empty_ = true;
  Contacts sum_;  // its means are those so far
};

}  // namespace mpm_ros
