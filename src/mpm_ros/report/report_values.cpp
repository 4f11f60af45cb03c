#include "mpm_ros/report/report_values.hpp"

#include <strings.h>

namespace mpm_ros {
namespace {

class List {
 public:
  void number(const std::string& field, double value) { values_.push_back({field, field, value, {}}); }
  void word(const std::string& field, const std::string& value) { values_.push_back({field, field, 0.0, value}); }
  /// geometry_msgs/Vector3 or Point.
  template <typename Vector>
  void vector(const std::string& field, const Vector& value) {
    values_.push_back({field + " x", field, value.x, {}});
    values_.push_back({field + " y", field, value.y, {}});
    values_.push_back({field + " z", field, value.z, {}});
  }
  void wrench(const std::string& field, const geometry_msgs::Wrench& value) {
    vector(field + " force", value.force);
    vector(field + " torque", value.torque);
  }
  void pose(const std::string& field, const geometry_msgs::Pose& value) {
    vector(field + " position", value.position);
    vector(field + " orientation", value.orientation);
    values_.push_back({field + " orientation w", field + " orientation", value.orientation.w, {}});
  }
  void twist(const std::string& field, const geometry_msgs::Twist& value) {
    vector(field + " velocity", value.linear);
    vector(field + " rotation rate", value.angular);
  }
  std::vector<NamedValue> take() { return std::move(values_); }

 private:
  std::vector<NamedValue> values_;
};

/// What the machine took, which is no part of the run. Names are as the scene writes them.
bool of_machine(const std::string& quantity) {
  return strcasecmp(quantity.c_str(), "elapsed time") == 0 || strcasecmp(quantity.c_str(), "cpu time") == 0;
}

}  // namespace

std::vector<NamedValue> values_of(const ContactForces& message) {
  List list;
  for (const ContactForce& body : message.bodies) {
    const std::string& name = body.name;
    list.word("name", name);
    list.wrench(name, body.wrench);
    list.wrench(name + " peak", body.peak);
    list.vector(name + " impulse", body.impulse);
    list.number(name + " interval", body.interval);
    list.number(name + " nodes", body.nodes);
    list.number(name + " contact area", body.contact_area);
    list.number(name + " friction energy", body.friction_energy);
    list.number(name + " pressing", body.pressing);
    list.vector(name + " friction", body.friction);
    list.vector(name + " per radian", body.per_radian);
    list.vector(name + " centre of pressure", body.centre_of_pressure);
    list.vector(name + " arm", body.arm);
  }
  for (const ContactPair& pair : message.pairs) {
    const std::string& name = pair.name;
    list.word("name", name);
    list.vector(name + " force", pair.force);
    list.vector(name + " friction", pair.friction);
    list.vector(name + " impulse", pair.impulse);
    list.number(name + " interval", pair.interval);
    list.number(name + " pressing", pair.pressing);
    list.number(name + " nodes", pair.nodes);
    list.number(name + " contact area", pair.contact_area);
    list.number(name + " friction energy", pair.friction_energy);
    list.number(name + " interface energy", pair.interface_energy);
    list.vector(name + " centre of pressure", pair.centre_of_pressure);
  }
  return list.take();
}

std::vector<NamedValue> values_of(const BodyStates& message) {
  List list;
  for (const BodyState& body : message.bodies) {
    list.word("name", body.name);
    list.pose(body.name, body.pose);
    list.twist(body.name, body.twist);
    list.number(body.name + " drive", body.drive);
    list.number(body.name + " mass", body.mass);
  }
  return list.take();
}

std::vector<NamedValue> values_of(const SolverState& message) {
  List list;
  list.number("time", message.time);
  list.number("steps", static_cast<double>(message.steps));
  list.number("dt", message.dt);
  list.number("dt_min", message.dt_min);
  list.number("dt_max", message.dt_max);
  list.word("dt_limited_by", message.dt_limited_by);
  list.number("particles", static_cast<double>(message.particles));
  list.number("particles_returned", static_cast<double>(message.particles_returned));
  list.number("energy_kinetic", message.energy_kinetic);
  list.number("energy_elastic", message.energy_elastic);
  list.number("energy_plastic", message.energy_plastic);
  list.number("energy_potential", message.energy_potential);
  list.number("contact_work", message.contact_work);
  list.number("load_work", message.load_work);
  list.number("energy_friction", message.energy_friction);
  list.number("energy_free_kinetic", message.energy_free_kinetic);
  list.number("energy_free_potential", message.energy_free_potential);
  list.number("energy_free_loss", message.energy_free_loss);
  list.number("free_work", message.free_work);
  list.number("energy_pair_friction", message.energy_pair_friction);
  list.number("energy_interface", message.energy_interface);
  list.vector("momentum", message.momentum);
  list.vector("initial_momentum", message.initial_momentum);
  for (const Impulse& impulse : message.impulses) {
    list.word("impulse", impulse.name);
    list.vector("impulse " + impulse.name, impulse.impulse);
  }
  list.number("momentum_exchanged", message.momentum_exchanged);
  list.number("momentum_carried", message.momentum_carried);
  list.number("min_j", message.min_j);
  list.number("commands_applied", static_cast<double>(message.commands_applied));
  list.number("failed", message.failed);
  list.word("failure", message.failure);
  list.word("state_hash", message.state_hash);
  return list.take();
}

std::vector<NamedValue> values_of(const Command& message) {
  List list;
  list.word("body", message.body);
  list.number("kind", message.kind);
  list.twist(message.body, message.twist);
  list.wrench(message.body, message.wrench);
  list.pose(message.body, message.pose);
  list.number("effect_ns", static_cast<double>(message.effect_ns));
  list.number("arrival_ns", static_cast<double>(message.arrival_ns));
  return list.take();
}

std::vector<NamedValue> values_of(const GlobalQuantities& message) {
  List list;
  for (std::size_t i = 0; i < message.names.size() && i < message.values.size(); ++i) {
    if (!of_machine(message.names[i])) list.number(message.names[i], message.values[i]);
  }
  return list.take();
}

}  // namespace mpm_ros
