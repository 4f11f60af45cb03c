#include "mpm_ros/message/quantities.hpp"

#include "mpm/math/nanoseconds.hpp"

// A member by its path: FIELD(mean.force).
#define FIELD(path)                                        \
  Field {                                                  \
#path, [](auto& owner) -> auto& { return owner.path; } \
  }

namespace mpm_ros {

using Of = Figure::Of;

const char* over_text(Over over) {
  switch (over) {
    case Over::mean:
      return "mean over the interval";
    case Over::place:
      return "mean by the normal impulse";
    case Over::step:
      return "of the step with the largest force";
    case Over::sum:
      return "sum";
    case Over::start:
      return "since the start";
    case Over::now:
      break;
  }
  return "at the end of the interval";
}

const std::vector<ContactQuantity>& contact_quantities() {
  using Q = ContactQuantity;
  static const std::vector<Q> list = {
      Q("force", "N", Over::mean, FIELD(mean.force), FIELD(wrench.force), "f", "of the material on the body",
        {{Of::peak, "peak_force", "peak |F|"}, {Of::mean, "mean_force", "mean F"}}),
      Q("torque", "N m", Over::mean, FIELD(mean.torque), FIELD(wrench.torque), "t", "about the body's origin",
        {{Of::peak, "peak_torque", "peak |T|"}, {Of::mean, "mean_torque", "mean T"}}),
      Q("peak force", "N", Over::step, FIELD(peak.force), FIELD(peak.force), "peak f", "",
        {{Of::peak, "peak_force_of_a_step", "peak |F| of a step"}}),
      Q("peak torque", "N m", Over::step, FIELD(peak.torque), FIELD(peak.torque), "peak t", ""),
      Q("impulse", "N s", Over::start, FIELD(impulse), FIELD(impulse), "impulse ", "the force integrated",
        {{Of::end, "impulse", "impulse"}}),
      Q("interval", "s", Over::sum, FIELD(interval), FIELD(interval), "interval", "since the message before"),
      Q("nodes", "1", Over::now, FIELD(nodes), FIELD(nodes), "nodes",
        "grid nodes, or points of the surface, in contact in the last step"),
      Q("pressing", "N", Over::mean, FIELD(pressing), FIELD(pressing), "pressing",
        "sum of the sizes of the normal forces"),
      Q("friction", "N", Over::mean, FIELD(friction), FIELD(friction), "friction ",
        "the part of the force along the surface"),
      Q(
          "centre of pressure", "m", Over::place,
          [](const mpm::ContactReport& report) { return Value(report.centre_of_pressure()); },
          FIELD(centre_of_pressure), "cop ", "laid where the body is as the interval ends"),
      Q("arm", "m", Over::place, FIELD(arm), FIELD(arm), "", "centre of pressure from the body's origin"),
      Q("contact area", "m^2", Over::mean, FIELD(area), FIELD(contact_area), "contact area",
        "of the surface; 0 where contact is found at nodes", {{Of::largest, "largest_contact_area", "largest area"}}),
      Q("friction energy", "J", Over::start, FIELD(friction_energy), FIELD(friction_energy), "friction energy",
        "taken by sliding", {{Of::end, "friction_energy", "friction took"}}),
      Q("per radian", "N/rad", Over::mean, FIELD(per_radian), FIELD(per_radian), "per radian ",
        "force outwards and along the axis, over 2π; in the whole body's force the outward parts cancel",
        {{Of::peak, "", "peak a radian"}, {Of::mean, "", "mean a radian"}})
          .ring()};
  return list;
}

const std::vector<PairQuantity>& pair_quantities() {
  using Q = PairQuantity;
  static const std::vector<Q> list = {
      Q("force", "N", Over::mean, FIELD(force), FIELD(force), "f", "of the first body on the second",
        {{Of::peak, "peak_force", "peak |F|"}, {Of::mean, "mean_force", "mean F"}}),
      Q("friction", "N", Over::mean, FIELD(friction), FIELD(friction), "friction ",
        "the part of the force along the surface"),
      Q("impulse", "N s", Over::start, FIELD(impulse), FIELD(impulse), "impulse ", "the force integrated",
        {{Of::end, "impulse", "impulse"}}),
      Q("interval", "s", Over::sum, FIELD(interval), FIELD(interval), "interval", "since the message before"),
      Q("nodes", "1", Over::now, FIELD(nodes), FIELD(nodes), "nodes", "in contact in the last step"),
      Q("pressing", "N", Over::mean, FIELD(pressing), FIELD(pressing), "pressing",
        "sum of the sizes of the pressing normal forces"),
      Q("centre of pressure", "m", Over::place, FIELD(centre), FIELD(centre_of_pressure), "cop ", ""),
      Q("contact area", "m^2", Over::now, FIELD(area), FIELD(contact_area), "contact area",
        "of the nodes that pressed in the last step", {{Of::largest, "largest_contact_area", "largest area"}}),
      Q("friction energy", "J", Over::start, FIELD(friction_energy), FIELD(friction_energy), "friction energy",
        "taken by sliding", {{Of::end, "friction_energy", "friction took"}}),
      Q("interface energy", "J", Over::now, FIELD(interface_energy), FIELD(interface_energy), "interface energy",
        "stored in an imperfect interface at the start of the last step",
        {{Of::end, "interface_energy", "stored in the interface"}})};
  return list;
}

const std::vector<TipQuantity>& tip_quantities() {
  using Q = TipQuantity;
  static const std::vector<Q> list = {
      Q("j", "J/m^2", Over::now, FIELD(j), FIELD(j), "j",
        "energy release, without the work of tractions behind the tip"),
      Q("zone", "J/m^2", Over::now, FIELD(zone), FIELD(zone), "zone", "that work, to the end of the contour"),
      Q("k_one", "Pa m^0.5", Over::now, FIELD(k.one), FIELD(k_one), "k_one", "stress intensity of opening"),
      Q("k_two", "Pa m^0.5", Over::now, FIELD(k.two), FIELD(k_two), "k_two", "stress intensity of shear"),
      Q("opening", "m", Over::now, FIELD(opening), FIELD(opening), "opening", "of the faces next to the tip"),
      Q("slip", "m", Over::now, FIELD(slip), FIELD(slip), "slip", "of the left face against the right one there"),
      Q("grown", "m", Over::start, FIELD(grown), FIELD(grown), "grown", ""),
      Q("speed", "m/s", Over::now, FIELD(speed), FIELD(speed), "speed", "of the last growth"),
      Q("angle", "rad", Over::now, FIELD(angle), FIELD(angle), "angle", "by which the last growth turned"),
      Q("growths", "1", Over::start, FIELD(growths), FIELD(growths), "growths", ""),
      Q("by alternate", "1", Over::now, FIELD(by_alternate), FIELD(by_alternate), "by alternate",
        "1 if the last growth was by the alternate rule, else 0")};
  return list;
}

namespace {

/// An energy by the name that the solver's modules give it.
template <class Access>
StateQuantity energy(const char* name, Over over, const char* key, Field<Access> message, const char* heading,
                     const char* meaning) {
  const auto value = [key](const mpm::SolverState& state) { return Value(state.energy.of(key)); };
  return {name, "J", over, value, message, name, meaning, {{Of::ends, key, heading}}};
}

}  // namespace

const std::vector<RobotQuantity>& robot_quantities() {
  using Q = RobotQuantity;
  const auto energy = [](const char* key) { return std::vector<Figure>{{Of::ends, key, key}}; };
  static const std::vector<Q> list = {
      Q("energy kinetic", "J", Over::now, FIELD(energies.kinetic), FIELD(energy_kinetic), "energy kinetic", "",
        energy("kinetic")),
      Q("energy potential", "J", Over::now, FIELD(energies.potential), FIELD(energy_potential), "energy potential",
        "-sum m g.x", energy("potential")),
      Q("energy drive", "J", Over::start, FIELD(energies.drive), FIELD(energy_drive), "energy drive",
        "work of the drives, and of what moves the base", energy("drive")),
      Q("energy damping", "J", Over::start, FIELD(energies.damping), FIELD(energy_damping), "energy damping",
        "work of damping in joints", energy("damping")),
      Q("energy friction", "J", Over::start, FIELD(energies.friction), FIELD(energy_friction), "energy friction",
        "work of friction in joints", energy("friction")),
      Q("energy limit", "J", Over::start, FIELD(energies.limit), FIELD(energy_limit), "energy limit",
        "work of the joints' limits", energy("limit")),
      Q("energy contact", "J", Over::start, FIELD(energies.contact), FIELD(energy_contact), "energy contact",
        "work of the material and of other bodies on the links", energy("contact")),
      Q("energy set", "J", Over::start, FIELD(energies.set), FIELD(energy_set), "energy set",
        "given by states that were set", energy("set")),
      Q("energy loss", "J", Over::start, FIELD(energies.loss), FIELD(energy_loss), "energy loss",
        "lost where links met the material, sliding left out, and other bodies", energy("loss")),
  };
  return list;
}

const std::vector<StateQuantity>& state_quantities() {
  using Q = StateQuantity;
  static const std::vector<Q> list = {
      Q(
          "time", "s", Over::start, [](const mpm::SolverState& state) { return Value(mpm::seconds_of(state.time)); },
          FIELD(time), "", "simulated"),
      Q("steps", "1", Over::start, FIELD(step.steps), FIELD(steps), "steps", ""),
      Q("dt", "s", Over::now, FIELD(step.dt_last), FIELD(dt), "dt", "the last time step"),
      Q("dt min", "s", Over::start, FIELD(step.dt_min), FIELD(dt_min), "dt min", ""),
      Q("dt max", "s", Over::start, FIELD(step.dt_max), FIELD(dt_max), "dt max", ""),
      Q("courant", "1", Over::start, FIELD(step.courant), FIELD(courant), "courant",
        "largest part of a cell that a wave was seen to cross in a step"),
      Q("particles", "1", Over::now, FIELD(particles), FIELD(particles), "particles", ""),
      Q(
          "particles returned", "1", Over::start,
          [](const mpm::SolverState& state) { return Value(state.number("returned")); }, FIELD(particles_returned),
          "returned", "that left the grid and were put back"),
      energy("energy kinetic", Over::now, "kinetic", FIELD(energy_kinetic), "kinetic", ""),
      energy("energy elastic", Over::now, "elastic", FIELD(energy_elastic), "elastic", "stored in the material"),
      energy("energy potential", Over::now, "potential", FIELD(energy_potential), "potential", "-sum m g.x"),
      energy("energy interface", Over::now, "interface", FIELD(energy_interface), "in interfaces",
             "stored in imperfect interfaces, at the start of the last step"),
      Q("energy total", "J", Over::now, [](const mpm::SolverState& state) { return Value(state.energy.total()); },
        Nothing{}, "", "stored in the material, its momentum and its place", {{Of::ends, "total", "sum"}}),
      energy("energy plastic", Over::start, "plastic", FIELD(energy_plastic), "lost to plastic or viscous flow",
             "dissipated by plastic and viscous flow"),
      energy("energy friction", Over::start, "friction", FIELD(energy_friction), "lost to friction on the bodies",
             "taken by sliding on rigid bodies"),
      energy("energy pair friction", Over::start, "pair_friction", FIELD(energy_pair_friction),
             "lost to friction of deformable bodies", "taken by sliding between deformable bodies"),
      energy("contact work", Over::start, "contact_work", FIELD(contact_work), "work of the bodies",
             "of rigid bodies on the material"),
      energy("load work", Over::start, "load_work", FIELD(load_work), "work of loads",
             "of loads, velocity conditions and absorbing faces"),
      energy("energy free kinetic", Over::now, "free_kinetic", FIELD(energy_free_kinetic), "kinetic, of free bodies",
             "of free rigid bodies"),
      energy("energy free potential", Over::now, "free_potential", FIELD(energy_free_potential),
             "potential, of free bodies", "of free rigid bodies, -m g.x"),
      energy("energy free loss", Over::start, "free_loss", FIELD(energy_free_loss),
             "lost where free bodies meet the material",
             "lost where free bodies met material, sliding left out, and other bodies"),
      energy("free work", Over::start, "free_work", FIELD(free_work), "work of wrenches and drives",
             "of applied wrenches and drives on free bodies"),
      Q("momentum", "N s", Over::now, FIELD(audit.momentum), FIELD(momentum), "momentum ", "of the material"),
      Q("initial momentum", "N s", Over::start, FIELD(audit.initial_momentum), FIELD(initial_momentum), "", ""),
      Q("momentum exchanged", "N s", Over::start, FIELD(audit.exchanged), FIELD(momentum_exchanged),
        "momentum exchanged", "sum over steps and sources of the impulses' sizes"),
      Q("momentum carried", "N s", Over::now, FIELD(audit.carried), FIELD(momentum_carried), "",
        "sum of mass times speed"),
      Q("momentum error", "1", Over::now, FIELD(audit.residual), FIELD(momentum_error), "momentum error",
        "residual of the audit over the larger of momentum exchanged and carried")
          .not_compared(),
      Q("min j", "1", Over::now, FIELD(min_j), FIELD(min_j), "min j", "smallest det F"),
      Q("real-time factor", "1", Over::start, Nothing{}, FIELD(real_time_factor), "real-time factor",
        "simulated over wall time, while not paused")
          .not_compared(),
      Q("overruns", "1", Over::start, Nothing{}, FIELD(overruns), "", "sync periods that came later than they were due")
          .not_compared(),
      Q("commands applied", "1", Over::start, Nothing{}, FIELD(commands_applied), "", ""),
      Q("commands late", "1", Over::start, Nothing{}, FIELD(commands_late), "", "").not_compared(),
      Q("commands refused", "1", Over::start, Nothing{}, FIELD(commands_refused), "", "").not_compared(),
      Q(kCommandsDropped, "1", Over::start, Nothing{}, Nothing{}, "", "came faster than the node took them")
          .not_compared()};
  return list;
}

namespace {

template <class Report, class Message>
std::vector<EnergyFigure> figures_of(const Message& message, const std::vector<Quantity<Report, Message>>& quantities) {
  std::vector<EnergyFigure> energies;
  for (const Quantity<Report, Message>& one : quantities) {
    for (const Figure& figure : one.figures) {
      energies.push_back({figure.key, figure.heading, std::get<double>(one.of_message(message))});
    }
  }
  return energies;
}

}  // namespace

std::vector<EnergyFigure> energies_of(const RobotState& robot) { return figures_of(robot, robot_quantities()); }

std::vector<EnergyFigure> energies_of(const SolverState& state) {
  std::vector<EnergyFigure> energies = figures_of(state, state_quantities());
  for (const NamedValue& value : others(state, state_quantities())) {
    if (value.unit == "J" && value.value.size() == 1) energies.push_back({value.name, value.name, value.value[0]});
  }
  return energies;
}

}  // namespace mpm_ros

#undef FIELD
