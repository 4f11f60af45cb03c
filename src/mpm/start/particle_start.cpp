#include "mpm/start/particle_start.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "mpm/boundary/periodic.hpp"
#include "mpm/definition/definition.hpp"
#include "mpm/math/dimension.hpp"
#include "mpm/particles/permute.hpp"
#include "mpm/ranks/agree.hpp"
#include "mpm/ranks/of_all.hpp"
#include "mpm/ranks/own_part.hpp"
#include "mpm/rules/geometry_rules.hpp"
#include "mpm/shape/ring.hpp"
#include "mpm/start/initial.hpp"

namespace mpm {
namespace {

std::uint32_t number_of(const DeformableBody& body, std::size_t p) {
  return body.part ? body.part->numbers[p] : static_cast<std::uint32_t>(p);
}

/// True of a body whose surface cuts places, on every rank, whether it has particles of the body or not.
bool is_cut(const DeformableBody& body) { return !body.parts.empty() || (body.part && body.part->cut); }

/// Over several ranks arrays get room for particles that come.
struct Size {
  std::size_t particles, room;

  Size(std::size_t count, bool shares) : particles(count), room(shares ? room_for_particles(count) : count) {}
  template <class Array>
  void give(Array& values) const {
    values.resize(particles, room);
  }
  std::vector<ParticleScalar> zeros(int components, Precision precision) const {
    std::vector<ParticleScalar> field;
    field.reserve(components);
    for (int c = 0; c < components; ++c) {
      field.emplace_back(precision);
      field.back().visit([this](auto& values) { give(values); });
      field.back().assign(particles, 0.0);
    }
    return field;
  }
};

/// Distance that a centre may be beyond a face [cells]. Pressed against a wall, a particle comes to rest only when its
/// box (`half` of it) is half beyond it; an absorbing face gives way by as much.
double beyond(WallKind kind, double half) {
  if (kind == WallKind::periodic) return kPeriodicReach;
  return kind == WallKind::none ? 0.0 : half;
}

/// Masses of rings, and where their functions end. `per_area`: density times the area of a section [kg/m].
void make_rings(const SimulationDefinition& definition, const DeformableBody& body, double per_area,
                const GridLayout& layout, const Size& size, ParticleSet& set) {
  constexpr double kOffAxis = 1e-6;  // part of a cell; on the axis itself v_r / r is no number
  const AxisRules& rules = definition.method.axis;
  set.whole_domains = rules.domains == AxisDomains::whole;
  set.planar_functions = rules.functions == AxisFunctions::planar;
  if (definition.grid.min.x() == 0.0) set.lowest[0] = kOffAxis;
  set.masses = size.zeros(1, set.precision);
  const double half = set.half[0] * layout.cell(0);
  for (int p = 0; p < set.size(); ++p) {
    const double part = body.parts.empty() ? 1.0 : body.parts[static_cast<std::size_t>(p)];
    set.masses[0].set(p, part * per_area * ring_length(set.x[0][p], half, set.whole_domains));
  }
}

/// One scalar of the particles of a set. `factor`: of the given values, each of which is 1 where none are given.
void fill_scalar(const std::vector<double>& values, double factor, const Size& size, Precision precision,
                 std::vector<ParticleScalar>& scalar) {
  scalar = size.zeros(1, precision);
  for (std::size_t p = 0; p < size.particles; ++p) scalar[0].set(p, values.empty() ? factor : factor * values[p]);
}

/// @throws DefinitionError
void check_parts(const DeformableBody& body, const std::string& start) {
  if (body.parts.empty() != body.surfaces.empty()) {
    throw DefinitionError(fmt::format("{}it has {} without {}; give both, or none", start,
                                      body.parts.empty() ? "surfaces" : "parts",
                                      body.parts.empty() ? "parts" : "surfaces"));
  }
  for (const auto* numbers : {&body.parts, &body.surfaces}) {
    if (numbers->empty()) continue;
    const bool parts = numbers == &body.parts;
    const char* what = parts ? "parts" : "surfaces";
    if (numbers->size() != body.positions.size()) {
      throw DefinitionError(
          fmt::format("{}{} {} for {} particles", start, numbers->size(), what, body.positions.size()));
    }
    for (std::size_t p = 0; p < numbers->size(); ++p) {
      const double value = (*numbers)[p];
      if (value > 0.0 && std::isfinite(value) && (parts || value <= kMostSurface)) continue;
      throw DefinitionError(fmt::format("{}particle {}: {} {} must be positive{}", start, number_of(body, p), what,
                                        value, parts ? "" : fmt::format(", and {:g} at most", kMostSurface)));
    }
  }
}

ParticleSet place_particles(const SimulationDefinition& definition, const DeformableBody& body,
                            const MaterialDefinition& material, const Law& law, const GridLayout& layout, bool shares,
                            StopCheck& check_stop) {
  const std::size_t n = body.positions.size();
  const Size size(n, shares);
  const std::string start = fmt::format("body '{}': ", body.name);
  if (whole_of(body) == 0) throw DefinitionError(start + "it has no particle");
  if (const std::string reason = refused_material(definition.geometry, material); !reason.empty()) {
    throw DefinitionError(start + reason);
  }
  if (!body.velocities.empty() && body.velocities.size() != n) {
    throw DefinitionError(fmt::format("{}{} velocities for {} particles", start, body.velocities.size(), n));
  }
  if (!(body.particle_volume > 0.0) || !std::isfinite(body.particle_volume)) {
    throw DefinitionError(fmt::format("{}particle volume {} must be positive", start, body.particle_volume));
  }
  check_parts(body, start);
  ParticleSet set;
  set.name = body.name;
  const int dim = layout.dim();
  for (int k = 0; k < dim; ++k) {
    const int face = 2 * layout.axis(k);
    set.half[k] = 0.5 / definition.method.particles_per_direction;
    // To round-off a lattice may be wider than a cell; domains may not.
    if (body.lattice) set.half[k] = std::min(0.5, 0.5 * body.lattice->spacing[layout.axis(k)] / layout.cell(k));
    set.lowest[k] = -beyond(definition.walls[face].kind, set.half[k]);
    set.highest[k] = layout.last_node(k) + beyond(definition.walls[face + 1].kind, set.half[k]);
  }
  size.give(set.id);
  set.precision = definition.method.precision;
  set.x.resize(dim);
  for (PaddedArray<double>& x : set.x) size.give(x);
  set.v = size.zeros(dim, set.precision);
  for (std::size_t p = 0; p < n; ++p) {
    check_stop();
    for (int k = 0; k < dim; ++k) {
      const int axis = layout.axis(k);
      set.x[k][p] = body.positions[p][axis];
      set.v[k].set(p, body.velocities.empty() ? 0.0 : body.velocities[p][axis]);
      const double cells = layout.in_cells(k, set.x[k][p]);
      if (!(cells >= 0.0 && cells <= layout.last_node(k)) || !std::isfinite(set.v[k][p])) {
        throw DefinitionError(fmt::format("{}particle {} is outside the grid or not finite: {} = {} m, velocity {} m/s",
                                          start, number_of(body, p), "xyz"[axis], set.x[k][p], set.v[k][p]));
      }
    }
  }
  with_geometry(definition.geometry, [&](auto geometry) {
    set.f = size.zeros(geometry.kMatrix, set.precision);
    set.tau = size.zeros(geometry.kSymmetric, set.precision);
  });
  set.history = size.zeros(history_size(law), set.precision);
  if (axisymmetric(definition.geometry)) {
    make_rings(definition, body, material.density * body.particle_volume, layout, size, set);
  } else {
    set.mass = material.density * body.particle_volume;
    if (is_cut(body)) fill_scalar(body.parts, set.mass, size, set.precision, set.masses);
  }
  if (is_cut(body)) fill_scalar(body.surfaces, 1.0, size, set.precision, set.surface);
  if (strains_after_motion(definition.method.update)) {
    set.next_x.resize(dim);
    for (PaddedArray<double>& x : set.next_x) size.give(x);
    for (int k = 0; k < dim; ++k) std::copy(set.x[k].begin(), set.x[k].end(), set.next_x[k].begin());
  }
  return set;
}

/// Leaves, of a body whose particles are all here, those that this rank keeps.
template <class T>
void leave(std::vector<T>& values, const std::vector<std::uint32_t>& kept) {
  if (values.empty()) return;
  std::vector<T> own;
  own.reserve(kept.size());
  for (const std::uint32_t p : kept) own.push_back(values.at(p));
  values = std::move(own);
}

}  // namespace

std::uint64_t whole_of(const DeformableBody& body) { return body.part ? body.part->whole : body.positions.size(); }

void leave_own(SimulationDefinition& definition, const Communicator& ranks, const GridLayout& layout) {
  OwnPart part(ranks, layout);
  for (const DeformableBody& body : definition.bodies) {
    if (body.part) return;  // built for ranks
    part.begin_body();
    for (const Vec3& place : body.positions) part.count(place);
  }
  part.divide();
  for (DeformableBody& body : definition.bodies) {
    BodyPart own;
    own.whole = body.positions.size();
    own.cut = !body.parts.empty();
    for (std::uint32_t p = 0; p < own.whole; ++p) {
      if (part.keeps(body.positions[p])) own.numbers.push_back(p);
    }
    leave(body.positions, own.numbers);
    leave(body.velocities, own.numbers);
    leave(body.stresses, own.numbers);
    leave(body.temperatures, own.numbers);
    leave(body.parts, own.numbers);
    leave(body.surfaces, own.numbers);
    body.part = std::move(own);
  }
}

ParticleSet make_set(const SimulationDefinition& definition, const DeformableBody& body,
                     const MaterialDefinition& material, const Law& law, const GridLayout& layout, std::uint32_t first,
                     Communicator* ranks, std::vector<std::string>& warnings, StopCheck& check_stop) {
  ParticleSet set;
  agree<DefinitionError>(
      ranks, [&] { set = place_particles(definition, body, material, law, layout, ranks != nullptr, check_stop); });
  start_particles(set, body, material, definition.geometry, ranks, warnings, check_stop);
  set.first_id = first;
  for (std::size_t p = 0; p < set.id.size(); ++p) set.id[p] = first + number_of(body, p);
  return set;
}

double total_mass(const ParticleSet& set, const DeformableBody& body, Communicator* ranks) {
  if (ranks == nullptr) return set.total_mass();
  return set.masses.empty() ? set.mass * static_cast<double>(whole_of(body)) : ranks->sum(set.total_mass());
}

double least_mass(const std::vector<ParticleSet>& sets, Communicator* ranks, bool whole) {
  double least = std::numeric_limits<double>::infinity();
  for (const ParticleSet& set : sets) {
    if (set.size() > 0) least = std::min(least, whole ? set.least_whole_mass() : set.least_mass());
  }
  return least_of_all(ranks, least);
}

// Not "= {}", which would keep the memory.
void forget_particles(DeformableBody& body) {
  body.positions = std::vector<Vec3>();
  body.velocities = std::vector<Vec3>();
  body.stresses = std::vector<Symmetric3<double>>();
  body.temperatures = std::vector<double>();
  body.parts = std::vector<double>();
  body.surfaces = std::vector<double>();
  if (body.part) body.part->numbers = std::vector<std::uint32_t>();
}

}  // namespace mpm
