// Commands to a robot, its report, and its state for checkpoints.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mpm/math/nearest.hpp"
#include "mpm/robot/robot.hpp"

namespace mpm {
namespace {

/// A vector in an archive.
void serialise(StateArchive& archive, const char* name, Eigen::VectorXd& vector) {
  std::vector<double> numbers(vector.data(), vector.data() + vector.size());
  archive.list(name, numbers);
  for (Eigen::Index i = 0; i < vector.size() && i < static_cast<Eigen::Index>(numbers.size()); ++i) {
    vector[i] = numbers[static_cast<std::size_t>(i)];
  }
}

}  // namespace

int Robot::find_joint(const std::string& name) const {
  std::vector<std::string> names;
  for (std::size_t j = 0; j < definition_.joints.size(); ++j) {
    names.push_back(definition_.model.joints[definition_.joints[j].joint].name);
    if (names.back() == name) return static_cast<int>(j);
  }
  const int other = definition_.model.find_joint(name);
  if (other >= 0) {
    const bool follows = definition_.model.joints[other].mimic.has_value();
    throw RigidError(fmt::format("robot '{}': joint '{}' {}", definition_.name, name,
                                 follows ? "follows another one (mimic); command that" : "is fixed; leave it out"));
  }
  throw RigidError(
      fmt::format("robot '{}': no joint is called '{}'; {}", definition_.name, name, suggest(name, names)));
}

void Robot::check_command(int place, double value) const {
  const auto joint = static_cast<std::size_t>(place);
  const JointDefinition& definition = definition_.joints[joint];
  const ModelJoint& model = definition_.model.joints[definition.joint];
  if (!std::isfinite(value)) throw RigidError(joint_text(joint) + fmt::format("is commanded to {}", value));
  if (definition.drive == JointDrive::position && (value < model.lower || value > model.upper)) {
    throw RigidError(joint_text(joint) + fmt::format("is commanded to {:g}, outside its limits from {:g} to {:g}",
                                                     value, model.lower, model.upper));
  }
}

void Robot::command(int place, double value, double now, double arrival) {
  const auto joint = static_cast<std::size_t>(place);
  const JointDefinition& definition = definition_.joints[joint];
  if (definition.drive != JointDrive::position || definition.stiffness > 0.0) {
    targets_[joint].hold(value);
    return;
  }
  const double position = positions_[place], rate = (value - position) / (arrival - now);
  targets_[joint].follow({{now, position, rate}, {arrival, value, rate}});
}

void Robot::check_trajectory(int place, const std::vector<JointKnot>& knots, double now) const {
  const auto joint = static_cast<std::size_t>(place);
  const JointDefinition& definition = definition_.joints[joint];
  const ModelJoint& model = definition_.model.joints[definition.joint];
  if (definition.drive == JointDrive::effort) {
    throw RigidError(joint_text(joint) +
                     "has a drive by effort, which follows no trajectory; write drive: position or velocity");
  }
  if (knots.empty()) throw RigidError(joint_text(joint) + "is given a trajectory without points");
  for (std::size_t k = 0; k < knots.size(); ++k) {
    const JointKnot& knot = knots[k];
    const std::string point = joint_text(joint) + fmt::format("is given a trajectory whose point {} ", k);
    if (!std::isfinite(knot.time) || !std::isfinite(knot.position) || std::isinf(knot.velocity)) {
      throw RigidError(point + "is not finite");
    }
    if (knot.position < model.lower || knot.position > model.upper) {
      throw RigidError(point + fmt::format("is at {:g}, outside its limits from {:g} to {:g}", knot.position,
                                           model.lower, model.upper));
    }
    if (k > 0 && !(knot.time > knots[k - 1].time)) throw RigidError(point + "is not later than the one before it");
  }
  if (!(knots.back().time > now)) {
    throw RigidError(joint_text(joint) + fmt::format("is given a trajectory that ended at {:g} s, before the present "
                                                     "{:g} s; stamp it with the time at which it is to begin",
                                                     knots.back().time, now));
  }
}

void Robot::follow(int place, std::vector<JointKnot> knots, double now) {
  // It goes on from where the joint is.
  const auto to_come = std::find_if(knots.begin(), knots.end(), [&](const JointKnot& knot) { return knot.time > now; });
  knots.erase(knots.begin(), to_come);
  const Eigen::Index freedom = base_freedoms() + static_cast<Eigen::Index>(place);
  knots.insert(knots.begin(), {now, positions_[place], velocities_[freedom]});
  targets_[static_cast<std::size_t>(place)].follow(std::move(knots));
}

RobotReport Robot::report() const {
  RobotReport report;
  report.name = definition_.name;
  report.base = base_;
  const int base = base_freedoms();
  if (base > 0) {
    report.base_twist = {base_.orientation * velocities_.segment<3>(3), base_.orientation * velocities_.head<3>()};
  }
  int part = base;
  for (const ModelJoint& model : definition_.model.joints) {
    if (!model.moves()) continue;
    const Part& of = parts_[static_cast<std::size_t>(part++)];
    const auto joint = static_cast<std::size_t>(of.freedom - base);
    JointReport one;
    one.name = model.name;
    one.prismatic = model.kind == ModelJoint::Kind::prismatic;
    one.position = of.factor * positions_[static_cast<Eigen::Index>(joint)] + of.offset;
    one.velocity = of.factor * velocities_[of.freedom];
    if (!model.mimic) {
      one.effort = efforts_[joint];
      one.impulse = impulses_[joint];
      one.target = last_targets_[joint];
      one.drive = definition_.joints[joint].drive;
    }
    report.joints.push_back(one);
  }
  for (std::size_t s = 0; s < sensed_.size(); ++s) {
    const int joint = definition_.sensors[s].joint;
    report.sensors.push_back(
        {definition_.model.joints[joint].name, definition_.model.links[joint + 1].name, sensed_[s], sensed_sum_[s]});
  }
  for (const LinkContact& contact : definition_.contacts) report.links.push_back(contact.body);
  report.energies = energies_;
  return report;
}

void Robot::serialise(StateArchive& archive) {
  archive.value("base_position", base_.position);
  archive.value("base_orientation", base_.orientation);
  mpm::serialise(archive, "positions", positions_);
  mpm::serialise(archive, "velocities", velocities_);
  for (std::size_t j = 0; j < targets_.size(); ++j) {
    const StateArchive::Group group(archive, "joint_" + std::to_string(j));
    targets_[j].serialise(archive);
  }
  archive.list("impulses", impulses_);
  archive.list("efforts", efforts_);
  for (std::size_t s = 0; s < sensed_.size(); ++s) {
    const StateArchive::Group group(archive, "sensor_" + std::to_string(s));
    archive.value("force", sensed_[s].force);
    archive.value("torque", sensed_[s].torque);
    archive.value("force_sum", sensed_sum_[s].force);
    archive.value("torque_sum", sensed_sum_[s].torque);
  }
  for (double* energy : {&energies_.kinetic, &energies_.potential, &energies_.drive, &energies_.damping,
                         &energies_.friction, &energies_.limit, &energies_.contact, &energies_.loss, &energies_.set}) {
    archive.value("energy_" + std::to_string(energy - &energies_.kinetic), *energy);
  }
  archive.list("targets", last_targets_);
  std::vector<double> accelerations;
  for (const Link& link : links_) accelerations.push_back(link.motion->unprescribed_acceleration(0.0));
  archive.list("accelerations", accelerations);
  for (std::size_t l = 0; l < links_.size(); ++l) links_[l].motion->set_acceleration(accelerations.at(l));
  archive.value("time", time_);
  archive.value("dt", dt_);
  if (base_motion_ != nullptr) {
    const StateArchive::Group group(archive, "base_motion");
    base_motion_->serialise(archive);
  }
  find_places();
}

void Robot::hashed(std::vector<double>& numbers) const {
  for (Eigen::Index i = 0; i < positions_.size(); ++i) numbers.push_back(positions_[i]);
  for (Eigen::Index i = 0; i < velocities_.size(); ++i) numbers.push_back(velocities_[i]);
  for (int k = 0; k < 3; ++k) numbers.push_back(base_.position[k]);
  for (int k = 0; k < 4; ++k) numbers.push_back(base_.orientation.coeffs()[k]);
}

}  // namespace mpm
