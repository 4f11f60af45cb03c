// The stress of soil under its own weight, less what water in its pores carries. Over several ranks the parts of a
// column come to one rank, which adds them up in the order of their depth, so that the stresses are to the bit those of
// one process.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "mpm/ranks/agree.hpp"
#include "mpm/ranks/of_all.hpp"
#include "mpm/rules/geometry_rules.hpp"
#include "mpm/start/initial.hpp"
#include "state.hpp"

namespace mpm {
namespace {

constexpr double kGap = 1.5;  ///< particle spacings from centre to centre that part a column

/// A particle in its column.
struct Part {
  int family;            ///< number of the columns' lattice
  std::int64_t column;   ///< number of the column in the lattice
  double depth;          ///< along gravity [m]
  double weight;         ///< [N]
  double area;           ///< area of the column [m^2]
  std::uint32_t number;  ///< in the list that it came in
};

int axis_of(const Vec3& gravity) {
  int axis = 0;
  if (!(gravity.norm() > 0.0)) {
    throw DefinitionError("a geostatic start needs gravity; write it, such as gravity: [0, 0, -9.81]");
  }
  gravity.cwiseAbs().maxCoeff(&axis);
  if (std::abs(gravity[axis]) < (1.0 - 1e-12) * gravity.norm()) {
    throw DefinitionError(fmt::format(
        "a geostatic start needs gravity along an axis of the grid, not ({:g}, {:g}, {:g}) m/s^2; turn the scene, "
        "or let the soil settle in the run",
        gravity.x(), gravity.y(), gravity.z()));
  }
  return axis;
}

/// The lattice of a body's particles, and the number of those on which bodies before it have theirs: bodies whose
/// columns are the same across gravity are of one family, wherever their lattices begin.
class ColumnFamilies {
 public:
  ColumnFamilies(const SimulationDefinition& definition, int up) : up_(up) {
    grid_.origin = definition.grid.min;
    grid_.spacing = definition.grid.cell / definition.method.particles_per_direction;
    // Rings: weight and area are those of their section, a column is as heavy at any radius.
    flat_ = dimensions(definition.geometry) == 2;
    across_ = planar(definition.geometry) ? definition.thickness : 1.0;
  }
  /// Lattice of a body, with the size across the plane along y.
  ParticleLattice lattice_of(const DeformableBody& body) const {
    ParticleLattice lattice = body.lattice.value_or(grid_);
    if (flat_) lattice.spacing.y() = across_;
    return lattice;
  }
  int family_of(const ParticleLattice& lattice) {
    const auto same = [&](const ParticleLattice& other) {
      for (int axis = 0; axis < 3; ++axis) {
        if (!is_across(axis)) continue;
        const double spacing = lattice.spacing[axis];
        const double apart = (other.origin[axis] - lattice.origin[axis]) / spacing;
        if (std::abs(apart - std::round(apart)) > 1e-6 || std::abs(other.spacing[axis] - spacing) > 1e-9 * spacing) {
          return false;
        }
      }
      return true;
    };
    const auto found = std::find_if(families_.begin(), families_.end(), same);
    if (found != families_.end()) return static_cast<int>(found - families_.begin());
    families_.push_back(lattice);
    return static_cast<int>(families_.size()) - 1;
  }
  /// That by which the columns of a family are counted.
  const ParticleLattice& lattice_of(int family) const { return families_[static_cast<std::size_t>(family)]; }
  bool is_across(int axis) const { return axis != up_ && !(flat_ && axis == 1); }

 private:
  int up_;
  ParticleLattice grid_;
  bool flat_ = false;
  double across_ = 1.0;
  std::vector<ParticleLattice> families_;
};

/// Stress of each part, by number: half of its own weight and that of all above it, over the column's area [Pa]. Parts
/// of a column that are farther from each other than `gap` [m] carry nothing of each other.
std::vector<double> vertical_stresses(std::vector<Part> parts, double gap) {
  std::sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) {
    if (a.family != b.family) return a.family < b.family;
    return a.column != b.column ? a.column < b.column : a.depth < b.depth;
  });
  std::vector<double> stresses(parts.size());
  double above = 0.0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Part& part = parts[i];
    const bool on_other = i > 0 && parts[i - 1].family == part.family && parts[i - 1].column == part.column &&
                          part.depth - parts[i - 1].depth < gap;
    if (!on_other) above = 0.0;
    stresses[part.number] = -(above + 0.5 * part.weight) / part.area;
    above += part.weight;
  }
  return stresses;
}

/// The rank that finds the stresses of a column: any, but the same for all ranks, and of neighbours another.
int rank_of(std::int64_t column, int size) {
  const std::uint64_t mixed =
      (static_cast<std::uint64_t>(column) ^ static_cast<std::uint64_t>(column) >> 31) * 0x9e3779b97f4a7c15u;
  return static_cast<int>((mixed >> 33) % static_cast<std::uint64_t>(size));
}

