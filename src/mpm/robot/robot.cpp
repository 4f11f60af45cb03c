#include "mpm/robot/robot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mpm/robot/poses.hpp"

namespace mpm {
namespace {

constexpr int kBiasRounds = 3;       ///< each gains a factor of a step's angle
constexpr double kLeastReach = 0.1;  ///< [m] of links from the base, in commands of this

}  // namespace

Robot::Robot(const RobotDefinition& definition, const Vec3& gravity, std::vector<RigidBody>& bodies)
    : definition_(definition),
      solution_(base_freedoms() + static_cast<int>(definition.joints.size())),
      base_(definition.base.pose) {
  const MakeRobotEngine make = robot_engine();
  if (make == nullptr) {
    throw RigidError(fmt::format(
        "robot '{}': this build has no robots; install the packages of `scripts/install_packages robots`, then build "
        "in an empty folder",
        definition_.name));
  }
  engine_ = make(definition_, gravity);
  const Eigen::Index own = base_freedoms() + static_cast<Eigen::Index>(definition_.joints.size());
  const Eigen::Index all = engine_->freedoms();
  positions_ = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(definition_.joints.size()));
  for (std::size_t j = 0; j < definition_.joints.size(); ++j) {
    const JointDefinition& joint = definition_.joints[j];
    const ModelJoint& model = definition_.model.joints[joint.joint];
    if (!(joint.position >= model.lower && joint.position <= model.upper)) {
      throw RigidError(
          fmt::format("{}starts at {:g}, outside its limits from {:g} to {:g}; write a position within "
                      "them",
                      joint_text(j), joint.position, model.lower, model.upper));
    }
    positions_[static_cast<Eigen::Index>(j)] = joint.position;
    targets_.emplace_back(joint);
  }
  for (Eigen::VectorXd* vector : {&velocities_, &momentum_, &with_contact_, &start_velocities_, &mean_, &bias_}) {
    *vector = Eigen::VectorXd::Zero(own);
  }
  full_velocities_ = Eigen::VectorXd::Zero(all);
  full_positions_ = Eigen::VectorXd::Zero(all - base_freedoms());
  full_jacobian_ = Eigen::MatrixXd::Zero(6, all);
  mass_ = Eigen::MatrixXd::Zero(own, own);
  impulses_.assign(definition_.joints.size(), 0.0);
  efforts_.assign(definition_.joints.size(), 0.0);
  last_targets_.assign(definition_.joints.size(), 0.0);
  sensed_.resize(definition_.sensors.size());
  sensed_sum_.resize(definition_.sensors.size());
  find_parts();
  if (definition_.base.kind == BaseKind::moving) base_motion_ = make_base_motion();
  links_.reserve(definition_.contacts.size());
  for (const LinkContact& contact : definition_.contacts) {
    const auto body = std::find_if(bodies.begin(), bodies.end(),
                                   [&](const RigidBody& other) { return other.name() == contact.body; });
    if (body == bodies.end()) {
      throw RigidError(fmt::format("robot '{}': no rigid body is called '{}'", definition_.name, contact.body));
    }
    Link link;
    link.body = &*body;
    link.link = contact.link;
    link.jacobian = Eigen::MatrixXd::Zero(6, own);
    const Box bounds = body->surface().bounds();
    link.reach = bounds.min.cwiseAbs().cwiseMax(bounds.max.cwiseAbs()).norm();
    links_.push_back(std::move(link));
  }
  find_places();
  for (Link& link : links_) link.motion = &link.body->join(*this, response_, engine_->pose(link.link));
  energies_.potential = engine_->potential();
}

// Commands ask of a body how far it reaches, so that one that turns it too fast can be refused.
std::unique_ptr<RigidBody> Robot::make_base_motion() const {
  double reach = kLeastReach;
  const std::vector<Pose> poses = start_poses(definition_);
  for (const Pose& pose : poses) reach = std::max(reach, (pose.position - base_.position).norm());
  RigidBodyDefinition motion;
  motion.name = definition_.name;
  motion.surface = make_sphere(reach);
  motion.pose = base_;
  motion.velocity = definition_.base.velocity;
  motion.rotation_rate = definition_.base.rotation_rate;
  return std::make_unique<RigidBody>(std::move(motion));
}

