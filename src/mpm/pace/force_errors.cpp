#include "mpm/pace/force_errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <istream>
#include <map>
#include <utility>

#include "mpm/rules/method_text.hpp"

namespace mpm::pace {

namespace {

constexpr const char* kColumns = "problem,use,ground,axes,cells,along,precision,update,cfl,force,cost";
constexpr double kReferenceCfl = 0.5;
constexpr double kLeastError = 0.01;
constexpr double kSame = 1e-6;  ///< part by which cells and steps of two runs may differ

bool same(double a, double b) { return std::abs(a - b) <= kSame * std::abs(b); }

bool is_implicit(const ForceRun& run) { return run.update == UpdateScheme::implicit; }

bool explicit_reference(const ForceRun& run) {
  return run.precision == Precision::float64 && run.update == UpdateScheme::usavg && same(run.cfl, kReferenceCfl);
}

bool same_grid(const ForceRun& a, const ForceRun& b) {
  return a.problem == b.problem && same(a.cells, b.cells) && a.along == b.along;
}

bool is_like(const ForceRun& run, const ToolInGround& tool) {
  return (!tool.use || run.use == *tool.use) && (!tool.ground || run.ground == *tool.ground);
}

int axes_of_grid(GeometryKind geometry) { return std::max(2, dimensions(geometry)); }

/// Root of the mean square; 0 of none.
class MeanSquare {
 public:
  void add(double value) {
    sum_ += value * value;
    ++count_;
  }
  double root() const { return count_ == 0 ? 0.0 : std::sqrt(sum_ / count_); }

 private:
  double sum_ = 0.0;
  int count_ = 0;
};

/// Error of one problem, from points {cells, error} by falling cells, in which errors never fall.
double between(const std::vector<std::pair<double, double>>& points, double cells) {
  if (cells >= points.front().first) return points.front().second;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const auto& [finer, small] = points[i - 1];
    const auto& [coarser, large] = points[i];
    if (cells < coarser * (1.0 - kSame)) continue;
    const double part = std::log(finer / cells) / std::log(finer / coarser);
    return std::exp((1.0 - part) * std::log(small) + part * std::log(large));
  }
  return points.back().second;
}

std::vector<std::string> split_cells(const std::string& line) {
  std::vector<std::string> words(1);
  for (const char c : line) {
    if (c == ',') {
      words.emplace_back();
    } else if (c != '\r') {
      words.back() += c;
    }
  }
  return words;
}

double positive_cell(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !(value > 0.0) || !std::isfinite(value))
    throw FiguresError("'" + text + "' is not a number greater than 0");
  return value;
}

int whole_cell(const std::string& text, int least, int most) {
  const double value = positive_cell(text);
  if (value != std::floor(value) || value < least || value > most)
    throw FiguresError(fmt::format("'{}' is not a whole number from {} to {}", text, least, most));
  return static_cast<int>(value);
}

/// The place of a word among names.
template <std::size_t N>
std::size_t place_of(const std::array<const char*, N>& names, const std::string& word, const char* what) {
  const auto found = std::find(names.begin(), names.end(), word);
  if (found == names.end()) throw FiguresError(fmt::format("'{}' is no {}", word, what));
  return static_cast<std::size_t>(found - names.begin());
}

ForceRun parse_run(const std::string& line) {
  const std::vector<std::string> words = split_cells(line);
  if (words.size() != split_cells(kColumns).size()) throw FiguresError(fmt::format("{} cells, not 11", words.size()));
  ForceRun run;
  run.problem = words[0];
  run.use = static_cast<ToolUse>(place_of(kToolUseNames, words[1], "use"));
  run.ground = static_cast<Ground>(place_of(kGroundNames, words[2], "ground"));
  run.axes = whole_cell(words[3], 2, 3);
  run.cells = positive_cell(words[4]);
  run.along = whole_cell(words[5], 1, 5);
  if (words[6] != "double" && words[6] != "single") throw FiguresError("'" + words[6] + "' is no precision");
  run.precision = words[6] == "double" ? Precision::float64 : Precision::float32;
  run.update = static_cast<UpdateScheme>(place_of(kUpdateNames, words[7], "update"));
  run.cfl = positive_cell(words[8]);
  run.force = positive_cell(words[9]);
  if (!words[10].empty()) run.cost = positive_cell(words[10]);
  return run;
}

}  // namespace

ForceErrors::ForceErrors(std::vector<ForceRun> runs) : runs_(std::move(runs)) {
  if (std::none_of(runs_.begin(), runs_.end(), explicit_reference))
    throw FiguresError("no run in double precision with usavg and cfl 0.5, which the others are compared with");
}

bool ForceErrors::reference(const ForceRun& run) const {
  if (!is_implicit(run)) return explicit_reference(run);
  return run.precision == Precision::float64 && std::none_of(runs_.begin(), runs_.end(), [&](const ForceRun& other) {
           return is_implicit(other) && same_grid(run, other) && other.cfl < run.cfl * (1.0 - kSame);
         });
}

