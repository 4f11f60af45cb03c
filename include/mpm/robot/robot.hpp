// A robot in the run: its joints' positions and velocities, what drives them, and the links that meet the material.
//
// A step: begin_step() reads the targets of drives, with mass matrix and Jacobians where the robot is; predict()
// finds the velocities that the step would have without contact; contact changes them, each impulse by
// J (M + C)^-1 J^T, where C is what drives, damping and limits add (joint_law.hpp); finish() ends that; end_step()
// books what each gave, and moves the joints by the velocities of the step's end. Coriolis forces are those of the mean
// of the velocities of both ends, so that the step is symmetric in time (leapfrog): energy oscillates by the step's
// first power, as that of the material does, and does not drift.
//
// Weak: in a step, Coriolis forces do not know what contact changed. With the laws' pieces that are assumed to hold
// contact is solved as a whole; when they change it is solved again (Articulation::settle()).
// Source: leapfrog of Hairer, Lubich & Wanner (2006), chapter I.1; joint-space equations of Featherstone (2008),
// chapter 3.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mpm/math/state_archive.hpp"
#include "mpm/rigid/rigid_body.hpp"
#include "mpm/robot/engine.hpp"
#include "mpm/robot/joint_solution.hpp"
#include "mpm/robot/joint_target.hpp"
#include "mpm/robot/robot_report.hpp"

namespace mpm {

class Robot final : public Articulation {
 public:
  /// `bodies`: of the run; those that the definition names become links of the robot. They outlive it, and stay where
  /// they are. @throws RigidError when this build has no engine, or the start is not within the joints' limits
  Robot(const RobotDefinition& definition, const Vec3& gravity, std::vector<RigidBody>& bodies);

  const RobotDefinition& definition() const { return definition_; }
  const std::string& name() const { return definition_.name; }
  /// Index of a joint that can be commanded. @throws RigidError with the nearest name
  int find_joint(const std::string& name) const;
  /// Checks a target of the drive's kind. @throws RigidError when not finite, or beyond the joint's limits
  void check_command(int joint, double value) const;
  /// A target from now on, which has been checked. A position that is to be reached without stiffness is approached
  /// over the time to `arrival`.
  void command(int joint, double value, double now, double arrival);
  /// Checks a trajectory. @throws RigidError for knots that do not go on in time, have ended before `now` or are beyond
  /// limits, or for a drive by effort
  void check_trajectory(int joint, const std::vector<JointKnot>& knots, double now) const;
  /// Follows a trajectory that has been checked.
  void follow(int joint, std::vector<JointKnot> knots, double now);

  /// Positions and velocities of joints by name; no velocities: at rest. [m], [rad]; [m/s], [rad/s]
  struct JointStates {
    std::vector<std::string> names;
    std::vector<double> positions, velocities;
  };
  /// Looks whether links may be where they have been put. @throws RigidError
  using CheckPlaces = std::function<void(const std::vector<const RigidBody*>& moved)>;
  /// Sets base and joints between two steps; without a pose the base stays as it is. Drives by position hold where
  /// their joints are put. The change of energy is booked. @throws RigidError, when nothing is changed: a joint that is
  /// not there or outside its limits, numbers that are not finite, a twist of a base that is not free, or by `check`
  void set_state(const std::optional<Pose>& pose, const Twist& twist, const JointStates& joints,
                 const CheckPlaces& check);

  void begin_step(double time, double dt);
  void end_step();
  /// At a sync point [ns]: a base that has reached a commanded pose is put exactly there.
  void at_sync(std::int64_t now);
  // Articulation
  void predict(double dt) override;
  void begin_trial() override;
  void end_trial() override;
  void begin_increment() override;
  void end_increment() override;
  bool settle() override;
  void finish() override;

  /// The motion of a moving base, which commands act on as on a prescribed body; null for others. Its name is the
  /// robot's, its surface a sphere around the links at the start, which meets nothing.
  RigidBody* base_motion() { return base_motion_.get(); }

