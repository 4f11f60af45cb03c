#include "mpm/rigid/free_motion.hpp"

#include <fmt/core.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>

#include "mpm/rigid/surface.hpp"

namespace mpm {
namespace {

constexpr int kMidpointRounds = 4;  ///< each gains a factor of a step's angle
constexpr double kRoundOff = 1e-9;  ///< part of the largest moment of inertia

void check(const FreeDefinition& free, const std::string& name) {
  const std::string start = fmt::format("rigid body '{}': free: ", name);
  if (!(free.mass > 0.0) || !std::isfinite(free.mass)) {
    throw RigidError(start + fmt::format("mass is {:g} kg; it must be positive and finite", free.mass));
  }
  if (!free.centre.allFinite()) throw RigidError(start + "the centre of mass is not finite");
  if (!free.wrench.force.allFinite() || !free.wrench.torque.allFinite()) {
    throw RigidError(start + "the wrench is not finite");
  }
  if (!free.velocity.linear.allFinite() || !free.velocity.angular.allFinite()) {
    throw RigidError(start + "the velocity at the start is not finite");
  }
  if (!free.inertia.allFinite()) throw RigidError(start + "the inertia is not finite");
  for (int k = 0; k < 3; ++k) {
    if (!free.axes[3 + k] || free.inertia(k, k) > 0.0) continue;
    throw RigidError(start + fmt::format("its rotation is free, and the moment of inertia about {} is {:g} kg m^2; "
                                         "it must be positive",
                                         "xyz"[k], free.inertia(k, k)));
  }
  if (!(free.axes[3] && free.axes[4] && free.axes[5])) return;
  if ((free.inertia - free.inertia.transpose()).norm() > kRoundOff * free.inertia.norm()) {
    throw RigidError(start + "the inertia is not symmetric");
  }
  const Vec3 moments = Eigen::SelfAdjointEigenSolver<Mat3>(free.inertia).eigenvalues();  // ascending
  if (!(moments[0] > 0.0)) throw RigidError(start + "a principal moment of inertia is not positive");
  if (moments[2] > (1.0 + kRoundOff) * (moments[0] + moments[1])) {
    throw RigidError(start + fmt::format("no body has the principal moments of inertia {:g}, {:g} and {:g} kg m^2: the "
                                         "largest is more than the sum of the others",
                                         moments[0], moments[1], moments[2]));
  }
}

}  // namespace

FreeMotion::FreeMotion(const FreeDefinition& definition, const std::string& name) : definition_(definition) {
  check(definition_, name);
  wrench_ = definition_.wrench;
  turns_freely_ = is_free(3) && is_free(4) && is_free(5);
  for (int k = 0; k < 3; ++k) inverse_mass_[k] = is_free(k) ? 1.0 / definition_.mass : 0.0;
}

Twist FreeMotion::merged(const Twist& own, const Twist& prescribed) const {
  Twist twist = prescribed;
  for (int k = 0; k < 3; ++k) {
    if (is_free(k)) twist.linear[k] = own.linear[k];
    if (is_free(3 + k)) twist.angular[k] = own.angular[k];
  }
  return twist;
}

Vec3 FreeMotion::prescribed_part(const Vec3& vector, int first) const {
  Vec3 part = vector;
  for (int k = 0; k < 3; ++k) {
    if (is_free(first + k)) part[k] = 0.0;
  }
  return part;
}

Mat3 FreeMotion::inertia_at(const Quat& orientation) const {
  const Mat3 axes = orientation.toRotationMatrix();
  return axes * definition_.inertia * axes.transpose();
}

Mat3 FreeMotion::lift_of(const Mat3& inertia) const {
  // Takes out what is prescribed: one on the diagonal, and zero in the inverse.
  Mat3 reduced = inertia;
  for (int k = 0; k < 3; ++k) {
    if (is_free(3 + k)) continue;
    reduced.row(k).setZero();
    reduced.col(k).setZero();
    reduced(k, k) = 1.0;
  }
  Mat3 lifted = reduced.inverse();
  for (int k = 0; k < 3; ++k) {
    if (!is_free(3 + k)) lifted(k, k) = 0.0;
  }
  return lifted;
}

void FreeMotion::start(const Pose& pose, const Twist& twist) {
  begin_at(pose, twist);
  account_.initial_momentum = momentum();
}

void FreeMotion::begin_at(const Pose& pose, const Twist& twist) {
  centre_ = pose.to_world(definition_.centre);
  rate_ = twist.angular;
  velocity_ = twist.linear + rate_.cross(centre_ - pose.position);
  inertia_ = inertia_at(pose.orientation);
}

void FreeMotion::put(const Pose& pose, const Twist& twist, const Vec3& gravity) {
  const FreeBodyReport before = report({}, gravity);
  begin_at(pose, twist);
  start_velocity_ = velocity_;
  start_rate_ = rate_;
  const FreeBodyReport now = report({}, gravity);
  account_.set.linear += now.momentum.linear - before.momentum.linear;
  account_.set.angular += now.momentum.angular - before.momentum.angular;
  account_.set_work += now.kinetic + now.potential - before.kinetic - before.potential;
}

void FreeMotion::place(const Pose& pose) {
  inertia_ = inertia_at(pose.orientation);
  lifted_ = lift_of(inertia_);
  centre_ = pose.to_world(definition_.centre);
}

void FreeMotion::begin_trial(const Pose& pose, const Twist& twist) {
  place(pose);
  kept_velocity_ = velocity_;
  kept_rate_ = rate_;
  velocity_ += prescribed_part(twist.linear - velocity_, 0);
  rate_ += prescribed_part(twist.angular - rate_, 3);
}

void FreeMotion::end_trial() {
  velocity_ = kept_velocity_;
  rate_ = kept_rate_;
}

void FreeMotion::predict(const Pose& pose, const Twist& twist, const Vec3& gravity, double dt) {
  start_velocity_ = velocity_;
  start_rate_ = rate_;
  place(pose);
  const Vec3 arm = centre_ - pose.position;
  const double mass = definition_.mass;
  const Vec3 weight = mass * gravity * dt;
  account_.gravity.linear += weight;
  step_wrench_ = {wrench_.force * dt, (wrench_.torque - arm.cross(wrench_.force)) * dt};
  account_.wrench += step_wrench_;

  const Vec3 prescribed_change = prescribed_part(twist.linear - velocity_, 0);
  const Vec3 prescribed_turn = prescribed_part(twist.angular - rate_, 3);
  Vec3 turning = step_wrench_.angular;
  if (!turns_freely_) turning -= dt * rate_.cross(inertia_ * rate_);
  velocity_ += prescribed_change + inverse_mass_.cwiseProduct(weight + step_wrench_.linear);
  rate_ += prescribed_turn + lifted_ * (turning - inertia_ * prescribed_turn);
  step_drive_.linear = prescribed_part(mass * prescribed_change - weight - step_wrench_.linear, 0);
  step_drive_.angular = prescribed_part(inertia_ * (rate_ - start_rate_) - turning, 3);
  kept_velocity_ = velocity_;
  kept_rate_ = rate_;
}

Mat3 FreeMotion::compliance_at(const Vec3& point) const {
  const Vec3 arm = point - centre_;
  Mat3 cross;
  cross << 0.0, -arm.z(), arm.y(), arm.z(), 0.0, -arm.x(), -arm.y(), arm.x(), 0.0;
  return Mat3(inverse_mass_.asDiagonal()) - cross * lifted_ * cross;
}

void FreeMotion::begin_increment() {
  kept_velocity_ = velocity_;
  kept_rate_ = rate_;
  velocity_.setZero();
  rate_.setZero();
}

void FreeMotion::end_increment() {
  velocity_ += kept_velocity_;
  rate_ += kept_rate_;
}

void FreeMotion::finish(const BodyMomentum& impulse, double loss) {
  account_.contact += impulse;
  step_drive_.linear -= prescribed_part(impulse.linear, 0);
  step_drive_.angular += prescribed_part(inertia_ * (rate_ - kept_rate_) - impulse.angular, 3);
  account_.contact_loss += loss;
}

std::string FreeMotion::refused_velocity() const {
  if (!definition_.all_free()) return {};
  return "it is free in all it can do, so there is no velocity to command; apply a wrench, or leave an axis out of "
         "free.axes";
}

std::string FreeMotion::refused_pose() const {
  return "pose command for a body that is free; command its velocity where it is prescribed, or apply a wrench";
}

Twist FreeMotion::advance(Pose& pose, const Twist& /*twist*/, double dt) {
  account_.drive += step_drive_;
  const Vec3 mean = 0.5 * (start_velocity_ + velocity_), mean_rate = 0.5 * (start_rate_ + rate_);
  account_.wrench_work += step_wrench_.linear.dot(mean) + step_wrench_.angular.dot(mean_rate);
  account_.drive_work += step_drive_.linear.dot(mean) + step_drive_.angular.dot(mean_rate);

  const Vec3 angular = inertia_ * rate_;
  Vec3 middle = rate_;
  for (int round = 0; turns_freely_ && round < kMidpointRounds; ++round) {
    const Pose half = integrate(pose, {Vec3::Zero(), middle}, 0.5 * dt);
    middle = inertia_at(half.orientation).inverse() * angular;
  }
  centre_ += dt * velocity_;
  pose.orientation = integrate(pose, {Vec3::Zero(), middle}, dt).orientation;
  pose.position = centre_ - pose.orientation * definition_.centre;
  inertia_ = inertia_at(pose.orientation);
  if (turns_freely_) rate_ = inertia_.inverse() * angular;
  return twist(pose);
}

FreeBodyReport FreeMotion::report(const std::string& name, const Vec3& gravity) const {
  FreeBodyReport report;
  static_cast<FreeAccount&>(report) = account_;
  report.body = name;
  report.mass = definition_.mass;
  report.centre = centre_;
  report.momentum = momentum();
  report.kinetic = 0.5 * (report.momentum.linear.dot(velocity_) + report.momentum.angular.dot(rate_));
  report.potential = -definition_.mass * gravity.dot(centre_);
  return report;
}

void FreeMotion::serialise(StateArchive& archive) {
  archive.value("wrench_force", wrench_.force);
  archive.value("wrench_torque", wrench_.torque);
  for (const auto& [name, count] : kFreeMomenta) {
    archive.value(std::string(name) + "_linear", (account_.*count).linear);
    archive.value(std::string(name) + "_angular", (account_.*count).angular);
  }
  for (const auto& [name, count] : kFreeEnergies) archive.value(name, account_.*count);
  // Values of the last step: what is reported at a sync point is as it left them.
  archive.value("centre", centre_);
  archive.value("velocity", velocity_);
  archive.value("rate", rate_);
  archive.value("start_velocity", start_velocity_);
  archive.value("start_rate", start_rate_);
  archive.value("kept_velocity", kept_velocity_);
  archive.value("kept_rate", kept_rate_);
  archive.value("inverse_mass", inverse_mass_);
  archive.value("inertia", inertia_);
  archive.value("lifted", lifted_);
}

}  // namespace mpm
