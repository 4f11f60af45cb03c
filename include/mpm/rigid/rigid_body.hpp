// A rigid body: a surface whose motion is prescribed, or, where it is free, follows from forces
// (rigid/free_motion.hpp), or is that of a robot's link (rigid/link_motion.hpp). What prescribes it is kept here too
// (functions of time, a twist, a pose to be reached at a time), so that pose and twist come from one place.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "mpm/math/function.hpp"
#include "mpm/math/state_archive.hpp"
#include "mpm/rigid/body_motion.hpp"
#include "mpm/rigid/collide.hpp"
#include "mpm/rigid/contact_law.hpp"
#include "mpm/rigid/free_motion.hpp"
#include "mpm/rigid/link_motion.hpp"
#include "mpm/rigid/motion.hpp"
#include "mpm/rigid/surface.hpp"

namespace mpm {

/// Choice of whether the material on the two sides of a body has a velocity field each (contact/tool_sides.hpp).
/// Automatic: if the body is thinner than three cells somewhere.
enum class Sides { automatic, one, two };

/// The pose with its quaternion at unit length. `what`: begins an error.
/// @throws RigidError when not finite, or the quaternion's length is not 1 within 1e-3
Pose checked_pose(const Pose& pose, const std::string& what);

/// The definition of a rigid body.
struct RigidBodyDefinition {
  std::string name;
  std::shared_ptr<const Surface> surface;
  Pose pose;                              ///< at time zero
  std::array<Function, 3> velocity;       ///< velocity of the origin, world axes, functions of t [m/s]
  std::array<Function, 3> rotation_rate;  ///< world axes, functions of t [rad/s]
  FrictionLaw friction;
  /// Distance outside the surface within which nodes are in contact too, in [0, 1] cells; contact begins earlier by as
  /// much. 1: the nodes that the shape functions of a rigid body made of particles would reach.
  double reach = 0.0;
  Sides sides = Sides::automatic;
  /// Names of the deformable bodies whose material has two sides at this body, if it has sides at all; empty: all.
  std::vector<std::string> divides;
  /// The mass of a free body, and which of its velocities are free. Without it all velocities are prescribed.
  std::optional<FreeDefinition> free;
  /// Contact with other rigid bodies that have this, and walls. Without it, it passes through them.
  std::optional<CollideDefinition> collide;
  /// True if the body is filled with particles; contact is then found from volumes and volume gradients at nodes
  /// (contact/rigid_particle_contact.hpp) instead of the surface.
  bool particles = false;
  /// Radius [m] of a ring in an axisymmetric scene, as its surface was made; 0 for any other body. A ring opens and
  /// closes along x: pose.position.x is the change of its radii [m].
  double inner_radius = 0.0;
  double outer_radius = 0.0;  ///< outer radius of a ring [m]
};

/// Input that a body follows at the moment.
enum class Drive : std::uint8_t { functions = 0, velocity = 1, pose = 2 };

class RigidBody {
 public:
  /// @throws RigidError when it has no name or shape, or a number that is impossible.
  explicit RigidBody(RigidBodyDefinition definition);

  const RigidBodyDefinition& definition() const { return definition_; }
  const std::string& name() const { return definition_.name; }
  const Surface& surface() const { return *definition_.surface; }
  const FrictionLaw& friction() const { return definition_.friction; }
  double reach() const { return definition_.reach; }
  const Pose& pose() const { return pose_; }
  const Twist& twist() const { return twist_; }
  Drive drive() const { return drive_; }
  /// Bounds of the surface now [m]; a body that is endless along an axis stays endless.
  Box world_bounds() const { return mpm::world_bounds(pose_, surface().bounds()); }
  /// The motion of the body: prescribed, as a ring, free, or that of a robot's link.
  const BodyMotion& motion() const {
    return std::visit([](const BodyMotion& motion) -> const BodyMotion& { return motion; }, motion_);
  }
  /// Velocity of the surface at a world point [m/s].
  Vec3 velocity_at(const Vec3& point) const { return motion().velocity_at(pose_, twist_, point); }

