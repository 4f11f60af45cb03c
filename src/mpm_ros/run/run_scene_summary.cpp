#include "mpm_ros/run/run_scene_summary.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "mpm/ranks/of_all.hpp"
#include "mpm/rules/method_text.hpp"
#include "mpm_ros/message/conversions.hpp"
#include "mpm_ros/message/quantities.hpp"
#include "mpm_ros/message/robot_messages.hpp"

namespace mpm_ros {
namespace {

std::uint64_t peak_memory_bytes(mpm::Communicator* ranks) {
  rusage usage{};
  double bytes = 0.0;
  if (getrusage(RUSAGE_SELF, &usage) == 0) bytes = 1024.0 * static_cast<double>(usage.ru_maxrss);  // Linux: kibibytes
  return static_cast<std::uint64_t>(mpm::largest_of_all(ranks, bytes));
}

mpm::Traffic sent_by_all(mpm::Communicator* ranks) {
  if (ranks == nullptr) return {};
  const mpm::Traffic own = mpm::sent(*ranks);
  std::array<double, 4> all = {static_cast<double>(own.messages), static_cast<double>(own.bytes),
                               static_cast<double>(own.collectives), static_cast<double>(own.shared)};
  ranks->sum(all.data(), static_cast<int>(all.size()));
  const auto count = [](double number) { return static_cast<std::uint64_t>(number); };
  return {count(all[0]), count(all[1]), count(all[2]), count(all[3])};
}

nlohmann::ordered_json array(const mpm::Vec3& v) { return {v.x() + 0.0, v.y() + 0.0, v.z() + 0.0}; }  // no -0

nlohmann::ordered_json json_of(const Value& value) {
  const mpm::Vec3* vector = std::get_if<mpm::Vec3>(&value);
  return vector != nullptr ? array(*vector) : nlohmann::ordered_json(std::get<double>(value));
}

/// Values that the lists of quantities.hpp count since the start, under their keys.
template <class Report, class Message>
nlohmann::ordered_json ends_of(const Report& report, const std::vector<Quantity<Report, Message>>& quantities) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const Quantity<Report, Message>& one : quantities) {
    for (const Figure& figure : one.figures) {
      if (figure.of == Figure::Of::end || figure.of == Figure::Of::ends)
        json[figure.key] = json_of(one.of_report(report));
    }
  }
  return json;
}

/// "x y z", six digits, no -0.
std::string triple(const mpm::Vec3& v) {
  return fmt::format("{:.6g} {:.6g} {:.6g}", v.x() + 0.0, v.y() + 0.0, v.z() + 0.0);
}

nlohmann::ordered_json energy_json(const mpm::SolverState& state) {
  nlohmann::ordered_json json;
  for (const EnergyFigure& energy : energies_of(to_message(state))) json[energy.key] = energy.value;
  return json;
}

/// Summary of what was asked, chosen, expected of the choice, and reached. The error of the force is not known of a run
/// alone.
nlohmann::ordered_json target_json(const mpm::pace::Target& target, double reached) {
  nlohmann::ordered_json json;
  if (target.real_time) json["real_time"] = *target.real_time;
  if (target.force_error) json["force_error"] = *target.force_error;
  json["chosen"] = target.chosen.value_or(std::vector<std::string>{});
  json["expected"] = {{"real_time", target.expected_pace}};
  if (target.expected_error > 0.0) json["expected"]["force_error"] = target.expected_error;
  json["reached"] = {{"real_time", reached}};
  return json;
}

/// Robots as they stand at the end, with efforts of the last step.
nlohmann::ordered_json robots_json(const std::vector<mpm::RobotReport>& robots) {
  nlohmann::ordered_json json;
  for (const mpm::RobotReport& robot : robots) {
    nlohmann::ordered_json& one = json[robot.name];
    one["joints"] = nlohmann::ordered_json::object();
    one["sensors"] = nlohmann::ordered_json::object();
    for (const mpm::JointReport& joint : robot.joints) {
      one["joints"][joint.name] = {{"unit", joint_units(joint.prismatic).position},
                                   {"drive", mpm::kJointDriveNames[static_cast<std::size_t>(joint.drive)]},
                                   {"position", joint.position},
                                   {"velocity", joint.velocity},
                                   {"effort", joint.effort},
                                   {"target", joint.target},
                                   {"impulse", joint.impulse}};
    }
    for (const mpm::SensorReport& sensor : robot.sensors) {
      one["sensors"][sensor.joint] = {
          {"link", sensor.link}, {"force", array(sensor.wrench.force)}, {"torque", array(sensor.wrench.torque)}};
    }
    for (const RobotQuantity& energy : robot_quantities())
      one["energy"][energy.figures.front().key] = std::get<double>(energy.of_report(robot));
  }
  return json;
}

