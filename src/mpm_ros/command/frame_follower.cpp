#include "mpm_ros/command/frame_follower.hpp"

#include <fmt/format.h>
#include <tf2/exceptions.h>

#include <stdexcept>
#include <utility>

#include "mpm_ros/message/conversions.hpp"

namespace mpm_ros {

namespace {

/// A transform farther ahead than this [s] is of another clock: of a run before the clock was set back.
constexpr double kFarthestAhead = 1.0;

}  // namespace

std::optional<mpm::Pose> frame_pose(const tf2::BufferCore& transforms, const std::string& world_frame,
                                    const std::string& frame, std::string& problem) {
  try {
    const geometry_msgs::Pose pose = to_pose(transforms.lookupTransform(world_frame, frame, ros::Time()).transform);
    problem = problem_of(pose);
    if (problem.empty()) return checked_pose(pose);
  } catch (const std::runtime_error& error) {  // tf2's
    problem = error.what();
  }
  return std::nullopt;
}

FrameFollower::FrameFollower(const std::vector<std::string>& frames, std::string world_frame,
                             const tf2::BufferCore& transforms, CommandReader& reader, NodeHealth& health, bool latest)
    : world_frame_(std::move(world_frame)), transforms_(transforms), reader_(reader), health_(health), latest_(latest) {
  for (int body = 0; body < static_cast<int>(frames.size()); ++body) {
    if (!frames[body].empty()) followed_.push_back({body, frames[body], {}, false});
  }
}

void FrameFollower::look(const ros::Time& next) {
  for (Followed& followed : followed_) look(followed, next);
}

void FrameFollower::look(Followed& followed, const ros::Time& next) {
  geometry_msgs::TransformStamped transform;
  std::string problem;
  try {
    try {
      transform = transforms_.lookupTransform(world_frame_, followed.frame, latest_ ? ros::Time() : next);
    } catch (const tf2::ExtrapolationException&) {
      transform = transforms_.lookupTransform(world_frame_, followed.frame, ros::Time());
    }
    const double ahead = transform.header.stamp.toSec() - next.toSec();  // a ros::Duration may overflow
    if (!latest_ && ahead > kFarthestAhead)
      problem = fmt::format("its latest transform is stamped {:.3f} s ahead", ahead);
  } catch (const std::runtime_error& error) {  // tf2's, or times that a ros::Duration cannot hold
    problem = error.what();
  }
  if (!problem.empty()) {
    if (!std::exchange(followed.waits, true)) {
      const std::string& body = reader_.bodies()[followed.body];
      health_.wait(body, fmt::format("'{}' waits for the tf frame '{}': {}", body, followed.frame, problem));
    }
    return;
  }
  if (std::exchange(followed.waits, false)) health_.wait(reader_.bodies()[followed.body], {});
  if (transform.header.stamp <= followed.last) return;
  followed.last = transform.header.stamp;
  geometry_msgs::PoseStamped pose;
  pose.header.stamp = transform.header.stamp;
  pose.header.frame_id = world_frame_;
  pose.pose = to_pose(transform.transform);
  reader_.follow(followed.body, pose, !latest_);
}

std::pair<double, std::string> FrameFollower::farthest_ahead(const ros::Time& next) const {
  std::pair<double, std::string> farthest{0.0, {}};
  if (latest_) return farthest;
  for (const Followed& followed : followed_) {
    try {
      const ros::Time newest = transforms_.lookupTransform(world_frame_, followed.frame, ros::Time()).header.stamp;
      const double ahead = newest.toSec() - next.toSec();
      if (ahead > farthest.first) farthest = {ahead, followed.frame};
    } catch (const std::runtime_error&) {
      // Not known yet, which look() tells.
    }
  }
  return farthest;
}

std::optional<mpm::Pose> FrameFollower::latest_pose(int body) const {
  std::string ignored;
  for (const Followed& followed : followed_) {
    if (followed.body == body) return frame_pose(transforms_, world_frame_, followed.frame, ignored);
  }
  return std::nullopt;
}

void FrameFollower::clear() {
  for (Followed& followed : followed_) {
    followed.last = ros::Time();
    followed.waits = false;
  }
}

}  // namespace mpm_ros
