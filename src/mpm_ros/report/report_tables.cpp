#include "mpm_ros/report/report_tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "mpm/math/constants.hpp"
#include "mpm/math/nanoseconds.hpp"
#include "mpm_ros/message/conversions.hpp"
#include "mpm_ros/message/quantities.hpp"
#include "mpm_ros/report/report_robots.hpp"

namespace mpm_ros {
namespace {

constexpr double kDegrees = 180.0 / mpm::kPi;

std::string run_table(const RecordedRun& run) {
  const RunStatistics& statistics = run.statistics;
  const SolverState& last = statistics.last_state();
  std::string text = run.path + "\n\n";
  const auto line = [&text](const std::string& name, const std::string& value) {
    text += fmt::format("{:<18}{}\n", name, value);
  };
  if (run.info) {
    const RunInfo& info = *run.info;
    line("scene", info.scene + (info.scene_path.empty() ? "" : "  (" + info.scene_path + ")"));
    line("recorded by", fmt::format("mpm_ros {}, instruction set {}", info.version, info.isa));
  }
  if (!run.scene.method.empty()) line("method", run.scene.method);
  line("simulated time", fmt::format("{} s", number(last.time)));
  line("steps", fmt::format("{}, dt {} to {} s, limited by {}", last.steps, number(last.dt_min), number(last.dt_max),
                            last.dt_limited_by.empty() ? "nothing" : last.dt_limited_by));
  line("real-time factor", fmt::format("{} (simulated over wall time)", number(last.real_time_factor)));
  line("particles", fmt::format("{}; {} snapshots of {}", last.particles, statistics.snapshots().size(),
                                fmt::join(run.particle_fields, " ")));
  if (last.particles_returned > 0)
    line("returned", fmt::format("{} particles left the grid and were put back", last.particles_returned));
  line("smallest det F",
       fmt::format("{} in the run, {} at its end", number(statistics.smallest_j()), number(last.min_j)));
  if (!last.state_hash.empty()) line("state hash", last.state_hash);
  for (const std::string& note : run.notes) line("note", note);
  return text;
}

std::string contact_times(const std::optional<std::pair<std::int64_t, std::int64_t>>& contact) {
  return contact ? number(mpm::nearest_seconds(contact->first)) + " to " + number(mpm::nearest_seconds(contact->second))
                 : "none";
}

FigureText figure_text(const ContactStatistics& contact, const NumberStatistics& known, const Figure& figure) {
  FigureText text;
  text.heading = fmt::format("{} [{}]", figure.heading, known.unit);
  mpm::Vec3 value = figure.of == Figure::Of::mean ? contact.mean(known) : known.end;
  if (figure.of == Figure::Of::peak || figure.of == Figure::Of::largest) {
    value = known.peak.vector;
    text.size = number(known.peak.norm);
    text.time = number(mpm::nearest_seconds(known.peak.time));
  } else if (!known.vector) {
    text.size = number(value.x());
  }
  if (known.vector) text.vector = known.axisymmetric ? number(value.x()) + "  " + number(value.z()) : triple(value);
  return text;
}

template <class Statistics>
std::string contact_table(const std::string& of, const std::vector<Statistics>& contacts, bool axisymmetric) {
  TextTable table({of, "", "size", "x  y  z", "at [s]"});
  for (const ContactStatistics& contact : contacts) {
    for (const FigureText& figure : figure_texts(contact, axisymmetric)) {
      table.add({contact.name, figure.heading, figure.size, figure.vector, figure.time});
    }
  }
  return table.text();
}

std::string body_contacts(const RunStatistics& statistics, bool axisymmetric) {
  if (statistics.body_statistics().empty()) return "Contact: the scene has no rigid body\n";
  return "Contact: force and torque of the material on each body, world axes, torque about the body's origin\n" +
         contact_table("body", statistics.body_statistics(), axisymmetric);
}

/// Table of scenes with contact between deformable bodies; else nothing.
std::string pair_contacts(const RunStatistics& statistics) {
  if (statistics.pair_statistics().empty()) return {};
  return "Contact of deformable bodies: force on the second of each pair, world axes\n" +
         contact_table("pair", statistics.pair_statistics(), false) + "\n";
}

std::string motion_table(const RunStatistics& statistics) {
  if (statistics.body_statistics().empty()) return "Motion: the scene has no rigid body\n";
  TextTable table({"body", "x [m]", "y [m]", "z [m]", "start x  y  z [m]", "end x  y  z [m]", "largest turn [deg]"});
  const auto span = [](const mpm::Box& box, int axis) {
    return number(box.min[axis]) + " to " + number(box.max[axis]);
  };
  for (const BodyStatistics& body : statistics.body_statistics()) {
    if (!body.first) continue;
    table.add({body.name, span(body.range, 0), span(body.range, 1), span(body.range, 2), triple(body.first->position),
               triple(body.last.position), number(body.largest_turn * kDegrees)});
  }
  return "Motion: range of each body's origin\n" + table.text();
}

/// Those that are zero from start to end are left out.
std::string energy_table(const RunStatistics& statistics) {
  const auto first = energies_of(*statistics.first_state()), last = energies_of(statistics.last_state());
  TextTable table({"energy [J]", "start", "end", "change"});
  for (std::size_t i = 0; i < last.size(); ++i) {
    const double start = first[i].value, end = last[i].value;
    if (start != 0.0 || end != 0.0) table.add({last[i].heading, number(start), number(end), number(end - start)});
  }
  return "Energies of the material\n" + table.text();
}

std::string audit_table(const RunStatistics& statistics) {
  const SolverState& last = statistics.last_state();
  const auto row = [](const std::string& name, const mpm::Vec3& v) {
    return std::vector<std::string>{name, number(v.x()), number(v.y()), number(v.z())};
  };
  TextTable table({"momentum [N s]", "x", "y", "z"});
  mpm::Vec3 sum = mpm::Vec3::Zero();
  for (const Impulse& impulse : last.impulses) {
    const mpm::Vec3 value = from_message(impulse.impulse);
    sum += value;
    table.add(row(impulse.name, value));
  }
  const mpm::Vec3 change = from_message(last.momentum) - from_message(last.initial_momentum);
  table.add(row("sum of impulses", sum));
  table.add(row("change", change));
  table.add(row("residual", change - sum));
  return fmt::format("Audit: impulses on the material since the start\n{}exchanged {} N s, residual {:.2g} of it\n",
                     table.text(), number(last.momentum_exchanged), last.momentum_error);
}

/// Table of scenes that ask for global quantities; else nothing.
std::string global_table(const RunStatistics& statistics) {
  if (statistics.global_statistics().empty()) return {};
  TextTable table({"quantity", "unit", "start", "end", "least", "most"});
  for (const GlobalStatistics& one : statistics.global_statistics()) {
    table.add({one.name, one.unit, number(one.first), number(one.last), number(one.least), number(one.most)});
  }
  return "Global quantities\n" + table.text() + "\n";
}

std::string command_table(const RunStatistics& statistics) {
  if (statistics.commands().empty()) return "Commands: none; the bodies followed the scene\n";
  TextTable table({"commands", "kind", "applied", "first [s]", "last [s]", "late"});
  for (const auto& [key, value] : statistics.commands()) {
    table.add({key.first, key.second, std::to_string(value.count), number(mpm::nearest_seconds(value.first)),
               number(mpm::nearest_seconds(value.last)), std::to_string(value.late)});
  }
  return "Commands, by the time they took effect (late: after the stamp they carried)\n" + table.text();
}

std::string gap_lines(const std::vector<std::string>& gaps) {
  if (gaps.empty()) return "Gaps in time: none\n";
  return fmt::format("Gaps in time\n  {}\n", fmt::join(gaps, "\n  "));
}

}  // namespace

std::string number(double value) { return fmt::format("{:.4g}", value + 0.0); }  // no "-0"

std::string triple(const mpm::Vec3& vector) {
  return number(vector.x()) + "  " + number(vector.y()) + "  " + number(vector.z());
}

std::vector<FigureText> figure_texts(const ContactStatistics& contact, bool axisymmetric) {
  std::vector<FigureText> texts;
  for (const NumberStatistics& known : contact.numbers) {
    if (known.axisymmetric && !axisymmetric) continue;
    for (const Figure& figure : known.figures) texts.push_back(figure_text(contact, known, figure));
  }
  texts.push_back({"contact [s]", contact_times(contact.contact), "", ""});
  return texts;
}

std::string TextTable::text() const {
  std::vector<std::size_t> widths(rows_.front().size(), 0);
  for (const std::vector<std::string>& row : rows_) {
    for (std::size_t i = 0; i < widths.size(); ++i) widths[i] = std::max(widths[i], row.at(i).size());
  }
  std::string text;
  for (const std::vector<std::string>& row : rows_) {
    std::string line = fmt::format("  {:<{}}", row[0], widths[0]);
    for (std::size_t i = 1; i < widths.size(); ++i) line += fmt::format("   {:>{}}", row[i], widths[i]);
    text += line + "\n";
  }
  return text;
}

std::string tables(const RecordedRun& run) {
  const RunStatistics& statistics = run.statistics;
  const std::array<std::string, 7> parts = {
      run_table(run),
      body_contacts(statistics, run.scene.axisymmetric),
      pair_contacts(statistics) + robot_tables(statistics.robot_statistics()) + motion_table(statistics),
      energy_table(statistics),
      audit_table(statistics),
      global_table(statistics) + command_table(statistics),
      gap_lines(run.gaps)};
  return fmt::format("{}", fmt::join(parts, "\n"));
}

std::string check_lines(const std::vector<CheckResult>& results) {
  std::string text;
  for (const CheckResult& result : results) {
    text += fmt::format("{:<6}{:<11}{}\n", !result.made ? "-" : (result.passed ? "PASS" : "FAIL"), result.name,
                        result.detail);
  }
  return text;
}

}  // namespace mpm_ros