std::string robot_line(const mpm::RobotReport& robot) {
  std::string joints;
  for (const mpm::JointReport& joint : robot.joints) {
    joints += fmt::format("{}{} {:.4g} {}", joints.empty() ? "" : ", ", joint.name, joint.position + 0.0,
                          joint_units(joint.prismatic).position);
  }
  return fmt::format("  robot {} at the end: {}; its drives did {:.4g} J of work\n", robot.name,
                     joints.empty() ? "no joint that moves" : joints, robot.energies.drive);
}

}  // namespace

RunSummary::RunSummary(const mpm::Scene& scene, const mpm::Simulation& simulation, const mpm::SolverState& start,
                       const Contacts& contacts, bool cut_short, const std::string& device)
    : scene(scene.definition.name),
      target(scene.target),
      definition(simulation.definition()),
      isa(simulation.isa()),
      device(device.empty() ? "cpu" : device),
      ranks(simulation.ranks() == nullptr ? 1 : simulation.ranks()->size()),
      threads(simulation.threads()),
      sent(sent_by_all(simulation.ranks())),
      sharing(simulation.sharing()),
      state(simulation.state()),
      start(start),
      end(mpm::nanoseconds_of(scene.definition.time.end)),
      cut_short(cut_short),
      state_hash(cut_short ? 0 : simulation.state_hash()),
      peak_memory(peak_memory_bytes(simulation.ranks())),
      contacts(contacts),
      robots(simulation.robots()),
      metrics(simulation.metrics()) {}

double RunSummary::particle_steps_per_second() const {
  const double work = static_cast<double>(state.particles) * static_cast<double>(state.step.steps);
  return state.wall_seconds > 0.0 ? work / state.wall_seconds : 0.0;
}

double RunSummary::real_time_factor() const { return state.wall_seconds > 0.0 ? seconds() / state.wall_seconds : 0.0; }

nlohmann::ordered_json RunSummary::json() const {
  nlohmann::ordered_json root;
  root["scene"] = scene;
  root["method"] = {{"geometry", mpm::geometry_name(definition.geometry)},
                    {"shape", mpm::shape_name(definition.method.shape)},
                    {"update", mpm::update_name(definition.method.update)},
                    {"transfer", mpm::transfer_text(definition.method.transfer)},
                    {"precision", mpm::precision_name(definition.method.precision)},
                    {"isa", isa}};
  root["particles"] = state.particles;
  root["returned"] = static_cast<std::uint64_t>(state.number("returned"));
  root["steps"] = state.step.steps;
  root["time"] = seconds();
  root["dt"] = {{"min", state.step.dt_min},
                {"max", state.step.dt_max},
                {"courant", state.step.courant},
                {"divided", state.step.divided},
                {"limited_by", state.step.limited_by}};
  root["wall_seconds"] = state.wall_seconds;
  root["particle_steps_per_second"] = particle_steps_per_second();
  root["real_time_factor"] = real_time_factor();
  if (target) root["target"] = target_json(*target, real_time_factor());
  root["peak_memory_bytes"] = peak_memory;
  root["ranks"] = ranks;
  root["threads"] = threads;
  root["device"] = device;
  if (ranks > 1) {
    root["communication"] = {{"messages", sent.messages},
                             {"bytes", sent.bytes},
                             {"collectives", sent.collectives},
                             {"collective_bytes", sent.shared}};
    root["sharing"] = {
        {"handed_over", sharing.handed_over}, {"divisions", sharing.divisions}, {"imbalance", sharing.imbalance}};
  }
  root["cut_short"] = cut_short;
  root["ended"] = !cut_short && state.time >= end;
  if (!cut_short) root["state_hash"] = hash_text(state_hash);
  root["energy"] = {{"start", energy_json(start)}, {"end", energy_json(state)}};
  root["momentum_error"] = state.audit.residual;
  // Keys are quantity, then body; for a pair the other way round.
  root["contact_impulse"] = root["friction_energy"] = nlohmann::ordered_json::object();
  for (const mpm::ContactReport& contact : contacts.bodies) {
    const nlohmann::ordered_json ends = ends_of(contact, contact_quantities());
    for (const auto& [key, value] : ends.items()) {
      root[key == "impulse" ? "contact_impulse" : key][contact.body] = value;
    }
  }
  root["contact_pairs"] = nlohmann::ordered_json::object();
  for (const mpm::PairReport& pair : contacts.pairs) {
    root["contact_pairs"][pair.name] = ends_of(pair, pair_quantities());
  }
  if (!robots.empty()) root["robots"] = robots_json(robots);
  root["metrics"] = nlohmann::ordered_json::object();
  for (const auto& [name, value] : metrics) root["metrics"][name] = value;
  return root;
}

