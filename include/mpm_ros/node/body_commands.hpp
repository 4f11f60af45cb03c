// Commands to the rigid bodies of the node's run, from where they come to the run: topics and tf frames, requests of
// the service `step`, or a recording that is replayed in place of all three. They wait in a queue for their sync point;
// there they are checked, kept within the body's limits and applied, and a body that hears no more is noticed.
//
//   topics ─► CommandBridge ─► CommandQueue ─┐
//   step request ────────────────────────────┼─► CommandLimiter ─► Run::apply
//   recording ─► CommandLog ─────────────────┘        CommandWatch: silence
//
// Topics are heard by a thread of its own; all else is for the thread that the run belongs to, but for what says so.
#pragma once

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mpm/scene/scene.hpp"
#include "mpm_ros/command/command_bridge.hpp"
#include "mpm_ros/command/command_limiter.hpp"
#include "mpm_ros/command/command_log.hpp"
#include "mpm_ros/command/command_queue.hpp"
#include "mpm_ros/command/command_watch.hpp"
#include "mpm_ros/command/joint_bridge.hpp"
#include "mpm_ros/command/turning_twists.hpp"
#include "mpm_ros/message/node_health.hpp"
#include "mpm_ros/node/node_parameters.hpp"
#include "mpm_ros/run/run.hpp"

namespace mpm_ros {

/// Memory of the commands to a run from sync point to sync point; checkpoints hold it.
struct CommandMemory {
  CommandQueue queue;
  CommandWatch watch;
  CommandLimiter limiter;
  TurningTwists turning;
  JointQueue joints;
  void serialise(mpm::StateArchive& archive);
};

/// Commands of a step request.
struct StepCommands {
  std::vector<AppliedCommand> bodies;
  std::vector<JointOrder> joints;
};

class BodyCommands {
 public:
  /// Subscribes, unless a recording is replayed; nothing is heard before listen(). The references must outlive it.
  /// @throws BagError when the recording cannot be read
  BodyCommands(ros::NodeHandle node, const mpm::Scene& scene, const NodeParameters& parameters, NodeHealth& health);

  void listen();
  void stop_listening();

  /// For a run of that scene, whose bodies are those of this one, that is about to begin.
  CommandMemory fresh_memory(const mpm::Scene& scene) const;
  /// The run begins, or goes on from a checkpoint, with this memory. What came for the run before it is forgotten.
  void begin(const Run& run, const CommandMemory& memory);
  /// For checkpoints.
  void serialise(mpm::StateArchive& archive) { memory_.serialise(archive); }

  /// At a sync point. `refusal`: why one of `extra` was refused; those after it were not applied. `silence`: why the
  /// run ends, with on_timeout error.
  struct Outcome {
    std::string refusal, silence;
  };
  /// Applies what is due, then `extra`, then what moves limited bodies. @throws ParameterError when a recorded command
  /// does not fit the scene
  Outcome apply_due(Run& run, const StepCommands& extra);

  /// The commands of a request for a step of so many sync periods. `problem`: why they cannot be taken.
  StepCommands read(const std::vector<Command>& requested, const std::vector<JointCommand>& joints,
                    std::int64_t periods, const Run& run, std::string& problem) const;
  /// Sets a state at the present sync point; a body then is on its way to nowhere. Returns why not, or empty.
  std::string set_state(Run& run, const mpm::StateSet& state);
  /// From hold() on, what comes on topics waits for release().
  void hold() {
    memory_.queue.hold();
    memory_.joints.hold();
  }
  void release() {
    memory_.queue.release();
    memory_.joints.release();
  }
  const std::vector<std::string>& bodies() const { return bodies_; }
  /// A recording is replayed, and nothing else taken.
  bool replays() const { return bridge_ == nullptr; }
  /// Messages on topics so far, refused ones too. Any thread.
  std::uint64_t received() const { return replays() ? 0 : bridge_->reader().received(); }
  /// Waits until so many have come, for `patience` at most. Any thread but that which hears topics; not of a replay.
  bool wait_received(std::uint64_t count, std::chrono::milliseconds patience) const;

  /// Those that came late so far.
  LateCommands late() const { return memory_.queue.late(); }
  std::size_t waiting() const { return memory_.queue.waiting() + memory_.joints.waiting(); }
  /// Those that more came than could be kept, and had no effect, as of the last housekeeping.
  std::uint64_t dropped() const { return memory_.queue.dropped() + (replays() ? 0 : bridge_->dropped_commands()); }
  std::uint64_t dropped_transforms() const { return replays() ? 0 : bridge_->dropped_transforms(); }
  /// Those that did not come, by the numbers of their senders.
  std::uint64_t missing() const { return replays() ? 0 : bridge_->reader().missing(); }
  /// Pose of a body's tf frame at present; none where it follows none, or tf does not know.
  std::optional<mpm::Pose> frame_pose(int body) const {
    return replays() ? std::nullopt : bridge_->follower().latest_pose(body);
  }
  /// The clock was set back: moving tf frames are forgotten.
  void forget_frames();
  /// Refuses topics of bodies that the scene does not have, and counts what was dropped. Any thread.
  void keep_house();

 private:
  std::string apply(Run& run, const AppliedCommand& command);
  /// The same of a command to joints.
  std::string apply(Run& run, const JointOrder& order);
  void turn(Run& run);
  void apply_limited(Run& run);
  std::string act_on_silence(Run& run);
  void look_at_lag(const Run& run);

  const NodeParameters& parameters_;
  NodeHealth& health_;
  std::vector<std::string> bodies_;
  CommandLog log_;
  CommandMemory memory_;
  ros::CallbackQueue callbacks_;
  std::unique_ptr<CommandBridge> bridge_;      // none of a replay
  std::unique_ptr<JointBridge> joint_bridge_;  // the same
  std::unique_ptr<ros::AsyncSpinner> spinner_;
};

}  // namespace mpm_ros