/// The same over ranks, which have parts of columns: each column comes to one of them, and the stresses go back.
std::vector<double> vertical_stresses(Communicator& ranks, const std::vector<Part>& own, double gap) {
  std::vector<std::vector<Part>> parts(static_cast<std::size_t>(ranks.size()));
  for (const Part& part : own) parts[rank_of(part.column, ranks.size())].push_back(part);
  parts = exchange(ranks, std::move(parts));
  std::vector<Part> columns;
  std::vector<std::size_t> counts;
  for (std::vector<Part>& of_rank : parts) {
    counts.push_back(of_rank.size());
    for (Part& part : of_rank) {
      part.number = static_cast<std::uint32_t>(columns.size());
      columns.push_back(part);
    }
    of_rank = {};
  }
  const std::vector<double> found = vertical_stresses(std::move(columns), gap);
  std::vector<std::vector<double>> back;
  auto next = found.begin();
  for (const std::size_t count : counts) {
    back.emplace_back(next, next + static_cast<std::ptrdiff_t>(count));
    next += static_cast<std::ptrdiff_t>(count);
  }
  back = exchange(ranks, std::move(back));
  std::vector<std::size_t> read(back.size(), 0);
  std::vector<double> stresses(own.size());
  for (const Part& part : own) {
    const auto rank = static_cast<std::size_t>(rank_of(part.column, ranks.size()));
    stresses[part.number] = back[rank][read[rank]++];
  }
  return stresses;
}

/// Least value of all ranks.
double least_of(const std::vector<double>& values, Communicator* ranks) {
  double least = std::numeric_limits<double>::infinity();
  for (const double value : values) least = std::min(least, value);
  return least_of_all(ranks, least);
}

/// Extent of the centres of a body's particles, on all ranks.
struct Extent {
  std::string body;
  int family;
  Vec3 min, max;
};

Extent extent_of(const DeformableBody& body, int family, Communicator* ranks) {
  constexpr double kNone = -std::numeric_limits<double>::infinity();
  std::array<double, 6> ends = {kNone, kNone, kNone, kNone, kNone, kNone};
  for (const Vec3& place : body.positions) {
    for (int axis = 0; axis < 3; ++axis) {
      ends[axis] = std::max(ends[axis], -place[axis]);
      ends[3 + axis] = std::max(ends[3 + axis], place[axis]);
    }
  }
  find_largest(ranks, ends.data(), static_cast<int>(ends.size()));
  return {body.name, family, {-ends[0], -ends[1], -ends[2]}, {ends[3], ends[4], ends[5]}};
}

/// Warns of bodies of different columns of which one lies on the other: the stresses leave out what it weighs.
void warn_of_other_columns(const std::vector<Extent>& extents, const ColumnFamilies& families, int up, double down,
                           double gap, std::vector<std::string>& warnings) {
  for (std::size_t i = 0; i < extents.size(); ++i) {
    for (std::size_t j = i + 1; j < extents.size(); ++j) {
      const Extent &one = extents[i], &other = extents[j];
      bool meet = one.family != other.family;
      for (int axis = 0; axis < 3; ++axis) {
        const double slack = axis == up ? gap : 0.0;
        if (axis != up && !families.is_across(axis)) continue;
        meet = meet && std::min(one.max[axis], other.max[axis]) + slack >= std::max(one.min[axis], other.min[axis]);
      }
      if (!meet) continue;
      const auto depth = [&](const Extent& body) { return down * (body.min[up] + body.max[up]); };
      const bool first = depth(one) < depth(other);
      const std::string &upper = (first ? one : other).body, &lower = (first ? other : one).body;
      warnings.push_back(
          fmt::format("body '{}' starts geostatic on body '{}', and their particles do not stand in the same columns: "
                      "the stress that '{}' starts under leaves out the weight of '{}', which settling alone finds; "
                      "give both faces across gravity that lie on the grid's lattice, or the same faces",
                      upper, lower, lower, upper));
    }
  }
}

/// Ratio of horizontal to vertical stress: as asked, or the material's own, raised to what it can carry.
double ratio_at_rest(const DeformableBody& body, const MaterialDefinition& material, const InitialStates& states,
                     double deepest, const std::function<Symmetric3<double>(double, double)>& stress) {
  if (body.geostatic->k0) return *body.geostatic->k0;
  const std::optional<double> own = pressure_at_rest(material.law);
  if (!own) {
    throw DefinitionError(
        fmt::format("body '{}': material '{}' ({}) cannot start geostatic; give it initial stress or "
                    "temperature",
                    body.name, material.name, law_name(material.law)));
  }
  double low = *own, high = 1.0;
  if (states.carries(stress(deepest, low)) || !(low < high)) return low;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (states.carries(stress(deepest, middle)) ? high : low) = middle;
  }
  return high;
}

}  // namespace

