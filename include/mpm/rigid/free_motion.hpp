// The motion of a rigid body that has a mass: Newton's and Euler's equations with impulses.
//
// A step: predict() adds gravity and the applied wrench to the velocity; contact pushes it, together with the nodes
// that it touches (contact/point_contact.hpp); finish() books what each gave; advance() moves the body. Velocities are
// those of the centre of mass. Each of the six degrees of freedom is free or prescribed; a prescribed one
// does not change by an impulse, and the impulse that it takes to prescribe it is booked as the drive's.
//
// Semi-implicit: the velocity of the step's end moves the body, as in the material, so the energy of free fall has
// a constant error, that of half a step's fall. Where all rotations are free, the angular momentum is carried from step
// to step: it is conserved to round-off with any inertia, and the rotation rate follows from it. The rotation of a step
// is computed with the rate at its middle (implicit midpoint, found by iteration): the energy of a body that spins
// without torque varies by the square of a step's angle and does not drift.
//
// Weak: if only some rotations are prescribed, the gyroscopic torque is that of the step's start, of first order.
// Source: Newton-Euler equations; midpoint rule on SO(3) with spatial angular momentum: Simo & Wong (1991), section 3.
#pragma once

#include <array>
#include <string>

#include "mpm/math/state_archive.hpp"
#include "mpm/rigid/dynamic_motion.hpp"

namespace mpm {

/// The definition of a free body.
struct FreeDefinition {
  double mass = 0.0;            ///< [kg]; in a planar scene of the whole thickness
  Vec3 centre = Vec3::Zero();   ///< centre of mass, body axes [m]
  Mat3 inertia = Mat3::Zero();  ///< about the centre of mass, body axes [kg m^2]
  /// Marks of free velocities, world axes: x, y, z, then the rotation rates about them.
  std::array<bool, 6> axes = {true, true, true, true, true, true};
  /// Marks of those of these degrees of freedom that the scene's geometry has.
  std::array<bool, 6> present = {true, true, true, true, true, true};
  Twist velocity;  ///< at the start, of the body's origin
  Wrench wrench;   ///< acts until another one is applied

  bool all_free() const { return axes == present; }
};

/// A linear and an angular part; the angular one about the centre of mass. [N s], [N m s]
struct BodyMomentum {
  Vec3 linear = Vec3::Zero();
  Vec3 angular = Vec3::Zero();

  BodyMomentum& operator+=(const BodyMomentum& other) {
    linear += other.linear;
    angular += other.angular;
    return *this;
  }
};

/// Counts since the start of the run: momentum = that of the start + contact + gravity + wrench + drive + set.
struct FreeAccount {
  BodyMomentum initial_momentum;
  BodyMomentum contact;  ///< from the material, other bodies and walls
  BodyMomentum gravity;
  BodyMomentum wrench;        ///< applied by apply_wrench()
  BodyMomentum drive;         ///< needed to keep prescribed velocities
  BodyMomentum set;           ///< given by put()
  double set_work = 0.0;      ///< the same of kinetic and potential energy [J]
  double wrench_work = 0.0;   ///< done by the wrench [J]
  double drive_work = 0.0;    ///< done by the drive [J]
  double contact_loss = 0.0;  ///< lost where the body and the material met, sliding left out [J]
};

/// A count of an account, by its name in checkpoints.
template <class Count>
struct FreeCount {
  const char* name;
  Count FreeAccount::*count;
};
inline constexpr FreeCount<BodyMomentum> kFreeMomenta[] = {
    {"initial", &FreeAccount::initial_momentum}, {"contact", &FreeAccount::contact}, {"gravity", &FreeAccount::gravity},
    {"applied", &FreeAccount::wrench},           {"drive", &FreeAccount::drive},     {"set", &FreeAccount::set}};
inline constexpr FreeCount<double> kFreeEnergies[] = {{"wrench_work", &FreeAccount::wrench_work},
                                                      {"drive_work", &FreeAccount::drive_work},
                                                      {"loss", &FreeAccount::contact_loss},
                                                      {"set_work", &FreeAccount::set_work}};

struct FreeBodyReport : FreeAccount {
  std::string body;
  double mass = 0.0;           ///< [kg]
  Vec3 centre = Vec3::Zero();  ///< centre of mass, world [m]
  BodyMomentum momentum;
  double kinetic = 0.0;    ///< [J]
  double potential = 0.0;  ///< -m g.x [J]
};

class FreeMotion final : public DynamicMotion {
 public:
  /// `name`: of the body, for errors. @throws RigidError when mass or inertia are impossible.
  FreeMotion(const FreeDefinition& definition, const std::string& name);

