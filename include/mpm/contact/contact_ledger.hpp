// Books the impulses that one rigid body gave to the material by contact, and reports the opposite, the action of the
// material on the body: wrench, peak, friction and pressing parts, centre of pressure, work, and the energy that
// friction took. Sums run since the start; a reader remembers those of its last call and reports the difference, and
// the peak since.
//
// What is reported is what was applied: the wrench is the sum of the impulses over the time they took, torque about the
// body's origin as it moves. In an axisymmetric scene reports leave out what cancels around the axis; the account keeps
// it, as radial momentum.
#pragma once

#include <vector>

#include "mpm/contact/contact_report.hpp"
#include "mpm/rigid/rigid_body.hpp"
#include "mpm/step/node_loss.hpp"
#include "mpm/step/stage.hpp"

namespace mpm {

/// One impulse of contact on the material.
struct ContactImpulse {
  Vec3 impulse;                   ///< [N s]
  Vec3 normal;                    ///< out of the body
  Vec3 arm;                       ///< from the body's origin [m]
  Vec3 velocity;                  ///< velocity of the body's surface there [m/s]
  Vec3 mean_slip = Vec3::Zero();  ///< slip of the material against it, mean of the ends of the last step and this [m/s]
};

/// Sums of what contact has done since the start.
struct ContactSums {
  Vec3 impulse = Vec3::Zero();          ///< on the body [N s]
  Vec3 angular_impulse = Vec3::Zero();  ///< about the body's origin as it moves [N m s]
  Vec3 friction = Vec3::Zero();         ///< the part of impulse along the surface [N s]
  double pressed = 0.0;                 ///< normal impulses [N s]
  Vec3 pressed_arm = Vec3::Zero();      ///< arms times those magnitudes [N s m]
  double area_time = 0.0;               ///< area in contact, over time [m^2 s]
  double friction_energy = 0.0;         ///< taken by sliding [J]
  double held_energy = 0.0;             ///< energy of motion that contact held up [J]
  double work = 0.0;                    ///< done by the body on the material [J]
};

class ContactLedger {
 public:
  /// `body` must outlive the ledger. The ledger has one reader at first, number 0.
  ContactLedger(const RigidBody& body, bool axisymmetric);

  void give(const ContactImpulse& given);
  /// Adds what impulses took that were given without a slip.
  void add_loss(const SurfaceLoss& loss) {
    sums_.friction_energy += loss.friction;
    sums_.held_energy += loss.held;
  }
  /// Call when all impulses of a step have been given. `places`: nodes or points in contact; `area` [m^2].
  void end_step(double dt, int places, double area);

  /// Adds a reader, whose reports begin at the time `now` [s], and returns its number. A run that reads a checkpoint
  /// must have added the same readers before.
  int add_reader(double now);
  /// Returns the action of the material on the body since this reader's last call; `now` [s]. Reports of other readers
  /// do not change.
  ContactReport read(double now, int reader = 0);
  /// Writes or reads the sums and the readers, for checkpoints.
  void serialise(StateArchive& archive);

  const RigidBody& body() const { return body_; }
  /// Adds the work of the body on the material, the energy that sliding on it took, and that of motion which it held
  /// up.
  void energies(EnergyReport& report) const {
    report.add("contact_work", NamedEnergy::Kind::work, sums_.work);
    report.add("friction", NamedEnergy::Kind::dissipated, sums_.friction_energy);
    report.add("contact_loss", NamedEnergy::Kind::dissipated, sums_.held_energy);
  }
  const ImpulseAccount& account() const { return account_; }  ///< impulses given to the material
  const ContactSums& sums() const { return sums_; }

 private:
  /// The state of the sums at a reader's last call.
  struct Reader {
    double time = 0.0;  ///< time of its last call [s]
    ContactSums last;
    Wrench peak;  ///< since then
  };
  /// A sum over the whole body: in an axisymmetric scene all but the component along the axis cancels.
  Vec3 whole(const Vec3& sum) const { return axisymmetric_ ? Vec3(0.0, 0.0, sum.z()) : sum; }

  const RigidBody& body_;
  bool axisymmetric_;
  ImpulseAccount account_;
  ContactSums sums_;
  std::vector<Reader> readers_;
  Vec3 given_ = Vec3::Zero();          ///< in this step [N s]
  Vec3 given_angular_ = Vec3::Zero();  ///< about the body's origin [N m s]
  int places_ = 0;
};

}  // namespace mpm
