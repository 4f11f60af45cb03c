// Bodies that follow tf frames: at each sync point the frame's new transform becomes a pose command.
//
// Where tf knows the frame at the next sync point (it was stamped ahead, or is static), the body goes to where the
// frame is then. Else the latest transform is taken, once, by its stamp: as any pose on a topic that comes late, it is
// reached one command period after it came. What reaches tf after the sync point counts at the next one.
//
// With `latest` the newest transform is taken whatever its stamp, as a pose without one: for a robot that stamps by the
// wall clock while the simulation is slower. Weak: how late the body is depends then on the machine, and a run is not
// repeated by the same robot; its recorded commands repeat it.
#pragma once

#include <ros/time.h>
#include <tf2/buffer_core.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mpm_ros/command/command_reader.hpp"
#include "mpm_ros/message/node_health.hpp"

namespace mpm_ros {

/// The latest pose of a frame in the world's; none, with the reason, where tf does not know it, or knows no pose.
std::optional<mpm::Pose> frame_pose(const tf2::BufferCore& transforms, const std::string& world_frame,
                                    const std::string& frame, std::string& problem);

class FrameFollower {
 public:
  /// `frames`: of each body of the reader; empty: it follows none. The rest must outlive the follower.
  FrameFollower(const std::vector<std::string>& frames, std::string world_frame, const tf2::BufferCore& transforms,
                CommandReader& reader, NodeHealth& health, bool latest = false);

  /// Looks frames up. `next`: stamp of the sync point after the present one.
  void look(const ros::Time& next);
  /// Time by which the newest transform of a frame is stamped ahead of `next` [s], and the frame; 0 s: of none, or with
  /// `latest`.
  std::pair<double, std::string> farthest_ahead(const ros::Time& next) const;
  /// Pose of the frame of a body at present; none where that is not known.
  std::optional<mpm::Pose> latest_pose(int body) const;
  /// For a run that begins again.
  void clear();

 private:
  struct Followed {
    int body = 0;
    std::string frame;
    ros::Time last;  // stamp of the transform used last
    bool waits = false;
  };
  void look(Followed& followed, const ros::Time& next);

  const std::string world_frame_;
  const tf2::BufferCore& transforms_;
  CommandReader& reader_;
  NodeHealth& health_;
  const bool latest_;
  std::vector<Followed> followed_;
};

}  // namespace mpm_ros