  const FreeDefinition& definition() const { return definition_; }
  bool is_free(int axis) const { return definition_.axes[axis]; }
  /// `prescribed` where a velocity is prescribed, `own` where the body is free.
  Twist merged(const Twist& own, const Twist& prescribed) const override;
  /// The wrench acts from now on; torque about the body's origin.
  void apply_wrench(const Wrench& wrench) { wrench_ = wrench; }
  const Wrench& wrench() const { return wrench_; }

  /// Begins the run with this twist of the origin.
  void start(const Pose& pose, const Twist& twist);
  /// Puts it elsewhere between two steps, with this twist of the origin, and books what it gains. `gravity` [m/s^2]
  void put(const Pose& pose, const Twist& twist, const Vec3& gravity);
  /// Computes the step's velocity without contact. `twist`: of the origin, with the prescribed parts of this step.
  void predict(const Pose& pose, const Twist& twist, const Vec3& gravity, double dt);
  void push(const Vec3& impulse, const Vec3& point) override {
    velocity_ += inverse_mass_.cwiseProduct(impulse);
    rate_ += lifted_ * (point - centre_).cross(impulse);
  }
  Mat3 compliance_at(const Vec3& point) const override;
  /// Begins a trial: what is pushed between the two calls is forgotten at the second. `twist`: as predict() has it.
  void begin_trial(const Pose& pose, const Twist& twist);
  void end_trial();
  /// Sets velocities to zero; they are increments until end_increment() adds them to the previous velocities.
  void begin_increment();
  void end_increment();
  /// Books the `impulse` of contact, about the centre of mass, and the loss of energy [J]. Called once more in a step
  /// for an increment.
  void finish(const BodyMomentum& impulse, double loss);
  /// Moves the pose by the velocity after finish(). @return the twist of the origin at the new pose.
  Twist advance(Pose& pose, const Twist& twist, double dt) override;
  double unprescribed_acceleration(double gravity) const override {
    return gravity + wrench_.force.norm() / definition_.mass;
  }
  std::string refused_velocity() const override;
  std::string refused_pose() const override;

  /// `gravity` [m/s^2]
  FreeBodyReport report(const std::string& name, const Vec3& gravity) const;

  void serialise(StateArchive& archive);

 private:
  Mat3 inertia_at(const Quat& orientation) const;
  void begin_at(const Pose& pose, const Twist& twist);
  /// Takes over where the body is: its centre of mass, and its inertia about the world's axes.
  void place(const Pose& pose);
  /// Rotation rate by angular momentum, of the free rotations alone [1/(kg m^2)].
  Mat3 lift_of(const Mat3& inertia) const;
  BodyMomentum momentum() const { return {definition_.mass * velocity_, inertia_ * rate_}; }
  /// The prescribed components of a vector of translations (`first` 0) or rotations (3); others are 0.
  Vec3 prescribed_part(const Vec3& vector, int first) const;

  FreeDefinition definition_;
  bool turns_freely_ = false;  ///< angular momentum is carried from step to step
  Wrench wrench_;

  // State within the step.
  Vec3 kept_velocity_ = Vec3::Zero(), kept_rate_ = Vec3::Zero();  ///< without contact, the increment or the trial
  Vec3 inverse_mass_ = Vec3::Zero();
  Mat3 inertia_ = Mat3::Zero(), lifted_ = Mat3::Zero();
  BodyMomentum step_wrench_, step_drive_;

  FreeAccount account_;
};

}  // namespace mpm
