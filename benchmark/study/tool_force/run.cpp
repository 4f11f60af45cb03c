#include "study/tool_force/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>

#include "mpm/choice/method_choice.hpp"
#include "mpm/scene/scene.hpp"
#include "study/runner.hpp"
#include "study/suite.hpp"
#include "study/tool_force/force_measure.hpp"
#include "study/tool_force/places.hpp"

namespace mpm::study::tool_force {
namespace {

namespace fs = std::filesystem;

const std::vector<double> kQuickCells = {4.0, 6.0, 8.0};
const std::vector<double> kFullCells = {4.0, 6.0, 8.0, 12.0, 16.0, 24.0};

std::string joined(const Overrides& overrides) {
  std::string text;
  for (const std::string& one : overrides) text += (text.empty() ? "" : ", ") + one;
  return text;
}

/// A problem as a variant asks for it.
struct Run {
  Problem problem;
  Setup setup;
  Place place;
  Overrides keys;  ///< keys of the scene

  /// With explicit steps, unless a variant names others.
  Scene scene() const {
    Overrides all = {"method={update: usavg}"};
    all.insert(all.end(), keys.begin(), keys.end());
    return parse_scene(moved(problem, problem.scene(problem, setup), place), problem.name, all);
  }
};

/// The value of "name=value", if it is that.
std::optional<std::string> value_of(const std::string& text, const std::string& name) {
  if (text.rfind(name + "=", 0) != 0) return {};
  return text.substr(name.size() + 1);
}

/// Reads "0.5,0.25", parts of a cell along x and z.
Place read_place(const std::string& text) {
  Place place{};
  char end = 0;
  if (std::sscanf(text.c_str(), "%lf,%lf%c", &place[0], &place[1], &end) == 2) return place;
  throw StudyError("'beside=" + text +
                   "' is no place within a cell; write parts of a cell along x and z, such as beside=0,0.5");
}

Run resolve(const Problem& problem, double cells, const Overrides& variant, const Overrides& set) {
  Run run{problem, {cells, {}}, {}, {}};
  for (const Overrides* list : {&set, &variant}) {
    for (const std::string& one : *list) {
      if (const auto law = value_of(one, "law")) {
        run.setup.law = *law;
      } else if (const auto speed = value_of(one, "speed")) {
        const double factor = std::atof(speed->c_str());
        if (!(factor > 0.0))
          throw StudyError("'" + one + "' is no factor of the tool's speed; write one such as speed=0.5");
        run.problem.speed *= factor;
      } else if (const auto beside = value_of(one, "beside")) {
        run.place = read_place(*beside);
      } else {
        run.keys.push_back(one);
      }
    }
  }
  return run;
}

/// Energy that came from nowhere: what is stored and dissipated beyond the work done since, over the work of tools.
double imbalance(const EnergyReport& before, const EnergyReport& after) {
  using Kind = EnergyReport::Kind;
  const auto gained = [&](Kind kind) { return after.sum(kind) - before.sum(kind); };
  return (gained(Kind::stored) + gained(Kind::dissipated) - gained(Kind::work)) / std::abs(after.of("contact_work"));
}

void describe(const SimulationDefinition& definition, ForceRow& row) {
  row.contact = definition.contact.method == ContactMethod::points ? "points" : "nodes";
  row.shape = shape_name(definition.method.shape);
  row.update = kUpdateNames[static_cast<int>(definition.method.update)];
  row.transfer = choice::transfer_label(definition.method.transfer);
  row.law = law_name(definition.materials.front().law);
  row.average_dilatation = definition.method.average_dilatation;
}

}  // namespace

std::vector<Overrides> variants_of(const std::vector<std::string>& vary) {
  std::vector<Overrides> all = {{}};
  for (const std::string& axis : vary) {
    const std::size_t equal = axis.find('=');
    if (equal == std::string::npos || equal == 0) {
      throw StudyError("'" + axis + "' names no values; write key=value|value, such as contact.method=points|nodes");
    }
    std::vector<Overrides> next;
    for (const Overrides& before : all) {
      std::size_t from = equal + 1;
      while (from <= axis.size()) {
        const std::size_t to = std::min(axis.find('|', from), axis.size());
        next.push_back(before);
        next.back().push_back(axis.substr(0, equal + 1) + axis.substr(from, to - from));
        from = to + 1;
      }
    }
    all = std::move(next);
  }
  return all;
}

ForceRow run_row(const Problem& problem, double cells, const Overrides& variant, const Overrides& set) {
  ForceRow row;
  row.problem = problem.name;
  row.cells = cells;
  row.variant = joined(variant);
  row.answer = problem.answer;
  row.known = problem.known;
  double spent = 0.0, simulated = 0.0;
  std::optional<Run> run;
  std::unique_ptr<Measure> measure;
  try {
    run = resolve(problem, cells, variant, set);
    measure = run->problem.measure ? run->problem.measure(run->problem, cells)
                                   : std::make_unique<ForceMeasure>(run->problem, cells);
    SimulationDefinition definition = build(run->scene());
    describe(definition, row);
    Simulation simulation(std::move(definition), SimulationOptions{1});
    row.particles = simulation.particles();
    const EnergyReport before_run = simulation.state().energy;
    measure->look(simulation);
    const std::int64_t end = nanoseconds_of(simulation.definition().time.end);
    while (!measure->done() && simulation.time() < end) {
      const double before = processor_time();
      simulation.advance();
      spent += processor_time() - before;
      simulated = seconds_of(simulation.time());
      row.steps = simulation.state().step.steps;
      measure->look(simulation);
    }
    row.imbalance = imbalance(before_run, simulation.state().energy);
    row.status = "ok";
  } catch (const PhysicsError& error) {
    row.status = "failed";
    row.message = error.what();
  } catch (const Error& error) {
    row.status = row.steps > 0 ? "failed" : "refused";
    row.message = error.what();
  }
  if (measure) measure->report(row);
  row.cpu_seconds = spent;
  if (spent > 0.0) row.real_time_factor = simulated / spent;
  return row;
}

ForceRow run_places(const Problem& problem, double cells, const Overrides& variant, const Overrides& set) {
  std::vector<ForceRow> rows;
  for (const Overrides* list : {&set, &variant}) {
    for (const std::string& one : *list) {
      if (value_of(one, "beside"))
        throw StudyError("'" + one + "' is one place, and five are asked for; leave one out");
    }
  }
  for (const Place& place : five_places(problem)) {
    Overrides there = set;
    there.push_back(fmt::format("beside={},{}", place[0], place[1]));
    rows.push_back(run_row(problem, cells, variant, there));
  }
  return mean_of(rows);
}

void run_tool_force(const ForceOptions& options, const std::function<void(const std::string&)>& progress) {
  std::vector<const Problem*> chosen;
  for (const std::string& name : options.problems) chosen.push_back(&find_problem(name));
  if (chosen.empty()) {
    for (const Problem& problem : problems()) {
      if (problem.quick || options.full) chosen.push_back(&problem);
    }
  }
  const std::vector<double>& cells = !options.cells.empty() ? options.cells : options.full ? kFullCells : kQuickCells;
  const std::vector<Overrides> variants = variants_of(options.vary);
  std::error_code error;
  fs::create_directories(options.folder, error);
  const fs::path folder(options.folder);
  const auto create = [](const fs::path& path) {
    std::ofstream file(path);
    if (!file) throw StudyError(path.string() + ": cannot be written; check the folder and its permissions");
    return file;
  };
  if (!options.only_write) progress(table_header());
  std::vector<ForceRow> rows;
  for (const Problem* problem : chosen) {
    for (const double count : cells) {
      if (options.cells.empty() && count > problem->finest) continue;
      for (std::size_t v = 0; v < variants.size(); ++v) {
        if (options.only_write) {
          const fs::path path = folder / fmt::format("{}_{:g}_{}.yaml", problem->name, count, v);
          create(path) << resolve(*problem, count, variants[v], options.set).scene().text << '\n';
          progress(path.string());
          continue;
        }
        rows.push_back(options.places ? run_places(*problem, count, variants[v], options.set)
                                      : run_row(*problem, count, variants[v], options.set));
        progress(table_line(rows.back()));
        std::ofstream file = create(folder / "tool_force.json");  // after each run, so that none is lost
        write_json(file, rows);
      }
    }
  }
}

}  // namespace mpm::study::tool_force