  /// The largest speed of a link's points that its motion and its drives ask for, `ahead` [s] after `start` [s], in a
  /// sync period of `period` [s]; [m/s]
  double largest_speed(std::size_t contact, double start, double ahead, double period) const;
  RobotReport report() const;
  const RobotEnergies& energies() const { return energies_; }
  void serialise(StateArchive& archive);
  /// Numbers that make up its state, for the hash of the run.
  void hashed(std::vector<double>& numbers) const;

 private:
  /// A freedom of the engine as part of one of the robot: its velocity is `factor` times that of `freedom`.
  struct Part {
    int freedom;
    double factor;
    double offset;
  };
  struct Link {
    RigidBody* body = nullptr;
    LinkMotion* motion = nullptr;
    int link = 0;
    double reach = 0.0;        ///< distance of its farthest corner from the origin [m]
    Eigen::MatrixXd jacobian;  ///< 6 rows, a column each freedom
    bool responds = false;
    LinkMotion::Vec6 kept = LinkMotion::Vec6::Zero();    ///< velocity without a trial or an increment
    LinkMotion::Vec6 pushed = LinkMotion::Vec6::Zero();  ///< the same
  };

  int base_freedoms() const { return definition_.base.kind == BaseKind::fixed ? 0 : 6; }
  void find_parts();
  /// @throws RigidError
  void check_state(std::size_t joint, double position, double velocity) const;
  void check_twist(const Twist& twist) const;
  /// Puts the bodies of links, with their twists, where base and joints are.
  void put_links();
  /// Puts the engine where the robot is, with mass matrix and Jacobians there.
  void find_places();
  /// Positions of all joints that move, for the engine.
  void full_positions();
  void reduce_mass();
  void find_jacobian(int link, Eigen::MatrixXd& into);
  const Eigen::VectorXd& reduced_bias(const Eigen::VectorXd& velocities);
  std::unique_ptr<RigidBody> make_base_motion() const;
  LinkMotion::Vec6 in_base_axes(const Twist& twist) const;
  void set_laws(double time);
  JointActions actions_of(std::size_t joint, double time) const;
  /// Velocities of links by those of the joints.
  void tell_links(const Eigen::VectorXd& velocities);
  /// Velocities at the step's start, with what is prescribed in it.
  const Eigen::VectorXd& merge_prescribed();
  void find_response();
  void add_contact(Eigen::VectorXd& momentum, bool pushed) const;
  void book();
  void read_sensors();
  void move();
  std::string joint_text(std::size_t joint) const;

  RobotDefinition definition_;
  std::unique_ptr<RobotEngine> engine_;
  std::vector<Part> parts_;  ///< one for each freedom of the engine
  std::vector<Link> links_;
  LinkResponse response_;
  std::vector<JointTarget> targets_;
  JointSolution solution_;
  Pose base_;
  Eigen::VectorXd positions_;   ///< positions of joints that can be commanded
  Eigen::VectorXd velocities_;  ///< with those of the base
  double time_ = 0.0, dt_ = 0.0;
  bool predicted_ = false;
  std::unique_ptr<RigidBody> base_motion_;  ///< motion of a moving base; null for others
  RobotEnergies energies_;
  std::vector<double> last_targets_;        ///< targets of drives in the last step
  std::vector<double> impulses_, efforts_;  ///< impulses of drives since the start, efforts in the last step
  std::vector<Wrench> sensed_, sensed_sum_;
  // Kept so that a step allocates nothing of its own.
  Eigen::VectorXd full_positions_, full_velocities_, bias_, momentum_, with_contact_, start_velocities_, mean_;
  Eigen::MatrixXd mass_, full_jacobian_, stacked_,
      responses_;  ///< stacked_: Jacobians of links, transposed, side by side
  Eigen::VectorXd accelerations_;
  std::vector<int> link_numbers_;
  std::vector<LinkMotion::Vec6> wrenches_;
};

}  // namespace mpm
