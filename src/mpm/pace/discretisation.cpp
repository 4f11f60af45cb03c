#include "mpm/pace/discretisation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "mpm/implicit/implicit_step.hpp"
#include "mpm/rules/method_rules.hpp"
#include "mpm/rules/method_text.hpp"

namespace mpm::pace {

namespace {

constexpr double kPartOfStable = 0.9;

std::string cell_text(const Vec3& cell, GeometryKind geometry) {
  std::vector<std::string> lengths;
  bool cubes = true;
  for (const int axis : axes_of(geometry)) {
    lengths.push_back(fmt::format("{:.15g} m", cell[axis]));
    cubes = cubes && cell[axis] == cell.x();
  }
  return cubes ? lengths.front() : fmt::format("[{}]", fmt::join(lengths, ", "));
}

int particles(int along, GeometryKind geometry) {
  int count = 1;
  for (int axis = 0; axis < dimensions(geometry); ++axis) count *= along;
  return count;
}

}  // namespace

double falls_of(double step, const Vec3& cell, const SimulationDefinition& definition) {
  return step * std::sqrt(definition.gravity.norm() / shortest_edge(cell, definition.geometry));
}

Discretisation discretisation_of(const SimulationDefinition& definition) {
  Discretisation own{definition.grid.cell, definition.method.particles_per_direction, definition.method.precision,
                     definition.method.update, definition.time.cfl};
  if (own.update == UpdateScheme::implicit) {
    own.step = std::min(definition.time.step.value_or(kImplicitStep), seconds_of(definition.time.sync));
    own.falls = falls_of(own.step, own.cell, definition);
  }
  return own;
}

const std::vector<std::string>& discretisation_keys() {
  static const std::vector<std::string> keys = {
      "grid.cell", "method.particles_per_cell", "method.precision", "method.update", "time.cfl", "time.step"};
  return keys;
}

std::vector<std::string> set_lines(const Discretisation& chosen, const Discretisation& before, GeometryKind geometry) {
  std::vector<std::string> lines;
  if (chosen.cell != before.cell) lines.push_back("grid.cell=" + cell_text(chosen.cell, geometry));
  if (chosen.along != before.along)
    lines.push_back(fmt::format("method.particles_per_cell={}", particles(chosen.along, geometry)));
  if (chosen.precision != before.precision)
    lines.push_back(fmt::format("method.precision={}", precision_name(chosen.precision)));
  if (chosen.update != before.update) lines.push_back(fmt::format("method.update={}", update_name(chosen.update)));
  if (chosen.step != before.step) lines.push_back(fmt::format("time.step={:.15g}", chosen.step));
  if (chosen.cfl != before.cfl) lines.push_back(fmt::format("time.cfl={:.15g}", chosen.cfl));
  return lines;
}

std::string discretisation_text(const Discretisation& one, GeometryKind geometry) {
  Vec3 cell = one.cell;
  for (const int axis : axes_of(geometry)) cell[axis] = std::stod(fmt::format("{:.4g}", one.cell[axis]));
  return fmt::format(
      "cell {}, {} particle{} a cell, {}, {}, {}", cell_text(cell, geometry), particles(one.along, geometry),
      one.along == 1 ? "" : "s", precision_name(one.precision), update_name(one.update),
      one.implicit() ? fmt::format("steps of {:.3g} ms", 1e3 * one.step) : fmt::format("cfl {:.3g}", one.cfl));
}

double safe_cfl(const Transfer& transfer) { return kPartOfStable * stable_cfl(transfer); }

}  // namespace mpm::pace
