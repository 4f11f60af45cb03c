#include "mpm/contact/contact_ledger.hpp"

#include <algorithm>
#include <utility>

#include "mpm/shape/ring.hpp"

namespace mpm {
namespace {

void serialise_sums(StateArchive& archive, ContactSums& sums) {
  archive.value("impulse", sums.impulse);
  archive.value("angular_impulse", sums.angular_impulse);
  archive.value("friction", sums.friction);
  archive.value("pressed", sums.pressed);
  archive.value("pressed_arm", sums.pressed_arm);
  archive.value("area_time", sums.area_time);
  archive.value("friction_energy", sums.friction_energy);
  archive.value("held_energy", sums.held_energy);
  archive.value("work", sums.work);
}

}  // namespace

ContactLedger::ContactLedger(const RigidBody& body, bool axisymmetric)
    : body_(body), axisymmetric_(axisymmetric), readers_(1) {
  account_.name = "contact/" + body.name();
}

void ContactLedger::give(const ContactImpulse& given) {
  const double normal = given.impulse.dot(given.normal);
  const Vec3 along = given.impulse - normal * given.normal;
  given_ += given.impulse;
  given_angular_ += given.arm.cross(given.impulse);
  sums_.friction -= along;
  sums_.pressed += std::max(normal, 0.0);  // leaves out pull by adhesion
  sums_.pressed_arm += std::max(normal, 0.0) * given.arm;
  sums_.work += given.impulse.dot(given.velocity);
  sums_.friction_energy -= along.dot(given.mean_slip);
}

void ContactLedger::end_step(double dt, int places, double area) {
  account_.add(given_);
  sums_.impulse -= given_;
  sums_.angular_impulse -= given_angular_;
  Wrench wrench{whole(-given_ / dt), Vec3::Zero()};
  if (!axisymmetric_) wrench.torque = -given_angular_ / dt;
  for (Reader& reader : readers_) {
    if (wrench.force.squaredNorm() > reader.peak.force.squaredNorm()) reader.peak = wrench;
  }
  given_ = given_angular_ = Vec3::Zero();
  places_ = places;
  sums_.area_time += area * dt;
}

int ContactLedger::add_reader(double now) {
  readers_.push_back({now, sums_, {}});
  return static_cast<int>(readers_.size()) - 1;
}

ContactReport ContactLedger::read(double now, int reader) {
  Reader& own = readers_[reader];
  const ContactSums before = std::exchange(own.last, sums_);
  ContactReport report;
  report.body = body_.name();
  report.interval = now - std::exchange(own.time, now);
  if (report.interval > 0.0) {
    const Vec3 mean = (sums_.impulse - before.impulse) / report.interval;
    report.mean.force = whole(mean);
    report.friction = whole((sums_.friction - before.friction) / report.interval);
    report.pressing = (sums_.pressed - before.pressed) / report.interval;
    report.area = (sums_.area_time - before.area_time) / report.interval;
    if (axisymmetric_) {
      report.per_radian = mean / kTurn;
    } else {
      report.mean.torque = (sums_.angular_impulse - before.angular_impulse) / report.interval;
    }
  }
  report.origin = whole(body_.pose().position);
  if (const double pressed = sums_.pressed - before.pressed; pressed > 0.0) {
    report.arm = whole((sums_.pressed_arm - before.pressed_arm) / pressed);
  }
  report.peak = own.peak;
  own.peak = {};
  report.nodes = places_;
  report.friction_energy = sums_.friction_energy;
  report.impulse = whole(-account_.impulse);
  return report;
}

void ContactLedger::serialise(StateArchive& archive) {
  account_.serialise(archive);
  archive.value("given", given_);
  archive.value("given_angular", given_angular_);
  archive.value("places", places_);
  {
    const StateArchive::Group group(archive, "sums");
    serialise_sums(archive, sums_);
  }
  for (std::size_t r = 0; r < readers_.size(); ++r) {
    const StateArchive::Group group(archive, "reader_" + std::to_string(r));
    archive.value("time", readers_[r].time);
    serialise_sums(archive, readers_[r].last);
    archive.value("peak_force", readers_[r].peak.force);
    archive.value("peak_torque", readers_[r].peak.torque);
  }
}

}  // namespace mpm