std::string Robot::joint_text(std::size_t joint) const {
  return fmt::format("robot '{}': joint '{}' ", definition_.name,
                     definition_.model.joints[definition_.joints[joint].joint].name);
}

void Robot::find_parts() {
  for (int k = 0; k < base_freedoms(); ++k) parts_.push_back({k, 1.0, 0.0});
  const auto freedom_of = [&](int model_joint) {
    for (std::size_t j = 0; j < definition_.joints.size(); ++j) {
      if (definition_.joints[j].joint == model_joint) return base_freedoms() + static_cast<int>(j);
    }
    throw RigidError(fmt::format("robot '{}': joint '{}' has no definition", definition_.name,
                                 definition_.model.joints[model_joint].name));
  };
  for (std::size_t j = 0; j < definition_.model.joints.size(); ++j) {
    const ModelJoint& joint = definition_.model.joints[j];
    if (!joint.moves()) continue;
    if (joint.mimic) {
      parts_.push_back({freedom_of(joint.mimic->joint), joint.mimic->factor, joint.mimic->offset});
    } else {
      parts_.push_back({freedom_of(static_cast<int>(j)), 1.0, 0.0});
    }
  }
}

void Robot::full_positions() {
  const int base = base_freedoms();
  for (Eigen::Index i = 0; i < full_positions_.size(); ++i) {
    const Part& part = parts_[static_cast<std::size_t>(i + base)];
    full_positions_[i] = part.factor * positions_[part.freedom - base] + part.offset;
  }
}

void Robot::reduce_mass() {
  const Eigen::MatrixXd& full = engine_->mass_matrix();
  mass_.setZero();
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    for (std::size_t j = 0; j < parts_.size(); ++j) {
      mass_(parts_[i].freedom, parts_[j].freedom) +=
          parts_[i].factor * parts_[j].factor * full(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
    }
  }
}

void Robot::find_jacobian(int link, Eigen::MatrixXd& into) {
  engine_->jacobian(link, full_jacobian_);
  into.setZero();
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    into.col(parts_[i].freedom) += parts_[i].factor * full_jacobian_.col(static_cast<Eigen::Index>(i));
  }
}

void Robot::find_places() {
  full_positions();
  engine_->set_positions(base_, full_positions_);
  reduce_mass();
  for (Link& link : links_) find_jacobian(link.link, link.jacobian);
}

const Eigen::VectorXd& Robot::reduced_bias(const Eigen::VectorXd& velocities) {
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    full_velocities_[static_cast<Eigen::Index>(i)] = parts_[i].factor * velocities[parts_[i].freedom];
  }
  const Eigen::VectorXd& full = engine_->bias(full_velocities_);
  bias_.setZero();
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    bias_[parts_[i].freedom] += parts_[i].factor * full[static_cast<Eigen::Index>(i)];
  }
  return bias_;
}

const Eigen::VectorXd& Robot::merge_prescribed() {
  mean_ = velocities_;
  for (Eigen::Index i = 0; i < velocities_.size(); ++i) {
    if (solution_.is_prescribed(static_cast<int>(i))) mean_[i] = solution_.velocities()[i];
  }
  return mean_;
}

