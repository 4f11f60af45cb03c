#include "mpm_ros/report/report_compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "mpm_ros/message/conversions.hpp"
#include "mpm_ros/message/quantities.hpp"
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
          {"smallest det F of the run", number(statistics.smallest_j())},
          {"largest audit residual", fmt::format("{:.2g}", statistics.worst_audit())},
          {"gaps in time", run.gaps.empty() ? "none" : "yes"}};
}

Figures energy_figures(const RecordedRun& run) {
  const auto first = energies_of(*run.statistics.first_state()), last = energies_of(run.statistics.last_state());
  Figures figures;
  for (std::size_t i = 0; i < last.size(); ++i) {
    figures.emplace_back(last[i].heading, number(first[i].value) + " to " + number(last[i].value));
  }
  return figures;
}

Figures contact_figures(const RecordedRun& run) {
  Figures figures;
  const auto add = [&](const ContactStatistics& contact) {
    for (const FigureText& figure : figure_texts(contact, run.scene.axisymmetric)) {
      const std::string value = figure.size.empty() ? figure.vector : figure.size;
      figures.emplace_back(contact.name + " " + figure.heading,
                           value + (figure.time.empty() ? "" : " at " + figure.time + " s"));
    }
  };
  for (const BodyStatistics& body : run.statistics.body_statistics()) add(body);
  for (const ContactStatistics& pair : run.statistics.pair_statistics()) add(pair);
  return figures;
}

std::string side_by_side(const std::string& title, const std::vector<RecordedRun>& runs,
                         Figures (*figures)(const RecordedRun&)) {
  std::vector<std::string> header = {title};
  std::vector<Figures> columns;
  std::vector<std::string> names;  // names of all rows, each once
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
