// The dynamics of a tree of links, as an engine of articulated bodies gives them, and where a run gets one from.
//
// Generalised velocities: six of a free or moving base, its twist in the base's axes, rotation first; then one of each
// joint that moves, in the model's order. Nothing here knows drives, limits or contact: those are the robot's
// (robot/robot.hpp).
#pragma once

#include <Eigen/Core>
#include <memory>

#include "mpm/robot/definition.hpp"

namespace mpm {

class RobotEngine {
 public:
  virtual ~RobotEngine() = default;

  /// Number of generalised velocities.
  virtual int freedoms() const = 0;
  /// Puts the links by the pose of the base and the positions of the joints that move.
  virtual void set_positions(const Pose& base, const Eigen::VectorXd& joints) = 0;
  /// Mass matrix [kg], [kg m], [kg m^2] there.
  virtual const Eigen::MatrixXd& mass_matrix() = 0;
  /// Generalised force that keeps these velocities constant: Coriolis and centrifugal forces and weight, without other
  /// forces. [N], [N m]
  virtual const Eigen::VectorXd& bias(const Eigen::VectorXd& velocities) = 0;
  virtual Pose pose(int link) = 0;
  /// The Jacobian of a link's twist, 6 rows: rotation, then velocity of its origin, world axes.
  virtual void jacobian(int link, Eigen::MatrixXd& into) = 0;
  /// -m g.x of all links [J]
  virtual double potential() = 0;
  /// Wrench that a joint transmits to its child, in the child's axes and about its origin, torque first, with these
  /// velocities and accelerations, and with these wrenches of contact on links (world axes, about their origins);
  /// without `weight` as if nothing had any.
  virtual Eigen::Matrix<double, 6, 1> joint_wrench(int joint, const Eigen::VectorXd& velocities,
                                                   const Eigen::VectorXd& accelerations, const std::vector<int>& links,
                                                   const std::vector<Eigen::Matrix<double, 6, 1>>& wrenches,
                                                   bool weight) = 0;
};

/// Makes the engine of a robot under gravity [m/s^2].
using MakeRobotEngine = std::unique_ptr<RobotEngine> (*)(const RobotDefinition&, const Vec3& gravity);

/// The engine that programs were built with; mpm_robots/robots.hpp sets it. Null in a build without one.
MakeRobotEngine robot_engine();
void set_robot_engine(MakeRobotEngine make);

}  // namespace mpm