  /// Null unless some of its velocities are free.
  FreeMotion* free_motion() { return std::get_if<FreeMotion>(&motion_); }
  const FreeMotion* free_motion() const { return std::get_if<FreeMotion>(&motion_); }
  /// The motion of a robot's link; null for other bodies.
  LinkMotion* link_motion() { return std::get_if<LinkMotion>(&motion_); }
  const LinkMotion* link_motion() const { return std::get_if<LinkMotion>(&motion_); }
  /// The motion that contact changes: of a free body, or of a link that impulses move. Null for others.
  DynamicMotion* dynamic_motion() {
    if (FreeMotion* free = free_motion()) return free;
    LinkMotion* link = link_motion();
    return link != nullptr && link->responds() ? link : nullptr;
  }
  const DynamicMotion* dynamic_motion() const { return const_cast<RigidBody*>(this)->dynamic_motion(); }
  /// Makes the body a link of a robot, which puts it at `pose`.
  LinkMotion& join(Articulation& robot, LinkResponse& response, const Pose& pose) {
    pose_ = pose;
    return motion_.emplace<LinkMotion>(robot, response);
  }
  /// Sets pose and twist between two steps, and ends a pose command. The twist is that of free velocities, others go on
  /// as they are prescribed; what a free body gains is booked. `gravity` [m/s^2]: for that account.
  /// @throws RigidError, when nothing is changed: not finite, a pose that the body cannot have, or a twist for a body
  /// that only moves as prescribed
  void set_state(const Pose& pose, const Twist& twist, const Vec3& gravity);
  /// Sets the pose of a link between two steps.
  void put(const Pose& pose) { pose_ = pose; }
  /// Sets the twist of a free body or a link after contact and forces.
  void set_twist(const Twist& twist) { twist_ = twist; }

  /// Prescribes a constant twist from now on; free velocities are not changed. @throws RigidError when not finite, or
  /// when all velocities are free.
  void command_velocity(const Twist& twist);
  /// Applies a wrench to a free body from now on. @throws RigidError when not finite, or the body has no mass.
  void apply_wrench(const Wrench& wrench);
  /// Prescribes a constant twist from `now` that reaches `target` at `arrival` > now [ns], and rest after that.
  /// @throws RigidError when not finite, the quaternion's length is not 1 within 1e-3, arrival is not after now, a
  /// ring would be closed there, or the body is free.
  void command_pose(const Pose& target, std::int64_t now, std::int64_t arrival);

  /// The twist of a step that begins at `time` [s], as far as it is known now; free velocities are the present ones.
  /// @throws FunctionError when a function is not finite there.
  Twist twist_at(double time) const;
  /// Sets the twist for the step that begins at `time` [s] and lasts `dt` [s]: functions are read at its middle.
  /// @throws FunctionError when a function is not finite there.
  void begin_step(double time, double dt);
  /// Moves the pose by the twist over `dt` [s]. @throws RigidError when a ring has closed.
  void end_step(double dt);
  /// At a sync point: a body that has reached its target pose is put exactly there. Its twist stays that of the step
  /// just made; it rests from the next step on, unless a command says otherwise.
  void at_sync(std::int64_t now);
  /// Writes or reads its pose, its twist and what it follows, for checkpoints.
  void serialise(StateArchive& archive);

 private:
  /// @throws RigidError for a pose that the body cannot have.
  void check(const Pose& pose, const char* what) const;

  RigidBodyDefinition definition_;
  Pose pose_;
  Twist twist_;
  Drive drive_ = Drive::functions;
  Pose target_;
  std::int64_t arrival_ = 0;
  std::variant<PrescribedMotion, RingMotion, FreeMotion, LinkMotion> motion_;
};

}  // namespace mpm
