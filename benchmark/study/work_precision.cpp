#include "study/work_precision.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include "study/runner.hpp"
#include "study/summary.hpp"

namespace mpm::study {
namespace {

namespace fs = std::filesystem;

constexpr CostSettings kQuickCost = {5, 3e-3};
constexpr CostSettings kFullCost = {7, 20e-3};

std::ofstream create(const fs::path& path) {
  std::ofstream file(path);
  if (!file) {
    throw StudyError(fmt::format("{}: cannot be written; check the folder and its permissions", path.string()));
  }
  return file;
}

/// True if the short study leaves methods out on this suite.
bool main_alone(const Suite& suite, const StudyOptions& options) { return suite.costly && !options.full; }

void write_texts(std::ostream& out, const std::vector<const Suite*>& chosen, const StudyOptions& options) {
  out << "suite,title,geometry,problem,exact,measure,methods\n";
  for (const Suite* suite : chosen) {
    const char* methods = !options.methods.empty() ? "chosen" : main_alone(*suite, options) ? "main" : "all";
    out << quoted(suite->name) << ',' << quoted(suite->title) << ',' << geometry_name(suite->geometry) << ','
        << quoted(suite->problem) << ',' << quoted(suite->exact) << ',' << quoted(suite->measure_text) << ',' << methods
        << '\n';
  }
  out << std::flush;
}

std::string described(const Row& row) {
  const std::string start = fmt::format("{}, {} cells, {} a cell, Courant {:g}, {}: ", row.suite, row.cells,
                                        row.particles_per_cell, row.cfl, row.method);
  if (row.status != "ok") return start + row.status + ", " + row.message;
  return start +
         fmt::format("error {:.3g}, {:.3g} s, relative cost {:.2f}", row.error, row.cpu_seconds, row.relative_cost);
}

}  // namespace

void run_study(const StudyOptions& options, const std::function<void(const std::string&)>& progress) {
  std::vector<const Suite*> chosen;
  for (const std::string& name : options.suites) chosen.push_back(&find_suite(name));
  if (chosen.empty()) {
    for (const Suite& suite : suites()) chosen.push_back(&suite);
  }
  std::vector<choice::MethodChoice> asked;
  for (const std::string& label : options.methods) asked.push_back(choice::find_method(label));
  std::error_code error;
  fs::create_directories(options.folder, error);
  const fs::path folder(options.folder);
  std::ofstream file = create(folder / "work_precision.csv"), summary = create(folder / "summary.csv");
  std::ofstream texts = create(folder / "suites.csv");
  write_texts(texts, chosen, options);

  Runner runner(options.full ? kFullCost : kQuickCost);
  std::vector<Row> rows;
  write_header(file);
  for (const Suite* suite : chosen) {
    const std::vector<choice::MethodChoice> methods = !asked.empty()                ? asked
                                                      : main_alone(*suite, options) ? choice::main_methods()
                                                                                    : choice::charted_methods();
    // Grid by grid, so that one reference serves all methods on it.
    for (const Discretisation& discretisation : options.full ? suite->full : suite->quick) {
      for (const choice::MethodChoice& method : methods) {
        rows.push_back(runner.run(*suite, method, discretisation));
        write_row(file, rows.back());
        progress(described(rows.back()));
      }
    }
  }
  write_summary(summary, summarise(rows));
  if (!file || !summary || !texts)
    throw StudyError(options.folder + ": not all could be written; is there space left?");
}

}  // namespace mpm::study
