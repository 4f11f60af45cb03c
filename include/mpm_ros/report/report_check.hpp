// Checks of what must hold of any recorded run, found from its messages alone. Where a message says of itself that all
// is well, the same is worked out again from its parts: the audit's residual from momentum and impulses, a body's
// impulse from its forces and from what the material's balance says of it.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "mpm_ros/message/audit_limit.hpp"
#include "mpm_ros/report/report_bag.hpp"
#include "mpm_ros/report/report_messages.hpp"

namespace mpm_ros {

/// One line of `bag_report --check`.
struct CheckResult {
  std::string name;
  bool passed = true;
  std::string detail;  ///< the numbers; of a failure: the first time it was found, and what
  bool made = true;    ///< false: could not be made, and `detail` says why; then `passed` is true
};

class RunChecks : public RunVisitor {
 public:
  /// `sync_period` [s] of the run; 0 when it is not known. `precision` of its particles: how well its audit must close.
  RunChecks(double sync_period, mpm::Precision precision, std::vector<std::string> missing, bool axisymmetric = false);

  void contact_forces(std::int64_t time, const ContactForces& message) override;
  void bodies(std::int64_t time, const BodyStates& message) override;
  void solver_state(std::int64_t time, const SolverState& message) override;
  void command(std::int64_t time, const Command& message) override;
  void global_quantities(std::int64_t time, const GlobalQuantities& message) override;
  void robots(std::int64_t time, const RobotStates& message) override;
  void clock(std::int64_t time) override;
  void particles(std::int64_t time, const sensor_msgs::PointCloud2& message) override;

  /// Call once all messages are read.
  std::vector<CheckResult> results() const;
  /// Places where time is missing: "contact_forces: 0.002 s missing before 0.105 s".
  const std::vector<std::string>& gaps() const { return gaps_; }

 private:
  /// Times of one topic: evenly spaced by a multiple of the sync period; the last interval may be shorter, and the
  /// first of a recording that begins between two multiples of the interval.
  struct Spacing {
    std::optional<std::int64_t> first;
    std::int64_t last = 0;
    std::int64_t interval = 0;            ///< between messages, but for the first and the last
    std::optional<std::int64_t> shorter;  ///< end of a shorter interval, allowed at the end alone
    std::uint64_t count = 0;
  };
  /// Impulse of a rigid body, or of a pair of deformable ones.
  struct KnownImpulse {
    mpm::Vec3 impulse = mpm::Vec3::Zero();  ///< impulse of the last message
    std::optional<std::int64_t> time;       ///< time of the last message
    double exchanged = 0.0;                 ///< sum of |force| times interval [N s]
  };

  void space(const std::string& topic, std::int64_t time);
  void gap(const std::string& text);
  void fail(const std::string& name, std::int64_t time, const std::string& what);
  /// The force over the interval that ends now, and the impulse since the start.
  template <class Contact>
  void add_up(KnownImpulse& known, std::int64_t time, const Contact& contact, const mpm::Vec3& force);
  /// Checks that time and steps since the last state belong together.
  void check_steps(std::int64_t time, const SolverState& state);
  /// Energy that came or went without an account since the first state.
  void check_balance(std::int64_t time, const SolverState& state);
  void check_against_material(const std::string& body, std::int64_t time, const mpm::Vec3& impulse);

  std::int64_t sync_period_;  ///< [ns]
  double audit_limit_;        ///< limit of the residual over the momentum exchanged
  std::vector<std::string> missing_;
  bool axisymmetric_;
  std::map<std::string, std::string> failures_;  ///< the first of each check, by its name
  std::vector<std::string> gaps_;
  std::map<std::string, Spacing> spacing_;             ///< by topic
  std::map<std::string, KnownImpulse> impulses_;       ///< on rigid bodies
  std::map<std::string, KnownImpulse> pair_impulses_;  ///< between deformable bodies
  std::set<std::string> posed_;                        ///< bodies with a pose
  std::optional<SolverState> state_;                   ///< the last one
  std::int64_t state_time_ = 0;                        ///< time of it [ns]
  bool from_start_ = false;                            ///< the first state is at time zero
  std::uint64_t commands_ = 0;                         ///< recorded
  std::uint64_t earlier_commands_ = 0;                 ///< before the time of the last command
  std::int64_t last_command_ = -1;                     ///< [ns]
  /// Before the time of the last state, and up to it: a state has those of its own time where it closes a run alone.
  std::uint64_t commands_before_ = 0, commands_until_ = 0;
  std::uint64_t refused_before_ = 0;                    ///< as the first state counts them: of runs before a reset
  std::uint64_t applied_ = 0, late_ = 0, refused_ = 0;  ///< as the last state counts them
  std::uint64_t clocks_ = 0;                            ///< messages on /clock
  std::int64_t last_clock_ = 0;                         ///< [ns]
  std::vector<std::string> impulse_names_;              ///< names of the first state
  double worst_audit_ = 0.0;
  double worst_impulse_ = 0.0;
  double worst_reaction_ = 0.0;
  double worst_stamp_ = 0.0;             ///< [s]
  std::optional<double> first_balance_;  ///< [J]
  double worst_balance_ = 0.0;           ///< largest change since [J]
  std::int64_t worst_balance_time_ = 0;  ///< [ns]
  double spent_ = 0.0;                   ///< work done and stored energy given since the first state [J]
  std::optional<SolverState> first_state_;
  double min_j_ = std::numeric_limits<double>::infinity();
};

}  // namespace mpm_ros
