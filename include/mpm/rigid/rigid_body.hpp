// A rigid body: a surface whose motion is prescribed, or, where it is free, follows from forces
// (rigid/free_motion.hpp). What prescribes it lives here too (functions of time, a twist, a pose to be at by a time),
// so that pose and twist come from one place.
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
#include "mpm/rigid/contact_law.hpp"
#include "mpm/rigid/free_motion.hpp"
#include "mpm/rigid/motion.hpp"
#include "mpm/rigid/surface.hpp"

namespace mpm {

/// Whether the material on the two sides of a body has a velocity field each (contact/tool_sides.hpp). Automatic: if
/// the body is thinner than three cells somewhere.
enum class Sides { automatic, one, two };

/// What a scene says of a rigid body.
struct RigidBodyDefinition {
  std::string name;
  std::shared_ptr<const Surface> surface;
  Pose pose;                              ///< at time zero
  std::array<Function, 3> velocity;       ///< of the origin, world axes, functions of t [m/s]
  std::array<Function, 3> rotation_rate;  ///< world axes, functions of t [rad/s]
  FrictionLaw friction;
  /// How far outside the surface nodes are held too, in [0, 1] cells. 1: the nodes that the shape functions of a rigid
  /// body made of particles would reach; material is met that much early.
  double reach = 0.0;
  Sides sides = Sides::automatic;
  /// Names of the deformable bodies whose material has two sides at this body, if it has sides at all; empty: all.
  std::vector<std::string> divides;
  /// A body with a mass, of which some velocities or all are free; the others are prescribed. Without: all are
  /// prescribed.
  std::optional<FreeDefinition> free;
  /// Filled with particles, and met by volumes and volume gradients at nodes (contact/rigid_particle_contact.hpp) in
  /// place of the surface.
  bool particles = false;
  /// Of a ring in an axisymmetric scene, as its surface was made; 0: of any other body. A ring opens and closes along
  /// x: pose.position.x is the change of its radii [m].
  double inner_radius = 0.0;
  double outer_radius = 0.0;  ///< of such a ring [m]
};

/// What a body follows at the moment.
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
  /// Where the surface is now [m]; a body that is endless along an axis stays endless.
  Box world_bounds() const { return mpm::world_bounds(pose_, surface().bounds()); }
  /// How it moves, as prescribed or freely.
  const BodyMotion& motion() const {
    return std::visit([](const BodyMotion& motion) -> const BodyMotion& { return motion; }, motion_);
  }
  /// Velocity of the surface at a world point [m/s].
  Vec3 velocity_at(const Vec3& point) const { return motion().velocity_at(pose_, twist_, point); }

  /// Null unless some of its velocities are free.
  FreeMotion* free_motion() { return std::get_if<FreeMotion>(&motion_); }
  const FreeMotion* free_motion() const { return std::get_if<FreeMotion>(&motion_); }
  /// Where it is free: what contact and forces have made of it.
  void set_twist(const Twist& twist) { twist_ = twist; }

  /// Constant twist from now on; where the body is free it keeps its own. @throws RigidError when not finite, or when
  /// all of it is free.
  void command_velocity(const Twist& twist);
  /// A force on a free body from now on. @throws RigidError when not finite, or the body has no mass.
  void apply_wrench(const Wrench& wrench);
  /// Constant twist from `now` that arrives at `target` at `arrival` > now [ns], then rest.
  /// @throws RigidError when not finite, the quaternion's length is not 1 within 1e-3, arrival is not after now, a
  /// ring would be closed there, or the body is free.
  void command_pose(const Pose& target, std::int64_t now, std::int64_t arrival);

  /// The twist that the step which begins at `time` [s] would have, as far as it is known now: free parts as they are.
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
  /// For checkpoints: where it is, and what it follows.
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
  std::variant<PrescribedMotion, RingMotion, FreeMotion> motion_;
};

}  // namespace mpm