std::string RunSummary::text() const {
  std::string text = fmt::format("{}: {:g} s simulated in {:.3g} s ({:.3g} times real time), {} steps\n", scene,
                                 seconds(), state.wall_seconds, real_time_factor(), state.step.steps);
  text += fmt::format(
      "  particles {}, {:.3g} million particle-steps a second on {}{}{} thread{} ({}, {} precision), {:.0f} MB{}\n",
      state.particles, 1e-6 * particle_steps_per_second(), device == "cpu" ? "" : device + " and ",
      ranks == 1 ? "" : fmt::format("{} ranks of ", ranks), threads, threads == 1 ? "" : "s", isa,
      mpm::precision_name(definition.method.precision), 1e-6 * static_cast<double>(peak_memory),
      ranks == 1 ? "" : " at most on a rank");
  if (target) {
    text +=
        fmt::format("  target {}: reached {:.2g} of real time, {:.2g} was expected, with an error of the force {}\n",
                    mpm::pace::target_text(*target), real_time_factor(), target->expected_pace,
                    target->expected_error > 0.0 ? fmt::format("of {:.2g} %", 100.0 * target->expected_error)
                                                 : "that is not known");
  }
  text += fmt::format("  time step {:.4g} to {:.4g} s, limited by {}\n", state.step.dt_min, state.step.dt_max,
                      state.step.limited_by);
  if (const std::uint64_t divided = state.step.divided; divided > 0) {
    text +=
        fmt::format("  steps were made shorter on the way in {} sync period{}, since material got faster or stiffer\n",
                    divided, divided == 1 ? "" : "s");
  }
  if (const double modulus = state.number("sweep_modulus"); modulus > 0.0) {
    text += fmt::format("  sweeps of the last step resolve a modulus of {:.3g} kPa", 1e-3 * modulus);
    const double load = state.number("sweep_load");
    text += load > 0.0 ? fmt::format("; pressure on tools was up to 1/{:.3g} of that of its step\n", 1.0 / load) : "\n";
  }
  if (!(state.step.courant <= 1.0)) {
    text += fmt::format("  a wave crossed {:.2g} cells in a step, which may be unstable: lower time.sync or time.cfl\n",
                        state.step.courant);
  }
  text += fmt::format(
      "  energy {:.6g} J at the start, {:.6g} J at the end (kinetic {:.4g}, elastic {:.4g}, potential "
      "{:.4g}); lost to plastic or viscous flow {:.4g} J, work of tools {:.4g} J\n",
      start.energy.total(), state.energy.total(), state.energy.of("kinetic"), state.energy.of("elastic"),
      state.energy.of("potential"), state.energy.of("plastic"), state.energy.of("contact_work"));
  text += fmt::format("  momentum error {:.2g} of the momentum exchanged, smallest J {:.4g} at the end, {}\n",
                      state.audit.residual, state.min_j,
                      cut_short ? "no state hash" : "state hash " + hash_text(state_hash));
  if (cut_short) {
    text +=
        "  steps, energies and errors are those of the stop, between two sync points; time and contact are those "
        "of the sync point before\n";
  }
  for (const mpm::ContactReport& contact : contacts.bodies) {
    text += fmt::format("  contact impulse on {}: {} N s; friction took {:.4g} J\n", contact.body,
                        triple(contact.impulse), contact.friction_energy);
  }
  for (const mpm::PairReport& pair : contacts.pairs) {
    text += fmt::format("  contact of {}: impulse on the second {} N s; friction took {:.4g} J\n", pair.name,
                        triple(pair.impulse), pair.friction_energy);
  }
  for (const mpm::RobotReport& robot : robots) text += robot_line(robot);
  if (const double returned = state.number("returned"); returned > 0.0) {
    text += fmt::format("  particles that left the grid and were put back: {:.0f}\n", returned);
  }
  for (const auto& [name, value] : metrics) {
    text += std::isnan(value)
                ? fmt::format("  {} has no value: its window held less than two sync points of the run\n", name)
                : fmt::format("  {} = {:.9g}\n", name, value);
  }
  return text;
}

}  // namespace mpm_ros
