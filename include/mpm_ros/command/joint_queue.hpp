// Orders to joints that wait for their sync point: filled by any thread, emptied by the solver's.
//
// An order takes effect at the first sync point at or after its stamp; without a stamp, or with one that is past, at
// the next. Those that are due together are applied by stamp, then in order of arrival.
#pragma once

#include <mutex>
#include <vector>

#include "mpm/math/state_archive.hpp"
#include "mpm_ros/command/joint_command.hpp"

namespace mpm_ros {

class JointQueue {
 public:
  /// Any thread. False, with nothing done, when kMost wait already.
  bool push(JointOrder order);
  /// From hold() on orders wait outside; release() lets them in.
  void hold();
  void release();
  /// Orders that take effect at `now` [ns].
  std::vector<JointOrder> take(std::int64_t now);
  /// Waits for what `other` waits for, and for nothing else.
  void take_over(const JointQueue& other);
  /// For checkpoints. Of what was given in ROS time the simulated time counts.
  void serialise(mpm::StateArchive& archive);
  std::size_t waiting() const;

  static constexpr std::size_t kMost = 10'000;

 private:
  mutable std::mutex mutex_;
  std::vector<JointOrder> waiting_, outside_;
  bool on_hold_ = false;
  std::uint64_t arrivals_ = 0;
};

}  // namespace mpm_ros
