// Faults, and what else should be known, for the log and for /diagnostics: two statuses, `commands` and `solver`.
//
// solver: ERROR when the run has failed, or goes on without its record; WARN when the audit does not close, a particle
// is nearly crushed, particles left the grid and were put back, the wall clock is not kept up with, time.budget is too
// little for the fewest sweeps, or has made a force on tools worse by more than 5 % in the last ten seconds; else OK.
// commands: WARN for ten seconds after one was refused, was dropped or made a body jump; as long as a body that was
// commanded hears nothing (past ~command_timeout), waits for its tf frame, or is behind a pose for the sake of its
// limits; as long as the simulation is behind the clock by which commands are stamped; and once a tf frame of a body
// has had another owner, too; else OK. A late command is normal latency: counted, no warning.
#pragma once

#include <diagnostic_updater/diagnostic_updater.h>

#include <chrono>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>

#include "mpm/particles/particle_scalar.hpp"

namespace mpm_ros {

/// State of the run, for the status `solver`.
struct SolverHealth {
  std::string phase = "starting";  ///< "running", "paused", "waiting for step", "ended", "failed: …"
  bool failed = false;
  std::string record_failure;  ///< reason for going on without a record; empty: there is one, or none was asked for
  double time = 0.0;           ///< [s] simulated
  double real_time_factor = 0.0;
  double asked_factor = 0.0;                           ///< that pacing tries to keep; 0: none
  std::uint64_t overruns = 0;                          ///< sync periods that took longer than their wall time
  std::uint64_t steps = 0;                             ///< since the start
  double step = 0.0;                                   ///< the last one [s]
  std::string step_limited_by;                         ///< cause and place
  double courant = 0.0;                                ///< largest part of a cell that a wave crossed in a step
  double momentum_error = 0.0;                         ///< residual of the audit over the momentum exchanged
  mpm::Precision precision = mpm::Precision::float64;  ///< precision of the particles: how well the audit must close
  double min_j = 1.0;                                  ///< smallest det F
  std::uint64_t particles = 0;
  std::uint64_t returned = 0;  ///< particles that left the grid since the start and were put back
  std::string short_budget;    ///< that time.budget is too little, with the numbers; empty: it is not, or there is none
  double cut_error = 0.0;      ///< error of the tools' force where it ended sweeps of the last sync period; 0: nowhere
};

/// Commands that were taken, for the status `commands`.
struct CommandHealth {
  std::uint64_t unstamped = 0;           ///< on stamped topics, with stamp zero: applied at the next sync point
  std::uint64_t past = 0;                ///< with a stamp that was past: the same
  std::uint64_t waiting = 0;             ///< commands whose time is to come
  std::uint64_t most_waiting = 0;        ///< most of these of a body; more with stamps to come are refused
  double horizon = 0.0;                  ///< [s] ahead of the simulation; stamps beyond are refused
  std::uint64_t dropped = 0;             ///< that more came than could be kept: without effect
  std::uint64_t missing = 0;             ///< that did not come, by the gaps in header.seq
  std::uint64_t transforms_dropped = 0;  ///< messages of tf
};

/// State of a body that is kept within its limits.
struct LimitHealth {
  std::uint64_t limited = 0;  ///< commands that were not followed as fast as they asked
  double behind = 0.0;        ///< distance to a pose whose time has come [m]
  double behind_angle = 0.0;  ///< [rad]
};

/// Safe to use from any thread.
class NodeHealth {
 public:
  using Clock = std::chrono::steady_clock;

  /// A command was refused and changed nothing. One log line; the same line at most once a second, and no more than
  /// twenty of them.
  void refuse(const std::string& reason);
  /// A body took a command at simulated time `time` [s].
  void follow(const std::string& body, double time);
  /// A body follows another kind of command than before. One log line.
  void change(const std::string& what);
  /// A commanded body has not heard a command in time. One log line.
  void time_out(const std::string& body, const std::string& what);
  /// A body waits for what it follows, and warns until `what` is empty. One log line.
  void wait(const std::string& body, const std::string& what);
  /// A body was commanded to jump, as no tool moves. Counted, and logged like refusals.
  void jump(const std::string& what);
  /// The simulation is behind the clock by which it is commanded; warns until `what` is empty. One log line, and again
  /// every ten seconds.
  void lag(const std::string& what);
  /// A tf frame that the node publishes is published by another one, too. Warns from then on. One log line each.
  void share_frame(const std::string& frame, const std::string& node);
  /// A body with limits moves. Warns while it is behind; one log line when its first command was limited.
  void limit(const std::string& body, const LimitHealth& limits);
  void set_solver(const SolverHealth& solver);
  void set_commands(const CommandHealth& commands);
  /// The run begins again: nobody is silent, nobody was commanded. The counts of what was refused stay.
  void restart();

  std::uint64_t refused() const;

  void fill_commands(diagnostic_updater::DiagnosticStatusWrapper& status, Clock::time_point now = Clock::now()) const;
  void fill_solver(diagnostic_updater::DiagnosticStatusWrapper& status, Clock::time_point now = Clock::now()) const;
  /// True once after something was reported that should be published without delay.
  bool take_news();

  /// Below this part of its volume a particle is about to be crushed: a run fails at zero.
  static constexpr double kCrushed = 0.1;
  /// Part of the pace that was asked for; less is behind.
  static constexpr double kPaceKept = 0.95;
  /// Time for which a refusal warns.
  static constexpr std::chrono::seconds kFresh{10};

 private:
  struct Follower {
    std::uint64_t commands = 0;
    double last = 0.0;  // [s] simulated
    bool silent = false;
    std::string waits;
    LimitHealth limits;
  };
  void log_refusal(const std::string& line, Clock::time_point now);

  mutable std::mutex mutex_;
  SolverHealth solver_;
  double worst_cut_ = 0.0;  // SolverHealth::cut_error
  Clock::time_point worst_cut_at_;
  CommandHealth commands_;
  std::map<std::string, Follower> followers_;
  std::uint64_t refused_ = 0;
  std::uint64_t changes_ = 0;
  std::uint64_t timeouts_ = 0;
  std::string last_refusal_;
  Clock::time_point refused_at_;
  Clock::time_point jumped_at_;
  std::string last_timeout_;
  std::uint64_t jumps_ = 0;
  std::string last_jump_;
  std::string last_change_;
  std::map<std::string, std::string> shared_frames_;  // and who publishes them, too
  Clock::time_point dropped_at_, drop_logged_;
  std::string lag_;
  Clock::time_point lag_logged_;
  std::map<std::string, Clock::time_point> logged_;  // lines of refusals
  Clock::time_point quota_from_;
  int quota_used_ = 0;
  std::uint64_t unlogged_ = 0;
  bool news_ = false;
};

}  // namespace mpm_ros
