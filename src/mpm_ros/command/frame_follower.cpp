#include "mpm_ros/command/frame_follower.hpp"

#include <fmt/format.h>
#include <tf2/exceptions.h>

#include <utility>

namespace mpm_ros {

namespace {

/// A transform farther ahead than this [s] is of another clock: of a run before the clock was set back.
constexpr double kFarthestAhead = 1.0;

}  // namespace

FrameFollower::FrameFollower(const std::vector<std::string>& frames, std::string world_frame,
                             const tf2::BufferCore& transforms, CommandReader& reader, NodeHealth& health)
    : world_frame_(std::move(world_frame)), transforms_(transforms), reader_(reader), health_(health) {
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
      transform = transforms_.lookupTransform(world_frame_, followed.frame, next);
    } catch (const tf2::ExtrapolationException&) {
      transform = transforms_.lookupTransform(world_frame_, followed.frame, ros::Time());
    }
    const double ahead = (transform.header.stamp - next).toSec();
    if (ahead > kFarthestAhead) problem = fmt::format("its latest transform is stamped {:.3f} s ahead", ahead);
  } catch (const tf2::TransformException& error) {
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
  pose.pose.position.x = transform.transform.translation.x;
  pose.pose.position.y = transform.transform.translation.y;
  pose.pose.position.z = transform.transform.translation.z;
  pose.pose.orientation = transform.transform.rotation;
  reader_.follow(followed.body, pose);
}

void FrameFollower::clear() {
  for (Followed& followed : followed_) {
    followed.last = ros::Time();
    followed.waits = false;
  }
}

}  // namespace mpm_ros
