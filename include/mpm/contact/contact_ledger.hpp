// Books what contact gave to the material on behalf of one rigid body, and reports it as what the material did to the
// body: wrench, peak, friction and pressing parts, centre of pressure, work, and the energy that friction took.
//
// What is reported is what was applied: the wrench is the sum of the impulses over the time they took, torque about the
// body's origin as it moves. In an axisymmetric scene reports leave out what cancels around the axis; the account keeps
// it, as radial momentum.
#pragma once

#include "mpm/contact/contact_report.hpp"
#include "mpm/rigid/rigid_body.hpp"
#include "mpm/step/stage.hpp"

namespace mpm {

/// One impulse of contact on the material.
struct ContactImpulse {
  Vec3 impulse;                   ///< [N s]
  Vec3 normal;                    ///< out of the body
  Vec3 arm;                       ///< from the body's origin [m]
  Vec3 velocity;                  ///< of the body's surface there [m/s]
  Vec3 mean_slip = Vec3::Zero();  ///< of the material against it, mean of before and after the impulse [m/s]
};

class ContactLedger {
 public:
  /// `body` outlives the ledger.
  ContactLedger(const RigidBody& body, bool axisymmetric);

  void give(const ContactImpulse& given);
  /// The step's impulse is known. `places`: nodes or points in contact; `area` [m^2].
  void end_step(double dt, int places, double area);
  /// What the material did to the body since the last call; `now` [s].
  ContactReport take(double now);
  /// For checkpoints.
  void keep(StateArchive& archive);

  const RigidBody& body() const { return body_; }
  /// Work of the body on the material, and what sliding on it took.
  void energies(EnergyReport& report) const {
    report.add("contact_work", NamedEnergy::Kind::work, work_);
    report.add("friction", NamedEnergy::Kind::dissipated, friction_energy_);
  }
  const ImpulseAccount& account() const { return account_; }   ///< given to the material
  double work() const { return work_; }                        ///< of the body on the material since the start [J]
  double friction_energy() const { return friction_energy_; }  ///< that sliding took since the start [J]

 private:
  /// What is left of a sum over the whole body.
  Vec3 whole(const Vec3& sum) const { return axisymmetric_ ? Vec3(0.0, 0.0, sum.z()) : sum; }

  const RigidBody& body_;
  bool axisymmetric_;
  ImpulseAccount account_;
  Vec3 given_ = Vec3::Zero();          ///< in this step [N s]
  Vec3 given_angular_ = Vec3::Zero();  ///< about the body's origin [N m s]
  double work_ = 0.0, friction_energy_ = 0.0;

  Vec3 impulse_ = Vec3::Zero();          ///< on the body since the last report [N s]
  Vec3 angular_impulse_ = Vec3::Zero();  ///< [N m s]
  Vec3 friction_ = Vec3::Zero();         ///< the part of impulse_ along the surface [N s]
  double pressed_ = 0.0;                 ///< normal impulses since the last report [N s]
  Vec3 pressed_arm_ = Vec3::Zero();      ///< arms times those magnitudes [N s m]
  Wrench peak_;
  int places_ = 0;
  double area_time_ = 0.0;  ///< area in contact, over time, since the last report [m^2 s]
  double last_report_ = 0.0;
};

}  // namespace mpm
