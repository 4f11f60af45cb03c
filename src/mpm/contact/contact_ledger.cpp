#include "mpm/contact/contact_ledger.hpp"

#include <algorithm>

#include "mpm/shape/ring.hpp"

namespace mpm {

ContactLedger::ContactLedger(const RigidBody& body, bool axisymmetric) : body_(body), axisymmetric_(axisymmetric) {
  account_.name = "contact/" + body.name();
}

void ContactLedger::give(const ContactImpulse& given) {
  const double normal = given.impulse.dot(given.normal);
  const Vec3 along = given.impulse - normal * given.normal;
  given_ += given.impulse;
  given_angular_ += given.arm.cross(given.impulse);
  friction_ -= along;
  pressed_ += std::max(normal, 0.0);  // what adheres may pull
  pressed_arm_ += std::max(normal, 0.0) * given.arm;
  work_ += given.impulse.dot(given.velocity);
  friction_energy_ -= along.dot(given.mean_slip);
}

void ContactLedger::end_step(double dt, int places, double area) {
  account_.add(given_);
  impulse_ -= given_;
  angular_impulse_ -= given_angular_;
  Wrench wrench{whole(-given_ / dt), Vec3::Zero()};
  if (!axisymmetric_) wrench.torque = -given_angular_ / dt;
  if (wrench.force.squaredNorm() > peak_.force.squaredNorm()) peak_ = wrench;
  given_ = given_angular_ = Vec3::Zero();
  places_ = places;
  area_time_ += area * dt;
}

ContactReport ContactLedger::take(double now) {
  ContactReport report;
  report.body = body_.name();
  report.interval = now - last_report_;
  if (report.interval > 0.0) {
    report.mean = {whole(impulse_ / report.interval), angular_impulse_ / report.interval};
    report.friction = whole(friction_ / report.interval);
    report.pressing = pressed_ / report.interval;
    report.area = area_time_ / report.interval;
  }
  report.origin = whole(body_.pose().position);
  if (pressed_ > 0.0) report.arm = whole(pressed_arm_ / pressed_);
  if (axisymmetric_) {
    report.mean.torque.setZero();
    if (report.interval > 0.0) report.per_radian = impulse_ / (report.interval * kTurn);
  }
  report.peak = peak_;
  report.nodes = places_;
  report.friction_energy = friction_energy_;
  report.impulse = whole(-account_.impulse);
  impulse_ = angular_impulse_ = friction_ = pressed_arm_ = Vec3::Zero();
  pressed_ = area_time_ = 0.0;
  peak_ = {};
  last_report_ = now;
  return report;
}

void ContactLedger::keep(StateArchive& archive) {
  account_.keep(archive);
  archive.keep("given", given_);
  archive.keep("given_angular", given_angular_);
  archive.keep("work", work_);
  archive.keep("friction_energy", friction_energy_);
  archive.keep("impulse_since", impulse_);
  archive.keep("angular_impulse_since", angular_impulse_);
  archive.keep("friction_since", friction_);
  archive.keep("pressed_since", pressed_);
  archive.keep("pressed_arm_since", pressed_arm_);
  archive.keep("peak_force", peak_.force);
  archive.keep("peak_torque", peak_.torque);
  archive.keep("places", places_);
  archive.keep("area_time", area_time_);
  archive.keep("last_report", last_report_);
}

}  // namespace mpm
