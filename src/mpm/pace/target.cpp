#include "mpm/pace/target.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "mpm/implicit/implicit_step.hpp"
#include "mpm/rules/method_rules.hpp"
#include "mpm/rules/method_text.hpp"

namespace mpm::pace {

namespace {

constexpr std::size_t kMostRows = 16;                                  ///< rows of the front that a table shows
constexpr std::array<double, 3> kImplicitSteps = {0.005, 0.01, 0.02};  ///< that there are figures for [s]

bool identical(const Discretisation& a, const Discretisation& b) {
  return a.cell == b.cell && a.along == b.along && a.precision == b.precision && a.update == b.update &&
         a.cfl == b.cfl && a.step == b.step;
}

/// The values of a part of the discretisation: that of the scene, and the others where it may be changed.
template <class T>
std::vector<T> values(bool keeps, T own, const std::vector<T>& others) {
  std::vector<T> all = {own};
  for (const T& other : others) {
    if (!keeps && std::find(all.begin(), all.end(), other) == all.end()) all.push_back(other);
  }
  return all;
}

/// The largest of several tools; nothing where one has no figures.
std::optional<ForceError> largest_error(const ForceErrors& errors, const Discretisation& one,
                                        const std::vector<ToolInGround>& tools, GeometryKind geometry) {
  std::optional<ForceError> largest;
  for (const ToolInGround& tool : tools) {
    const auto error = errors.of(one, tool, geometry);
    if (!error) return std::nullopt;
    if (!largest || error->total() > largest->total()) largest = error;
  }
  return largest;
}

std::string percent(double part) { return fmt::format("{:.2g}", 100.0 * part); }

using Indices = std::vector<std::size_t>;

/// Fastest of those with the least error.
std::size_t most_exact(const std::vector<Candidate>& all, const Indices& among) {
  const auto error = [&](std::size_t i) { return all[i].error.total(); };
  double least = error(among.front());
  for (const std::size_t i : among) least = std::min(least, error(i));
  std::size_t best = all.size();
  for (const std::size_t i : among) {
    if (error(i) <= least + kSameError && (best == all.size() || all[i].pace > all[best].pace)) best = i;
  }
  return best;
}

/// Candidate with the least error among the fastest.
std::size_t fastest(const std::vector<Candidate>& all, const Indices& among) {
  double most = 0.0;
  for (const std::size_t i : among) most = std::max(most, all[i].pace);
  std::size_t best = all.size();
  for (const std::size_t i : among) {
    if (all[i].pace < most / (1.0 + kSamePace)) continue;
    if (best == all.size() || all[i].error.total() < all[best].error.total()) best = i;
  }
  return best;
}

}  // namespace

bool Target::keeps(const std::string& key) const { return std::find(keep.begin(), keep.end(), key) != keep.end(); }

std::string target_text(const Target& target) {
  return target.real_time ? fmt::format("real_time: {:g}", *target.real_time)
                          : fmt::format("force_error: {:g} %", 100.0 * target.force_error.value_or(0.0));
}

double StepCosts::steps(const Discretisation& one) const {
  const double edge = shortest_edge(one.cell, geometry);
  double longest = one.step;
  if (!one.implicit()) {
    longest = std::min(one.cfl * wave_time * edge / shortest_edge(base.cell, geometry), step.value_or(sync));
  } else if (fastest > 0.0) {
    longest = std::min(longest, kImplicitTravel * edge / fastest);
  }
  return std::max(1.0, std::ceil(sync / longest - 1e-9));
}

double StepCosts::pace(const Discretisation& one) const {
  double count = particles;
  for (const int axis : axes_of(geometry)) {
    count *= base.cell[axis] / one.cell[axis] * static_cast<double>(one.along) / static_cast<double>(base.along);
  }
  return sync / (steps(one) * count * particle_step(one.precision, one.update));
}

std::vector<Candidate> candidates(const Target& target, const std::vector<ToolInGround>& tools,
                                  const std::vector<std::pair<Vec3, int>>& cells,
                                  const SimulationDefinition& definition, const ForceErrors& errors,
                                  const StepCosts& costs) {
  const Discretisation own = discretisation_of(definition);
  const double safe = safe_cfl(definition.method.transfer);
  const auto precisions =
      values(target.keeps("method.precision"), own.precision, {Precision::float64, Precision::float32});
  // A scene keeps its kind of steps: which materials and tools each is for a target does not weigh.
  const auto updates =
      values(target.keeps("method.update") || own.implicit(), own.update, {UpdateScheme::usavg, UpdateScheme::usf});
  std::vector<double> lengths;
  for (const double step : kImplicitSteps) {
    if (own.implicit() && step <= costs.sync * (1.0 + 1e-9)) lengths.push_back(step);
  }
  const auto steps = values(target.keeps("time.step"), own.step, lengths);
  std::vector<double> lower;
  for (const double cfl : {0.3, 0.5, 0.7, safe}) {
    if (cfl <= safe && !own.implicit()) lower.push_back(cfl);
  }
  const auto cfls = values(target.keeps("time.cfl"), own.cfl, lower);
  std::vector<Candidate> all;
  for (const auto& [cell, along] : cells) {
    if (target.keeps("grid.cell") && cell != own.cell) continue;
    if (target.keeps("method.particles_per_cell") && along != own.along) continue;
    for (const Precision precision : precisions) {
      for (const UpdateScheme update : updates) {
        MethodDefinition method = definition.method;
        method.precision = precision;
        method.update = update;
        if (method_fault(method, definition.geometry)) continue;
        const auto add = [&](double cfl, double step) {
          Candidate one;
          one.what = {cell, along, precision, update, cfl, step, falls_of(step, cell, definition)};
          const auto error = largest_error(errors, one.what, tools, definition.geometry);
          if (!error) return;
          one.error = *error;
          one.pace = costs.pace(one.what);
          all.push_back(one);
        };
        for (const double cfl : cfls) {
          for (const double step : steps) add(cfl, step);
        }
      }
    }
  }
  return all;
}

bool reaches(const Target& target, const Candidate& candidate) {
  if (target.real_time)
    return candidate.pace >= kSpare * *target.real_time && candidate.error.total() <= target.most_error;
  return candidate.error.total() <= *target.force_error;
}

std::size_t choose(const Target& target, const std::vector<Candidate>& all) {
  Indices reaching, exact_enough, every;
  for (std::size_t i = 0; i < all.size(); ++i) {
    every.push_back(i);
    if (reaches(target, all[i])) reaching.push_back(i);
    if (all[i].error.total() <= target.most_error) exact_enough.push_back(i);
  }
  if (!target.real_time) return reaching.empty() ? most_exact(all, every) : fastest(all, reaching);
  if (!reaching.empty()) return most_exact(all, reaching);
  return exact_enough.empty() ? most_exact(all, every) : fastest(all, exact_enough);
}

std::vector<Candidate> front(const std::vector<Candidate>& all) {
  std::vector<Candidate> sorted = all, kept;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Candidate& a, const Candidate& b) {
    return a.pace != b.pace ? a.pace > b.pace : a.error.total() < b.error.total();
  });
  for (const Candidate& one : sorted) {
    if (kept.empty() || one.error.total() < kept.back().error.total()) kept.push_back(one);
  }
  std::reverse(kept.begin(), kept.end());
  return kept;
}

