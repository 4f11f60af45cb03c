#include "mpm_ros/report/report_compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "mpm_ros/message/conversions.hpp"
#include "mpm_ros/report/report_tables.hpp"

namespace mpm_ros {
namespace {

/// Named figures of one run, in the order of their rows.
using Figures = std::vector<std::pair<std::string, std::string>>;

Figures run_figures(const RecordedRun& run) {
  const RunStatistics& statistics = run.statistics;
  const SolverState& last = statistics.last_state();
  return {{"scene", run.scene_name()},
          {"instruction set", run.info ? run.info->isa : "-"},
          {"simulated time [s]", number(last.time)},
          {"steps", std::to_string(last.steps)},
          {"smallest step [s]", number(last.dt_min)},
          {"largest step [s]", number(last.dt_max)},
          {"real-time factor", number(last.real_time_factor)},
          {"particles", std::to_string(last.particles)},
          {"particles returned", std::to_string(last.particles_returned)},
          {"snapshots", std::to_string(statistics.snapshots().size())},
          {"smallest det F", number(statistics.smallest_j())},
          {"largest audit residual", fmt::format("{:.2g}", statistics.worst_audit())},
          {"gaps in time", run.gaps.empty() ? "none" : "yes"}};
}

Figures energy_figures(const RecordedRun& run) {
  const SolverState& first = *run.statistics.first_state();
  const SolverState& last = run.statistics.last_state();
  const auto change = [](double from, double to) { return number(from) + " to " + number(to); };
  return {{"kinetic", change(first.energy_kinetic, last.energy_kinetic)},
          {"elastic", change(first.energy_elastic, last.energy_elastic)},
          {"potential", change(first.energy_potential, last.energy_potential)},
          {"lost to plastic or viscous flow", change(first.energy_plastic, last.energy_plastic)},
          {"work of the bodies", change(first.contact_work, last.contact_work)},
          {"work of loads", change(first.load_work, last.load_work)},
          {"lost to friction on the bodies", change(first.energy_friction, last.energy_friction)},
          {"lost to friction of deformable bodies", change(first.energy_pair_friction, last.energy_pair_friction)},
          {"in interfaces", change(first.energy_interface, last.energy_interface)}};
}

Figures contact_figures(const RecordedRun& run) {
  Figures figures;
  for (const BodyStatistics& body : run.statistics.body_statistics()) {
    const double duration = body.duration > 0.0 ? body.duration : 1.0;
    figures.emplace_back(body.name + " peak |F| [N]", number(body.force.norm));
    figures.emplace_back(body.name + " at [s]", number(seconds(body.force.time)));
    figures.emplace_back(body.name + " peak |F| of a step [N]", number(body.step_force.norm));
    figures.emplace_back(body.name + " peak |T| [N m]", number(body.torque.norm));
    figures.emplace_back(body.name + " mean F x  y  z [N]", triple(body.force_integral / duration));
    figures.emplace_back(body.name + " impulse x  y  z [N s]", triple(body.impulse));
    figures.emplace_back(body.name + " largest area [m^2]", number(body.largest_area));
    figures.emplace_back(body.name + " friction took [J]", number(body.friction_energy));
    figures.emplace_back(
        body.name + " contact [s]",
        body.contact ? number(seconds(body.contact->first)) + " to " + number(seconds(body.contact->second)) : "none");
  }
  for (const PairStatistics& pair : run.statistics.pair_statistics()) {
    figures.emplace_back(pair.name + " peak |F| [N]", number(pair.force.norm));
    figures.emplace_back(pair.name + " impulse x  y  z [N s]", triple(pair.impulse));
    figures.emplace_back(pair.name + " friction took [J]", number(pair.friction_energy));
  }
  return figures;
}

std::string side_by_side(const std::string& title, const std::vector<RecordedRun>& runs,
                         Figures (*figures)(const RecordedRun&)) {
  std::vector<std::string> header = {title};
  std::vector<Figures> columns;
  std::vector<std::string> names;  // of all rows, each once
  for (const RecordedRun& run : runs) {
    header.push_back(run.label);
    columns.push_back(figures(run));
    for (const auto& [name, value] : columns.back()) {
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
  }
  TextTable table(header);
  for (const std::string& name : names) {
    std::vector<std::string> row = {name};
    for (const Figures& column : columns) {
      const auto named = [&name](const auto& figure) { return figure.first == name; };
      const auto found = std::find_if(column.begin(), column.end(), named);
      row.push_back(found == column.end() ? "-" : found->second);
    }
    table.add(row);
  }
  return table.text();
}

}  // namespace

std::string comparison(const std::vector<RecordedRun>& runs) {
  std::string text;
  for (const RecordedRun& run : runs) {
    text += fmt::format("{}: {}{}\n", run.label, run.path, run.scene.method.empty() ? "" : ", " + run.scene.method);
  }
  text += "\nRuns\n" + side_by_side("run", runs, run_figures);
  text += "\nContact: force and torque of the material on each body (of a pair: on the second), world axes\n" +
          side_by_side("body", runs, contact_figures);
  text += "\nEnergies of the material, start to end\n" + side_by_side("energy [J]", runs, energy_figures);
  for (const RecordedRun& run : runs) {
    for (const std::string& note : run.notes) text += fmt::format("\n{}: {}\n", run.label, note);
    for (const std::string& gap : run.gaps) text += fmt::format("\n{}: gap in time: {}\n", run.label, gap);
  }
  return text;
}

}  // namespace mpm_ros