void add_geostatic_stress(SimulationDefinition& definition, Communicator* ranks, std::vector<std::string>& warnings) {
  if (const std::string reason = refused_geostatic(definition.geometry); !reason.empty()) {
    throw DefinitionError("a geostatic start is not possible: " + reason);
  }
  const int up = axis_of(definition.gravity);
  const double g = definition.gravity.norm(), down = definition.gravity[up] > 0.0 ? 1.0 : -1.0;
  const bool plane = planar(definition.geometry);
  ColumnFamilies families(definition, up);
  double gap = 0.0;
  std::vector<Part> parts;
  std::vector<Extent> extents;
  for (const DeformableBody& body : definition.bodies) {
    if (!body.geostatic) continue;
    const ParticleLattice lattice = families.lattice_of(body);
    const int family = families.family_of(lattice);
    const ParticleLattice& columns = families.lattice_of(family);
    const double area = lattice.spacing.prod() / lattice.spacing[up];
    const double weight = find_material(definition, body).density * body.particle_volume * g;
    gap = std::max(gap, kGap * lattice.spacing[up]);
    for (std::size_t p = 0; p < body.positions.size(); ++p) {
      const Vec3& place = body.positions[p];
      const double own = body.parts.empty() ? weight : body.parts[p] * weight;
      const Vec3 cells = (place - columns.origin).cwiseQuotient(columns.spacing);
      std::int64_t column = 0;
      for (int axis = 0; axis < 3; ++axis) {
        if (families.is_across(axis)) column = column * (std::int64_t{1} << 31) + std::llround(std::floor(cells[axis]));
      }
      parts.push_back({family, column, down * place[up], own, area, static_cast<std::uint32_t>(parts.size())});
    }
    extents.push_back(extent_of(body, family, ranks));
  }
  warn_of_other_columns(extents, families, up, down, gap, warnings);
  std::vector<double> own =
      ranks == nullptr ? vertical_stresses(std::move(parts), gap) : vertical_stresses(*ranks, parts, gap);
  std::vector<std::vector<double>> vertical(definition.bodies.size());
  auto next = own.begin();
  for (std::size_t b = 0; b < definition.bodies.size(); ++b) {
    const DeformableBody& body = definition.bodies[b];
    if (!body.geostatic) continue;
    const auto end = next + static_cast<std::ptrdiff_t>(body.positions.size());
    vertical[b].assign(next, end);
    next = end;
  }
  // Laws see effective stress: the weight less what the water carries.
  const QuantityDefinition* water = definition.transport.find(Transported::pore_pressure);
  agree<DefinitionError>(ranks, [&] {
    for (std::size_t b = 0; b < definition.bodies.size() && water != nullptr; ++b) {
      const DeformableBody& body = definition.bodies[b];
      const auto material = &find_material(definition, body) - definition.materials.data();
      const Symmetric3<double>& biot = water->materials[material].biot;
      const double part = up == 0 ? biot.xx : up == 1 ? biot.yy : biot.zz;
      for (std::size_t p = 0; p < vertical[b].size(); ++p) {
        const Vec3& place = body.positions[p];
        vertical[b][p] += part * initial_value(*water, body.name, place);
        if (!(vertical[b][p] > 0.0)) continue;
        throw DefinitionError(
            fmt::format("body '{}': at ({:.6g}, {:.6g}, {:.6g}) m the water in the pores carries more than the weight "
                        "above, by {:.4g} "
                        "Pa, so that the soil would be pulled apart; lower the water table to its surface, or load it",
                        body.name, place.x(), place.y(), place.z(), vertical[b][p]));
      }
    }
  });
  const auto stress = [up](double along, double ratio) {
    const double across = ratio * along;
    return Symmetric3<double>{up == 0 ? along : across, up == 1 ? along : across, up == 2 ? along : across, 0, 0, 0};
  };
  for (std::size_t b = 0; b < definition.bodies.size(); ++b) {
    DeformableBody& body = definition.bodies[b];
    if (!body.geostatic) continue;
    const MaterialDefinition& material = find_material(definition, body);
    const InitialStates states(material, definition.geometry);
    const double deepest = least_of(vertical[b], ranks);
    const double ratio = ratio_at_rest(body, material, states, deepest, stress);
    body.yy_follows = plane && states.yy_is_bound();
    body.stresses.clear();
    for (const double along : vertical[b]) body.stresses.push_back(stress(along, ratio));
  }
}

}  // namespace mpm
