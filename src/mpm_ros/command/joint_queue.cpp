#include "mpm_ros/command/joint_queue.hpp"

#include <algorithm>
#include <iterator>
#include <tuple>
#include <utility>

namespace mpm_ros {

bool JointQueue::push(JointOrder order) {
  const std::lock_guard<std::mutex> lock(mutex_);
  order.order = arrivals_++;
  if (waiting_.size() + outside_.size() >= kMost) return false;
  (on_hold_ ? outside_ : waiting_).push_back(std::move(order));
  return true;
}

void JointQueue::hold() {
  const std::lock_guard<std::mutex> lock(mutex_);
  on_hold_ = true;
}

void JointQueue::release() {
  const std::lock_guard<std::mutex> lock(mutex_);
  on_hold_ = false;
  std::move(outside_.begin(), outside_.end(), std::back_inserter(waiting_));
  outside_.clear();
}

std::vector<JointOrder> JointQueue::take(std::int64_t now) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto later = std::stable_partition(waiting_.begin(), waiting_.end(),
                                           [&](const JointOrder& order) { return order.stamp.value_or(now) > now; });
  std::vector<JointOrder> due(std::make_move_iterator(later), std::make_move_iterator(waiting_.end()));
  waiting_.erase(later, waiting_.end());
  std::sort(due.begin(), due.end(), [&](const JointOrder& a, const JointOrder& b) {
    return std::make_tuple(a.stamp.value_or(now), a.order) < std::make_tuple(b.stamp.value_or(now), b.order);
  });
  return due;
}

void JointQueue::take_over(const JointQueue& other) {
  if (&other == this) return;
  const std::scoped_lock lock(mutex_, other.mutex_);
  waiting_ = other.waiting_;
  outside_.clear();
  for (JointOrder& order : waiting_) order.order = arrivals_++;
}

void JointQueue::serialise(mpm::StateArchive& archive) {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::uint64_t count = waiting_.size() + outside_.size();
  archive.value("count", count);
  std::vector<JointOrder> all = waiting_;
  all.insert(all.end(), outside_.begin(), outside_.end());
  all.resize(count);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const mpm::StateArchive::Group group(archive, std::to_string(i));
    JointOrder& order = all[i];
    archive.value("robot", order.robot);
    std::string joints;
    for (const std::string& joint : order.joints) joints += joint + "\n";
    archive.value("joints", joints);
    order.joints.clear();
    for (std::size_t begin = 0, end = 0; (end = joints.find('\n', begin)) != std::string::npos; begin = end + 1) {
      order.joints.push_back(joints.substr(begin, end - begin));
    }
    archive.list("values", order.values);
    archive.list("velocities", order.velocities);
    archive.list("times", order.times);
    archive.value("arrival", order.arrival);
    archive.value("requested_sec", order.requested.sec);
    archive.value("requested_nsec", order.requested.nsec);
    std::int64_t stamp = order.stamp.value_or(-1);
    archive.value("stamp", stamp);
    order.stamp = stamp < 0 ? std::nullopt : std::optional<std::int64_t>(stamp);
  }
  if (!archive.reading()) return;
  waiting_ = std::move(all);
  outside_.clear();
}

std::size_t JointQueue::waiting() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return waiting_.size() + outside_.size();
}

}  // namespace mpm_ros