std::string candidates_table(const std::vector<Candidate>& all, const Candidate& chosen, const Discretisation& base,
                             GeometryKind geometry) {
  struct Line {
    std::string mark;
    const Candidate* one;
  };
  const std::vector<Candidate> best = front(all);
  std::vector<Line> lines = {{"chosen", &chosen}};
  for (const Candidate& one : all) {
    if (identical(one.what, base) && !identical(one.what, chosen.what)) lines.push_back({"the scene", &one});
  }
  // Around the chosen one, where a front is long.
  std::size_t at = 0;
  while (at < best.size() && best[at].pace < chosen.pace) ++at;
  const std::size_t from = at > kMostRows / 2 ? at - kMostRows / 2 : 0;
  for (std::size_t i = from; i < std::min(best.size(), from + kMostRows); ++i) {
    const Candidate& one = best[i];
    if (identical(one.what, chosen.what) || identical(one.what, base)) continue;
    lines.push_back({one.pace < chosen.pace ? "more exact" : "faster", &one});
  }
  std::size_t width = 0;
  for (const Line& line : lines) width = std::max(width, discretisation_text(line.one->what, geometry).size());
  std::string text = fmt::format("  {:<10}  {:<{}}  {:>9}  {:>7}  {:>6} {:>9} {:>6} {:>5}\n", "", "", width,
                                 "real time", "error %", "grid", "precision", "update", "step");
  for (const Line& line : lines) {
    const Candidate& one = *line.one;
    text += fmt::format("  {:<10}  {:<{}}  {:>9.2g}  {:>7}  {:>6} {:>9} {:>6} {:>5}\n", line.mark,
                        discretisation_text(one.what, geometry), width, one.pace, percent(one.error.total()),
                        percent(one.error.grid), percent(one.error.precision), percent(one.error.update),
                        percent(one.error.step));
  }
  return text;
}

}  // namespace mpm::pace