void Robot::begin_step(double time, double dt) {
  time_ = time;
  dt_ = dt;
  predicted_ = false;
  if (base_motion_ != nullptr) base_motion_->begin_step(time, dt);
  // Mass matrix and Jacobians are those that move() found where the robot is.
  set_laws(time);
  try {
    solution_.begin(mass_, velocities_);
  } catch (const RigidError& error) {
    throw RigidError(fmt::format("robot '{}': {}", definition_.name, error.what()));
  }
  const Eigen::VectorXd& bias = reduced_bias(velocities_);
  momentum_.noalias() = mass_ * velocities_;
  momentum_ -= dt_ * bias;
  solution_.solve(momentum_);
  response_.links.clear();
  for (Link& link : links_) {
    link.motion->set_origin(link.body->pose().position);
    link.motion->clear_taken();
    link.motion->set_pushed(LinkMotion::Vec6::Zero());
    link.responds = false;
    for (Eigen::Index i = 0; i < velocities_.size(); ++i) {
      if (!solution_.is_prescribed(static_cast<int>(i)) && !link.jacobian.col(i).isZero(0.0)) link.responds = true;
    }
    link.motion->set_place(link.responds ? static_cast<int>(response_.links.size()) : -1);
    if (link.responds) response_.links.push_back(link.motion);
  }
  find_response();
  // The twist of the step, for a link that nothing moves but what is prescribed.
  tell_links(merge_prescribed());
  for (Link& link : links_) link.body->set_twist(link.motion->twist(link.body->pose()));
}

void Robot::find_response() {
  const auto count = static_cast<Eigen::Index>(response_.links.size());
  if (count == 0) return;
  stacked_.resize(velocities_.size(), 6 * count);
  Eigen::Index place = 0;
  for (const Link& link : links_) {
    if (link.responds) stacked_.middleCols<6>(6 * place++) = link.jacobian.transpose();
  }
  solution_.respond(stacked_, responses_);
  response_.matrix.noalias() = stacked_.transpose() * responses_;
  response_.change.resize(6 * count);
}

void Robot::tell_links(const Eigen::VectorXd& velocities) {
  for (Link& link : links_) link.motion->set_velocity(link.jacobian * velocities);
}

void Robot::predict(double dt) {
  dt_ = dt;
  predicted_ = true;
  start_velocities_ = velocities_;
  mean_ = velocities_;
  for (int round = 0; round < kBiasRounds; ++round) {
    const Eigen::VectorXd& bias = reduced_bias(mean_);
    momentum_.noalias() = mass_ * start_velocities_;
    momentum_ -= dt_ * bias;
    solution_.solve(momentum_);
    mean_ = 0.5 * (start_velocities_ + solution_.velocities());
  }
  find_response();
  tell_links(solution_.velocities());
  for (Link& link : links_) {
    link.motion->set_start_velocity(link.jacobian * start_velocities_);
    link.motion->set_pushed(LinkMotion::Vec6::Zero());
  }
}

void Robot::begin_trial() {
  for (Link& link : links_) {
    link.kept = link.motion->velocity();
    link.pushed = link.motion->pushed();
  }
  tell_links(merge_prescribed());
}

void Robot::end_trial() {
  for (Link& link : links_) {
    link.motion->set_velocity(link.kept);
    link.motion->set_pushed(link.pushed);
  }
}

void Robot::begin_increment() {
  for (Link& link : links_) {
    link.kept = link.motion->velocity();
    link.motion->set_velocity(LinkMotion::Vec6::Zero());
  }
}

void Robot::end_increment() {
  for (Link& link : links_) link.motion->add(link.kept);
}

void Robot::add_contact(Eigen::VectorXd& momentum, bool pushed) const {
  for (const Link& link : links_) {
    momentum.noalias() += link.jacobian.transpose() * (pushed ? link.motion->pushed() : link.motion->taken());
  }
}

bool Robot::settle() {
  with_contact_ = momentum_;
  add_contact(with_contact_, true);
  if (!solution_.solve(with_contact_)) return false;
  find_response();
  tell_links(solution_.velocities());
  return true;
}

void Robot::finish() {
  with_contact_ = momentum_;
  add_contact(with_contact_, false);
  solution_.solve_linear(with_contact_);
  tell_links(solution_.velocities());
  for (Link& link : links_) link.body->set_twist(link.motion->twist(link.body->pose()));
}

void Robot::end_step() {
  if (!predicted_) {  // nothing that moves meets the material
    predict(dt_);
    finish();
  }
  velocities_ = solution_.velocities();
  book();
  if (!sensed_.empty()) read_sensors();
  move();
}

