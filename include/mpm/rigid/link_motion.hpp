// The motion of a robot's link that meets the material, and what contact has to know of the robot that it belongs to.
//
// A robot is one system: an impulse on a link changes the velocities of all its links, by J M^-1 J^T, where J is the
// Jacobian of the links' twists by the robot's generalised velocities and M its mass matrix with what the drives add to
// it (robot/robot.hpp). Where no link of it can be moved by an impulse, since all joints on the way to the base have a
// prescribed motion, the link is a prescribed body to contact, which notes its impulses alone.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "mpm/rigid/dynamic_motion.hpp"

namespace mpm {

class LinkMotion;

/// Interface of a robot to contact. All its links have their velocities from it.
class Articulation {
 public:
  virtual ~Articulation() = default;

  /// Gives the links the velocities that the step would have without contact.
  virtual void predict(double dt) = 0;
  /// Begins a trial: what is pushed between the two calls is forgotten at the second.
  virtual void begin_trial() = 0;
  virtual void end_trial() = 0;
  /// Sets velocities to zero; they are increments until end_increment() adds them to the previous velocities.
  virtual void begin_increment() = 0;
  virtual void end_increment() = 0;
  /// Looks whether joints still act as was assumed when the compliance was found: within the limits of efforts and
  /// positions, sticking or sliding. @return true if that changed; compliances and velocities are then new.
  virtual bool settle() = 0;
  /// Ends the solution: velocities are those that the impulses noted by LinkMotion::take() leave.
  virtual void finish() = 0;

 protected:
  Articulation() = default;
  Articulation(const Articulation&) = default;
  Articulation& operator=(const Articulation&) = default;
};

/// Velocities of links by impulses on them: six rows and columns a link, rotations first. [1/(kg m^2)], [1/kg]
struct LinkResponse {
  Eigen::MatrixXd matrix;
  std::vector<LinkMotion*> links;  ///< those that impulses move, in the order of the matrix
  Eigen::VectorXd change;          ///< kept so that a push allocates nothing
};

class LinkMotion final : public DynamicMotion {
 public:
  using Vec6 = Eigen::Matrix<double, 6, 1>;  ///< parts of rotation, then of translation

  LinkMotion(Articulation& robot, LinkResponse& response) : robot_(&robot), response_(&response) {}

  Articulation& robot() const { return *robot_; }
  /// True if impulses move it.
  bool responds() const { return place_ >= 0; }
  /// `place`: among LinkResponse::links, or -1.
  void set_place(int place) { place_ = place; }
  /// Sets where its origin is, and its pose after the step.
  void set_origin(const Vec3& origin) { centre_ = origin; }
  void set_next(const Pose& pose, const Twist& twist) {
    next_pose_ = pose;
    next_twist_ = twist;
  }
  /// Sets the acceleration of its origin that the step limit counts with [m/s^2].
  void set_acceleration(double acceleration) { acceleration_ = acceleration; }
  void set_velocity(const Vec6& twist) {
    rate_ = twist.head<3>();
    velocity_ = twist.tail<3>();
  }
  void set_start_velocity(const Vec6& twist) {
    start_rate_ = twist.head<3>();
    start_velocity_ = twist.tail<3>();
  }
  Vec6 velocity() const {
    Vec6 twist;
    twist << rate_, velocity_;
    return twist;
  }
  void add(const Vec6& twist) {
    rate_ += twist.head<3>();
    velocity_ += twist.tail<3>();
  }

  void push(const Vec3& impulse, const Vec3& point) override;
  Mat3 compliance_at(const Vec3& point) const override;
  /// Change of velocity of a world point of this link by a unit impulse there on another link of the same robot.
  Mat3 compliance_by(const LinkMotion& other, const Vec3& point) const;
  /// Sum of the impulses pushed, about the origin.
  const Vec6& pushed() const { return pushed_; }
  void set_pushed(const Vec6& pushed) { pushed_ = pushed; }

  /// Notes an impulse of contact on the link [N s], and what was lost where they met [J].
  void take(const Vec3& impulse, const Vec3& point, double loss) {
    taken_.head<3>() += (point - centre_).cross(impulse);
    taken_.tail<3>() += impulse;
    lost_ += loss;
  }
  /// Impulse that contact has given since clear_taken(), about the origin; [N m s], [N s].
  const Vec6& taken() const { return taken_; }
  double lost() const { return lost_; }
  void clear_taken() {
    taken_.setZero();
    lost_ = 0.0;
  }

  // Interface of a rigid body. The robot has found pose and twist when the body asks for them.
  Twist merged(const Twist& own, const Twist& /*prescribed*/) const override { return own; }
  Twist advance(Pose& pose, const Twist& /*twist*/, double /*dt*/) override {
    pose = next_pose_;
    return next_twist_;
  }
  double unprescribed_acceleration(double /*gravity*/) const override { return acceleration_; }
  std::string refused_velocity() const override;
  std::string refused_pose() const override { return refused_velocity(); }

 private:
  Articulation* robot_;
  LinkResponse* response_;
  int place_ = -1;
  Vec6 pushed_ = Vec6::Zero(), taken_ = Vec6::Zero();
  double lost_ = 0.0;          ///< [J]
  double acceleration_ = 0.0;  ///< [m/s^2]
  Pose next_pose_;
  Twist next_twist_;
};

}  // namespace mpm
