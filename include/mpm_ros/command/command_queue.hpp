// The commands that wait for their sync point: one queue by stamp, filled by any thread, emptied by the solver's.
//
// Velocity: takes effect at the first sync point at or after its stamp; without a stamp, or with one that is past, at
// the next. Pose: one whose stamp is to come arrives at it (rounded up to a sync point), setting out when the pose
// before it has been reached; any other sets out at the next sync point and arrives one command period later, the
// period being the time between the body's last two pose commands. A body has one kind of command at a time: a command
// that takes effect drops those of the other kind that were received before it. Wrench: as velocity, but beside the
// others, which it neither ends nor is ended by.
//
// What is due at a sync point is applied in order of effective time and body; of equal ones velocities come before
// poses, then the sender's name decides, then arrival, which for one sender and one topic is the order of sending. So
// commands that came before their stamps are applied in an order that does not depend on when they came. What came late
// is applied after them, in the order of arrival.
//
// A body holds a bounded number of commands whose stamps are to come; more are refused. Commands without such a stamp
// are never refused, for one of them may be a stop: where too many wait, as in a pause, the oldest of the same body,
// kind and sender makes room, and is counted.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "mpm/math/state_archive.hpp"
#include "mpm_ros/command/body_command.hpp"

namespace mpm_ros {

/// A command that is due, still in the axes it was given in.
struct DueCommand {
  BodyCommand command;
  std::int64_t arrival = 0;  ///< [ns] pose: a sync point after the present one
};

struct LateCommands {
  std::uint64_t unstamped = 0;
  std::uint64_t past = 0;
};

class CommandQueue {
 public:
  /// `sync_period` > 0 [ns].
  explicit CommandQueue(std::int64_t sync_period) : sync_period_(sync_period) {}

  /// Any thread. False, with nothing done, when the stamp is to come and kMost such commands of the body wait already.
  bool push(BodyCommand command);
  /// From hold() on commands wait outside; release() lets them in. A step of the lockstep takes what came before it.
  void hold();
  void release();
  /// Pushes what was looked up for this sync point, in the middle of a step.
  bool push_past_hold(BodyCommand command);
  /// Commands that take effect at the sync point `now` [ns], which is later than the one before.
  std::vector<DueCommand> take(std::int64_t now);
  /// Forgets everything but the counts, for a run that begins again.
  void clear();

  /// Commands that came on a stamped topic with a stamp of zero, and with one that was past.
  LateCommands late() const;
  std::size_t waiting() const;
  /// Commands that made room for later ones, and had no effect.
  std::uint64_t dropped() const;
  /// The last sync point taken [ns]; -1 before the first.
  std::int64_t passed() const;

  /// So many commands of a body whose stamps are to come may wait, and so many others of one body, kind and sender:
  /// 100 s of a stream at 100 Hz. Each of them is looked at in every sync point.
  static constexpr std::size_t kMost = 10'000;
  /// A stamp farther ahead of the simulation than this [ns] is refused: it comes from another clock, or from a plan
  /// that is better sent as it is carried out.
  static constexpr std::int64_t kHorizon = 600'000'000'000;
  /// A gap in a body's stream of poses longer than this [ns] says nothing of its period.
  static constexpr std::int64_t kLongestPeriod = 1'000'000'000;

  /// For checkpoints: all but the counts. Of what was given in ROS time the simulated time counts.
  void serialise(mpm::StateArchive& archive);
  /// Waits for what `other` waits for, by its sync period, and keeps its own counts.
  void take_over(const CommandQueue& other);

 private:
  /// The stream of poses of one body.
  struct PoseStream {
    std::int64_t last_stamp = -1;  ///< stamp of the last pose that set out (its sync point when it had none) [ns]
    std::int64_t period = 0;       ///< [ns]
    std::int64_t arrival = 0;      ///< [ns] of the pose under way
  };

  /// Body, kind and sender.
  using Stream = std::tuple<int, CommandKind, std::string>;

  static Stream stream_of(const BodyCommand& command);
  bool is_ahead(const BodyCommand& command) const { return command.stamp && *command.stamp > passed_; }
  /// Counts the command that is to come in, and drops what has to go for it. False when it cannot come in.
  bool make_room(const BodyCommand& command);
  void count_waiting();
  void admit(BodyCommand command);
  std::int64_t round_up(std::int64_t time) const { return (time + sync_period_ - 1) / sync_period_ * sync_period_; }
  bool is_due(const BodyCommand& command, std::int64_t now) const;
  /// Moves what cannot be due at `now` to the end of waiting_, in any order. Returns where it begins.
  std::deque<BodyCommand>::iterator part_later(std::int64_t now);
  std::int64_t arrival_of(const BodyCommand& command, std::int64_t now);

  std::int64_t sync_period_;
  mutable std::mutex mutex_;
  std::deque<BodyCommand> waiting_;
  std::deque<BodyCommand> outside_;  ///< came while on hold
  bool on_hold_ = false;
  std::map<int, std::size_t> ahead_;    ///< number of both whose stamp is to come, by body
  std::map<Stream, std::size_t> next_;  ///< number of the others of both, by stream
  std::map<int, PoseStream> streams_;
  std::int64_t passed_ = -1;  ///< last sync point taken [ns]
  std::uint64_t arrivals_ = 0;
  LateCommands late_;
  std::uint64_t dropped_ = 0;
};

}  // namespace mpm_ros