std::optional<double> ForceErrors::grid_error(const ToolInGround& tool, int axes, double cells, int along,
                                              bool implicit) const {
  std::map<std::string, std::vector<std::pair<double, double>>> problems;
  for (const ForceRun& run : runs_) {
    if (run.axes == axes && run.along == along && is_implicit(run) == implicit && is_like(run, tool) && reference(run))
      problems[run.problem].emplace_back(run.cells, std::max(kLeastError, std::abs(run.force - 1.0)));
  }
  double largest = 0.0;
  bool covered = false;
  for (auto& [name, points] : problems) {
    std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    for (std::size_t i = 1; i < points.size(); ++i) points[i].second = std::max(points[i].second, points[i - 1].second);
    largest = std::max(largest, between(points, cells));
    covered = covered || cells >= points.back().first * (1.0 - kSame);
  }
  if (!covered) return std::nullopt;
  return largest;
}

double ForceErrors::change(int axes, Precision precision, UpdateScheme update) const {
  MeanSquare mean;
  for (const ForceRun& run : runs_) {
    if (run.axes != axes || run.precision != precision || run.update != update || !same(run.cfl, kReferenceCfl))
      continue;
    for (const ForceRun& other : runs_) {
      if (same_grid(run, other) && explicit_reference(other)) mean.add(run.force / other.force - 1.0);
    }
  }
  return mean.root();
}

double ForceErrors::step_error(int axes, double cfl, UpdateScheme family) const {
  std::map<double, MeanSquare> by_cfl;
  for (const ForceRun& run : runs_) {
    if (run.axes != axes || run.precision != Precision::float64 || run.update != family) continue;
    const ForceRun* least = nullptr;
    for (const ForceRun& other : runs_) {
      const bool comparable = same_grid(run, other) && other.precision == run.precision && other.update == run.update;
      if (comparable && (least == nullptr || other.cfl < least->cfl)) least = &other;
    }
    // A grid that was run with one step alone tells nothing of steps.
    if (least != &run) by_cfl[run.cfl].add(run.force / least->force - 1.0);
  }
  double before_cfl = 0.0, before = 0.0;
  for (const auto& [at, mean] : by_cfl) {
    const double error = std::max(before, mean.root());
    if (cfl <= at * (1.0 + kSame)) return before + (error - before) * (cfl - before_cfl) / (at - before_cfl);
    before_cfl = at;
    before = error;
  }
  return before_cfl > 0.0 ? before * cfl / before_cfl : 0.0;
}

bool ForceErrors::covers(const ToolInGround& tool, GeometryKind geometry, bool implicit) const {
  return std::any_of(runs_.begin(), runs_.end(), [&](const ForceRun& run) {
    return run.axes == axes_of_grid(geometry) && is_implicit(run) == implicit && is_like(run, tool) && reference(run);
  });
}

std::optional<ForceError> ForceErrors::of(const Discretisation& one, const ToolInGround& tool,
                                          GeometryKind geometry) const {
  const int axes = axes_of_grid(geometry);
  double widest = 0.0;
  for (const int axis : mpm::axes_of(geometry)) widest = std::max(widest, one.cell[axis]);
  const std::optional<double> grid = grid_error(tool, axes, tool.length / widest, one.along, one.implicit());
  if (!grid) return std::nullopt;
  const double rounding = change(axes, one.precision, UpdateScheme::usavg);
  if (one.implicit()) return ForceError{*grid, rounding, 0.0, step_error(axes, one.falls, UpdateScheme::implicit)};
  // USL is of first order in the step as USF is, and has no figures of its own.
  const UpdateScheme update = one.update == UpdateScheme::usl ? UpdateScheme::usf : one.update;
  return ForceError{*grid, rounding, change(axes, Precision::float64, update),
                    step_error(axes, one.cfl, UpdateScheme::usavg)};
}

double ForceErrors::cost_factor(Precision precision, UpdateScheme update) const {
  double product = 1.0;
  int count = 0;
  for (const ForceRun& run : runs_) {
    if (run.precision != precision || run.update != update || run.cost == 0.0) continue;
    for (const ForceRun& other : runs_) {
      const bool usual = other.precision == Precision::float64 && other.update == UpdateScheme::usavg;
      if (!usual || !same_grid(run, other) || !same(run.cfl, other.cfl) || other.cost == 0.0) continue;
      product *= run.cost / other.cost;
      ++count;
    }
  }
  return count == 0 ? 1.0 : std::pow(product, 1.0 / count);
}

ForceErrors read_force_errors(std::istream& in) {
  std::string line;
  std::getline(in, line);
  if (split_cells(line) != split_cells(kColumns))
    throw FiguresError(fmt::format("line 1: not the header {}", kColumns));
  std::vector<ForceRun> runs;
  for (int number = 2; std::getline(in, line); ++number) {
    try {
      runs.push_back(parse_run(line));
    } catch (const FiguresError& error) {
      throw FiguresError(fmt::format("line {}: {}", number, error.what()));
    }
  }
  return ForceErrors(std::move(runs));
}

}  // namespace mpm::pace