void Robot::book() {
  mean_ = 0.5 * (start_velocities_ + velocities_);
  // Impulses of the joints: what momentum and contact leave.
  bias_.noalias() = mass_ * velocities_;
  bias_ -= with_contact_;
  const auto& laws = solution_.laws();
  const int base = base_freedoms();
  for (std::size_t k = 0; k < laws.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    const JointImpulses parts = laws[k].parts(velocities_[i], bias_[i]);
    energies_.drive += parts.drive * mean_[i];
    energies_.damping += parts.damping * mean_[i];
    energies_.friction += parts.friction * mean_[i];
    energies_.limit += parts.limit * mean_[i];
    if (static_cast<int>(k) < base) continue;
    impulses_[k - static_cast<std::size_t>(base)] += parts.drive;
    efforts_[k - static_cast<std::size_t>(base)] = parts.drive / dt_;
  }
  for (const Link& link : links_) {
    energies_.contact += link.motion->taken().dot(link.jacobian * mean_);
    energies_.loss += link.motion->lost();
  }
}

void Robot::read_sensors() {
  accelerations_.resize(full_velocities_.size());
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const Part& part = parts_[i];
    full_velocities_[static_cast<Eigen::Index>(i)] = part.factor * mean_[part.freedom];
    accelerations_[static_cast<Eigen::Index>(i)] =
        part.factor * (velocities_[part.freedom] - start_velocities_[part.freedom]) / dt_;
  }
  link_numbers_.clear();
  wrenches_.clear();
  for (const Link& link : links_) {
    link_numbers_.push_back(link.link);
    wrenches_.push_back(link.motion->taken() / dt_);
  }
  for (std::size_t s = 0; s < sensed_.size(); ++s) {
    const SensorDefinition& sensor = definition_.sensors[s];
    const LinkMotion::Vec6 wrench =
        engine_->joint_wrench(sensor.joint, full_velocities_, accelerations_, link_numbers_, wrenches_, sensor.gravity);
    sensed_[s] = {wrench.tail<3>(), wrench.head<3>()};
    sensed_sum_[s].force += dt_ * sensed_[s].force;
    sensed_sum_[s].torque += dt_ * sensed_[s].torque;
  }
}

void Robot::at_sync(std::int64_t now) {
  if (base_motion_ == nullptr) return;
  base_motion_->at_sync(now);
  const Pose& pose = base_motion_->pose();
  if (pose.position == base_.position && pose.orientation.coeffs() == base_.orientation.coeffs()) return;
  base_ = pose;
  put_links();
}

void Robot::move() {
  const int base = base_freedoms();
  positions_ += dt_ * velocities_.tail(positions_.size());
  if (base_motion_ != nullptr) {
    base_motion_->end_step(dt_);
    base_ = base_motion_->pose();
  } else if (base > 0) {
    const Vec3 rate = velocities_.head<3>(), velocity = velocities_.segment<3>(3);
    const Quat half =
        integrate({Vec3::Zero(), base_.orientation}, {Vec3::Zero(), base_.orientation * rate}, 0.5 * dt_).orientation;
    base_ = integrate(base_, {half * velocity, base_.orientation * rate}, dt_);
  }
  // Positions are on their limits to the last digit.
  for (std::size_t j = 0; j < definition_.joints.size(); ++j) {
    const ModelJoint& model = definition_.model.joints[definition_.joints[j].joint];
    double& position = positions_[static_cast<Eigen::Index>(j)];
    position = std::clamp(position, model.lower, model.upper);
  }
  find_places();
  energies_.kinetic = 0.5 * velocities_.dot(mass_ * velocities_);
  energies_.potential = engine_->potential();
  for (Link& link : links_) {
    const LinkMotion::Vec6 twist = link.jacobian * velocities_, change = twist - link.jacobian * start_velocities_;
    link.motion->set_acceleration((change.tail<3>().norm() + link.reach * change.head<3>().norm()) / dt_);
    link.motion->set_next(engine_->pose(link.link), {twist.tail<3>(), twist.head<3>()});
  }
}

}  // namespace mpm
