// The check `momentum`: what was recorded in different places, by different code, must agree. On one side the change
// of the particles' momentum, sum of m v, with velocities from the particle clouds and masses from the scene's text.
// On the other the forces that the bodies felt times their intervals (contact_forces), the weight from the scene's
// text, and the impulses of walls and damping, which are recorded in solver_state alone.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mpm_ros/message/audit_limit.hpp"
#include "mpm_ros/report/report_bag.hpp"
#include "mpm_ros/report/report_check.hpp"
#include "mpm_ros/report/report_messages.hpp"
#include "mpm_ros/report/report_scene.hpp"

namespace mpm_ros {

class MomentumCheck : public RunVisitor {
 public:
  /// Makes the check of a run with this scene. Makes all its particles once, to know their masses.
  explicit MomentumCheck(const std::optional<RunInfo>& info);

  void contact_forces(std::int64_t time, const ContactForces& message) override;
  void solver_state(std::int64_t time, const SolverState& message) override;
  void particles(std::int64_t time, const sensor_msgs::PointCloud2& message) override;

  /// Call once all messages are read.
  CheckResult result() const;

 private:
  /// Sums over the particles of a cloud, along each axis.
  struct Sums {
    mpm::Vec3 momentum = mpm::Vec3::Zero();  ///< [N s]
    mpm::Vec3 size = mpm::Vec3::Zero();      ///< sum of m |v| [N s]
  };
  /// Momentum that is known at one time.
  struct Account {
    std::int64_t time = 0;
    Sums sums;
    mpm::Vec3 on_bodies = mpm::Vec3::Zero();  ///< forces times intervals so far [N s]
    mpm::Vec3 others = mpm::Vec3::Zero();     ///< impulses of all but gravity and bodies so far [N s]
  };
  std::optional<Sums> sums_of(const sensor_msgs::PointCloud2& cloud);
  /// Once all three messages of a time are there: those of one stamp come in any order.
  void compare();

  std::vector<double> masses_;             ///< by id [kg]
  double total_mass_ = 0.0;                ///< [kg]
  mpm::Vec3 gravity_ = mpm::Vec3::Zero();  ///< [m/s^2]
  double audit_limit_ = 0.0;               ///< limit of the solver's own residual over the momentum exchanged
  std::string obstacle_;                   ///< reason why the check cannot be made; empty: it can
  std::string axes_;                       ///< along which velocities are recorded: "xz"
  std::optional<std::int64_t> contact_time_;
  std::optional<Account> cloud_;  ///< the last one, until it is compared
  std::optional<SolverState> state_;
  std::int64_t state_time_ = 0;  ///< time of it [ns]
  mpm::Vec3 on_bodies_ = mpm::Vec3::Zero();
  std::optional<Account> first_;
  std::uint64_t checked_ = 0;
  double worst_ = 0.0;     ///< residual over the momentum exchanged
  double rounding_ = 0.0;  ///< limit by rounding, the same way, where the residual was worst
  std::string failure_;    ///< the first
};

}  // namespace mpm_ros
