// Contents of the tables of a report, gathered message by message: a few numbers a body, nothing that grows with the
// run but the times of the particle snapshots.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mpm_ros/message/quantity.hpp"
#include "mpm_ros/report/extreme.hpp"
#include "mpm_ros/report/report_bag.hpp"
#include "mpm_ros/report/report_messages.hpp"
#include "mpm_ros/report/robot_statistics.hpp"

namespace mpm_ros {

/// One number of a contact over the run. A scalar is stored as a vector along x.
struct NumberStatistics {
  std::string name, unit;
  bool vector = false;
  bool axisymmetric = false;               ///< reported for axisymmetric scenes only
  std::vector<Figure> figures;             ///< figures that are reported for it
  Extreme peak;                            ///< largest of an interval
  mpm::Vec3 integral = mpm::Vec3::Zero();  ///< over time
  mpm::Vec3 end = mpm::Vec3::Zero();       ///< value of the last interval
};

/// Contact of a rigid body with the material, or between two deformable bodies; world axes.
struct ContactStatistics {
  std::string name;
  std::vector<NumberStatistics> numbers;                         ///< in the order of their list (quantities.hpp)
  double duration = 0.0;                                         ///< sum of the intervals [s]
  std::optional<std::pair<std::int64_t, std::int64_t>> contact;  ///< end of first, last interval with a force [ns]

  /// @throws std::out_of_range when there is none of that name
  const NumberStatistics& of(const std::string& number) const;
  /// Over the run; zero without messages.
  mpm::Vec3 mean(const NumberStatistics& number) const;
};

/// Contact and motion of one rigid body over the run; world axes.
struct BodyStatistics : ContactStatistics {
  mpm::Box range;                  ///< range of the body's origin [m]
  std::optional<mpm::Pose> first;  ///< pose in the first message
  mpm::Pose last;                  ///< pose in the last message
  double largest_turn = 0.0;       ///< largest angle from the first pose [rad]
};

/// A global quantity over the run.
struct GlobalStatistics {
  std::string name, unit;
  double first = 0.0, last = 0.0;
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();
};

/// Commands of one kind to one body.
struct CommandStatistics {
  std::uint64_t count = 0;
  std::int64_t first = 0;  ///< took effect [ns]
  std::int64_t last = 0;
  std::uint64_t late = 0;  ///< asked for by a stamp before the time at which they took effect
};

class RunStatistics : public RunVisitor {
 public:
  void contact_forces(std::int64_t time, const ContactForces& message) override;
  void bodies(std::int64_t time, const BodyStates& message) override;
  void solver_state(std::int64_t time, const SolverState& message) override;
  void global_quantities(std::int64_t time, const GlobalQuantities& message) override;
  void robots(std::int64_t time, const RobotStates& message) override;
  void command(std::int64_t time, const Command& message) override;
  void particles(std::int64_t time, const sensor_msgs::PointCloud2& message) override;

  const std::vector<BodyStatistics>& body_statistics() const { return bodies_; }
  const std::vector<ContactStatistics>& pair_statistics() const { return pairs_; }
  const std::vector<GlobalStatistics>& global_statistics() const { return global_; }
  const std::vector<RobotStatistics>& robot_statistics() const { return robots_; }
  /// By body and kind.
  const std::map<std::pair<std::string, std::string>, CommandStatistics>& commands() const { return commands_; }
  /// The first and the last state; nothing before the first message.
  const std::optional<SolverState>& first_state() const { return first_state_; }
  const SolverState& last_state() const { return last_state_; }
  double smallest_j() const { return smallest_j_; }    ///< det F over the whole run
  double worst_audit() const { return worst_audit_; }  ///< largest residual that the solver reports
  /// Times at which the particle snapshots were taken [ns].
  const std::vector<std::int64_t>& snapshots() const { return snapshots_; }
  /// Time at which the largest force of all bodies acted [ns]; nothing when no body was touched.
  std::optional<std::int64_t> peak_time() const;

 private:
  std::vector<BodyStatistics> bodies_;    ///< in the order of the messages
  std::vector<ContactStatistics> pairs_;  ///< the same
  std::vector<GlobalStatistics> global_;  ///< the same
  std::vector<RobotStatistics> robots_;   ///< the same
  std::map<std::pair<std::string, std::string>, CommandStatistics> commands_;
  std::optional<SolverState> first_state_;
  SolverState last_state_;
  double smallest_j_ = std::numeric_limits<double>::infinity();
  double worst_audit_ = 0.0;
  std::vector<std::int64_t> snapshots_;
};

}  // namespace mpm_ros
