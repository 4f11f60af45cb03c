#include "mpm_ros/report/report_messages.hpp"

#include "mpm_ros/message/conversions.hpp"

namespace mpm_ros {

std::vector<mpm::ContactReport> contact_reports_of(const ContactForces& message) {
  std::vector<mpm::ContactReport> reports;
  for (const ContactForce& force : message.bodies) reports.push_back(from_message(force));
  return reports;
}

std::vector<mpm::PairReport> pair_reports_of(const ContactForces& message) {
  std::vector<mpm::PairReport> reports;
  for (const ContactPair& pair : message.pairs) reports.push_back(from_message(pair));
  return reports;
}

std::vector<mpm::BodyState> body_states_of(const BodyStates& message) {
  std::vector<mpm::BodyState> states;
  for (const BodyState& body : message.bodies) {
    states.push_back(
        {body.name, from_message(body.pose), from_message(body.twist), static_cast<mpm::Drive>(body.drive), body.mass});
  }
  return states;
}

mpm::SolverState solver_state_of(std::int64_t time, const SolverState& message) {
  mpm::SolverState state;
  state.time = time;
  state.step = {message.steps, message.dt_min, message.dt_max, message.dt, message.dt_limited_by};
  using Kind = mpm::NamedEnergy::Kind;
  state.energy.add("kinetic", Kind::stored, message.energy_kinetic);
  state.energy.add("elastic", Kind::stored, message.energy_elastic);
  state.energy.add("plastic", Kind::dissipated, message.energy_plastic);
  state.energy.add("potential", Kind::stored, message.energy_potential);
  state.energy.add("contact_work", Kind::work, message.contact_work);
  state.energy.add("load_work", Kind::work, message.load_work);
  state.energy.add("pair_friction", Kind::dissipated, message.energy_pair_friction);
  state.energy.add("interface", Kind::stored, message.energy_interface);
  state.energy.add("friction", Kind::dissipated, message.energy_friction);
  state.energy.add("free_kinetic", Kind::of_bodies, message.energy_free_kinetic);
  state.energy.add("free_potential", Kind::of_bodies, message.energy_free_potential);
  state.energy.add("free_work", Kind::work, message.free_work);
  state.energy.add("free_loss", Kind::dissipated, message.energy_free_loss);
  state.audit.momentum = from_message(message.momentum);
  state.audit.initial_momentum = from_message(message.initial_momentum);
  for (const Impulse& impulse : message.impulses) {
    state.audit.impulses.push_back({impulse.name, from_message(impulse.impulse)});
  }
  state.audit.exchanged = message.momentum_exchanged;
  state.audit.carried = message.momentum_carried;
  state.audit.residual = message.momentum_error;
  state.particles = message.particles;
  state.numbers.push_back({"returned", "1", static_cast<double>(message.particles_returned)});
  state.min_j = message.min_j;
  return state;
}

std::string command_kind_name(std::uint8_t kind) {
  if (kind == Command::WRENCH) return "wrench";
  return kind == Command::POSE ? "pose" : "velocity";
}

CommandRow command_row_of(std::int64_t time, const Command& message) {
  CommandRow row;
  row.time = seconds(time);
  row.body = message.body;
  row.kind = command_kind_name(message.kind);
  row.wrench = from_message(message.wrench);
  row.twist = from_message(message.twist);
  row.pose = from_message(message.pose);
  row.arrival = seconds(message.arrival_ns);
  return row;
}

}  // namespace mpm_ros
