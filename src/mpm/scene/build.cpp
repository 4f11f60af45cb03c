// Fills bodies with particles on the grid's lattice, and refuses scenes that cannot start.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <new>
#include <random>
#include <set>

#include "mpm/math/nearest.hpp"
#include "mpm/scene/feasible.hpp"
#include "mpm/scene/sections.hpp"
#include "mpm/scene/terrain.hpp"

namespace mpm {
namespace {

// Faces count as equal within this part of a cell, since 0.1 is not a binary number.
constexpr double kFaceSlack = 1e-6;

std::string span(const Box& box, const std::vector<int>& axes) {
  std::string text;
  for (const int axis : axes) {
    text +=
        fmt::format("{}{} {:.6g} to {:.6g}", text.empty() ? "" : ", ", axis_name(axis), box.min[axis], box.max[axis]);
  }
  return text + " m";
}

void check_place(const BodyDefinition& body, const Scene& scene) {
  const GridDefinition& grid = scene.definition.grid;
  const Box bounds = body.region.bounds();
  const std::vector<int> axes = axes_of(scene);
  for (const int axis : axes) {
    const double slack = kFaceSlack * grid.cell[axis];
    if (bounds.min[axis] < grid.min[axis] - slack || bounds.max[axis] > grid.max[axis] + slack) {
      throw SceneError(
          fmt::format("{}: body '{}' reaches out of the grid along {}: it spans {}, the grid {}; move it or "
                      "enlarge the grid",
                      body.where, body.name, axis_name(axis), span(bounds, axes), span({grid.min, grid.max}, axes)));
    }
    const double size = bounds.max[axis] - bounds.min[axis];
    if (size < grid.cell[axis] - slack) {
      throw SceneError(
          fmt::format("{}: body '{}' is smaller than a cell along {}: {:.6g} m in a cell of {:.6g} m; make "
                      "grid.cell at most half of that, or the body larger",
                      body.where, body.name, axis_name(axis), size, grid.cell[axis]));
    }
  }
}

/// Lattice positions along an axis whose centres can lie between `low` and `high`: centre i is at grid.min + (i + 1/2)
/// spacing.
struct Lattice {
  double origin;
  double spacing;
  std::int64_t first;
  std::int64_t last;
  double center(std::int64_t i) const { return origin + (static_cast<double>(i) + 0.5) * spacing; }
  double count() const { return static_cast<double>(std::max<std::int64_t>(0, last - first + 1)); }
};

Lattice lattice(const Scene& scene, const Box& bounds, int axis) {
  const GridDefinition& grid = scene.definition.grid;
  const double spacing = particle_spacing(scene, axis);
  const double all = std::round((grid.max[axis] - grid.min[axis]) / spacing);
  // One position more on either side; Region::contains() decides.
  const double first = std::floor((bounds.min[axis] - grid.min[axis]) / spacing) - 1.0;
  const double last = std::ceil((bounds.max[axis] - grid.min[axis]) / spacing) + 1.0;
  return {grid.min[axis], spacing, static_cast<std::int64_t>(std::max(0.0, first)),
          static_cast<std::int64_t>(std::min(all - 1.0, last))};
}

/// Moves each particle by a number of cells drawn evenly from [-jitter, jitter] along each axis, but not out of the
/// body. The draws are the same on every machine: the seed is fixed, and only the parts of the standard library are
/// used whose results are specified exactly.
void jitter(const BodyDefinition& body, const Scene& scene, std::vector<Vec3>& points) {
  constexpr int kMostDraws = 64;  // ample in a body of at least a cell; after that a particle stays in place
  std::mt19937_64 random;
  const std::vector<int> axes = axes_of(scene);
  for (Vec3& point : points) {
    for (int draw = 0; draw < kMostDraws; ++draw) {
      Vec3 moved = point;
      for (const int axis : axes) {
        const double unit = std::ldexp(static_cast<double>(random() >> 11), -52) - 1.0;  // [-1, 1)
        moved[axis] += unit * body.jitter * scene.definition.grid.cell[axis];
      }
      if (!body.region.contains(moved)) continue;
      point = moved;
      break;
    }
  }
}

DeformableBody fill(const BodyDefinition& body, const Scene& scene) {
  const Box bounds = body.region.bounds();
  const Lattice at_zero{0.0, 0.0, 0, 0};
  std::array<Lattice, 3> lattices = {at_zero, at_zero, at_zero};
  DeformableBody filled;
  filled.name = body.name;
  filled.material = body.material;
  filled.field = body.field;
  filled.particle_volume = 1.0;
  for (const int axis : axes_of(scene)) {
    lattices[axis] = lattice(scene, bounds, axis);
    filled.particle_volume *= lattices[axis].spacing;
  }
  filled.particle_volume *= scene.definition.across();
  // x runs fastest, as in the numbering of grid blocks.
  const auto each_place = [&body, &lattices](auto&& visit) {
    const Lattice &x = lattices[0], &y = lattices[1], &z = lattices[2];
    for (std::int64_t k = z.first; k <= z.last; ++k) {
      for (std::int64_t j = y.first; j <= y.last; ++j) {
        for (std::int64_t i = x.first; i <= x.last; ++i) {
          const Vec3 point(x.center(i), y.center(j), z.center(k));
          if (body.region.contains(point)) visit(point);
        }
      }
    }
  };
  // Positions are counted first, because a growing list needs up to three times its memory.
  std::size_t count = 0;
  each_place([&](const Vec3&) { ++count; });
  filled.positions.reserve(count);
  each_place([&](const Vec3& point) { filled.positions.push_back(point); });
  if (filled.positions.empty()) {
    throw SceneError(
        fmt::format("{}: body '{}' holds no particle; make it larger or grid.cell smaller", body.where, body.name));
  }
  if (body.jitter > 0.0) jitter(body, scene, filled.positions);
  return filled;
}

/// Fills `values` with `at` of every particle's position. @throws SceneError when a function has no value there.
template <class T, class At>
void evaluate(const BodyDefinition& body, const DeformableBody& filled, const char* what, std::vector<T>& values,
              At&& at) {
  values.reserve(filled.positions.size());
  try {
    for (const Vec3& point : filled.positions) values.push_back(at(point));
  } catch (const FunctionError& error) {
    throw SceneError(fmt::format("{}: initial {} of body '{}': {}", body.initial_where, what, body.name, error.what()));
  }
}

void set_initial(const BodyDefinition& body, DeformableBody& filled) {
  bool at_rest = true;
  for (const Function& component : body.velocity) at_rest = at_rest && component.is_constant() && component(0.0) == 0.0;
  if (!at_rest) {
    const auto& v = body.velocity;
    evaluate(body, filled, "velocity", filled.velocities,
             [&](const Vec3& x) { return Vec3(v[0](0.0, x), v[1](0.0, x), v[2](0.0, x)); });
  }
  if (body.stress) {
    const auto& s = *body.stress;
    evaluate(body, filled, "stress", filled.stresses, [&](const Vec3& x) {
      return Symmetric3<double>{s[0](0.0, x), s[1](0.0, x), s[2](0.0, x), s[3](0.0, x), s[4](0.0, x), s[5](0.0, x)};
    });
  }
  if (body.temperature) {
    evaluate(body, filled, "temperature", filled.temperatures,
             [&](const Vec3& x) { return (*body.temperature)(0.0, x); });
  }
  filled.yy_follows = body.yy_follows;
  filled.geostatic = body.geostatic;
}

/// Refuses overlapping bodies. Bodies share one lattice, so they overlap where both contain the same position.
void check_overlap(const BodyDefinition& first, const BodyDefinition& second, const DeformableBody& filled_second) {
  if (!first.region.bounds().intersects(second.region.bounds())) return;
  std::size_t count = 0;
  Vec3 place = Vec3::Zero();
  for (const Vec3& point : filled_second.positions) {
    if (!first.region.contains(point)) continue;
    if (count++ == 0) place = point;
  }
  if (count == 0) return;
  throw SceneError(
      fmt::format("{}: bodies '{}' and '{}' overlap: both hold {} of the same particles, one at ({:.6g}, {:.6g}, "
                  "{:.6g}) m; move one of them",
                  second.where, second.name, first.name, count, place.x(), place.y(), place.z()));
}

Box world_bounds(const RigidBodyDefinition& rigid) {
  const Box local = rigid.surface->bounds();
  Box world;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 point((corner & 1) != 0 ? local.max.x() : local.min.x(),
                     (corner & 2) != 0 ? local.max.y() : local.min.y(),
                     (corner & 4) != 0 ? local.max.z() : local.min.z());
    // Infinite extents become 1e9 m. When the body is turned, this rounds its other extents by less than a micrometre;
    // a body that is infinite along y only turns about y and is not affected.
    const Vec3 finite = point.unaryExpr([](double c) { return std::isfinite(c) ? c : std::copysign(1e9, c); });
    world.add(rigid.pose.to_world(finite));
  }
  return world;
}

void check_rigid(const BodyDefinition& body, const DeformableBody& filled, const RigidBodyDefinition& rigid,
                 double half_spacing) {
  const Box bounds = world_bounds(rigid);
  std::size_t count = 0;
  double deepest = 0.0;
  for (const Vec3& point : filled.positions) {
    SurfacePoint surface;
    if (!bounds.contains(point) || !rigid.surface->within(rigid.pose.to_body(point), -half_spacing, surface)) continue;
    ++count;
    deepest = std::max(deepest, -surface.distance);
  }
  if (count == 0) return;
  throw SceneError(
      fmt::format("{}: body '{}' overlaps rigid body '{}' at the start: {} particles lie inside it by more than "
                  "half their spacing, the deepest by {:.4g} m; move one of them, or leave them out by cut_out: [{}]",
                  body.where, body.name, rigid.name, count, deepest, rigid.name));
}

/// Removes the particles whose centres lie inside the rigid bodies named in cut_out.
void cut_out(const BodyDefinition& body, const Scene& scene, DeformableBody& filled) {
  std::vector<std::string> names;
  for (const RigidBodyDefinition& rigid : scene.definition.rigid_bodies) names.push_back(rigid.name);
  for (const std::string& name : body.cut_out) {
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    throw SceneError(fmt::format("{}: no rigid body '{}'; {}", body.cut_out_where, name,
                                 names.empty() ? "the scene has none" : suggest(name, names)));
  }
  std::vector<Vec3>& points = filled.positions;
  for (const RigidBodyDefinition& rigid : scene.definition.rigid_bodies) {
    const bool named = std::find(body.cut_out.begin(), body.cut_out.end(), rigid.name) != body.cut_out.end();
    if (!body.cut_out_all && !named) continue;
    const Box bounds = world_bounds(rigid);
    const auto inside = [&](const Vec3& point) {
      SurfacePoint surface;
      return bounds.contains(point) && rigid.surface->within(rigid.pose.to_body(point), 0.0, surface);
    };
    points.erase(std::remove_if(points.begin(), points.end(), inside), points.end());
  }
  if (points.empty()) {
    throw SceneError(
        fmt::format("{}: nothing is left of body '{}': all of it lies inside rigid bodies; move one of them",
                    body.cut_out_where, body.name));
  }
}

/// Numbers of the particles of `body` on which a load acts; empty without a region.
std::vector<std::uint32_t> choose(const LoadRegion& chosen, const DeformableBody& body) {
  std::vector<std::uint32_t> particles;
  if (!chosen.region) return particles;
  for (std::size_t p = 0; p < body.positions.size(); ++p) {
    if (chosen.region->contains(body.positions[p])) particles.push_back(static_cast<std::uint32_t>(p));
  }
  if (particles.empty()) {
    throw SceneError(fmt::format("{}: no particle of body '{}' has its centre in it; make it larger, or move it",
                                 chosen.where, body.name));
  }
  return particles;
}

/// Refuses tractions and fluxes inside a body, that is on chosen particles with a neighbour of their body beyond the
/// face. With jitter this is not checked, since positions then do not show which particles are neighbours.
void check_faces(int face, const std::vector<std::uint32_t>& particles, const LoadRegion& chosen,
                 const DeformableBody& body, const Scene& scene) {
  const auto cell_of = [&](const Vec3& point) {
    std::array<std::int64_t, 3> place{};
    for (const int axis : axes_of(scene)) {
      const double from_min = point[axis] - scene.definition.grid.min[axis];
      place[axis] = static_cast<std::int64_t>(std::floor(from_min / particle_spacing(scene, axis)));
    }
    return place;
  };
  std::set<std::array<std::int64_t, 3>> filled;
  for (const Vec3& point : body.positions) filled.insert(cell_of(point));
  for (const std::uint32_t p : particles) {
    std::array<std::int64_t, 3> beyond = cell_of(body.positions[p]);
    beyond[face / 2] += face % 2 == 1 ? 1 : -1;
    if (filled.count(beyond) == 0) continue;
    const Vec3& at = body.positions[p];
    throw SceneError(fmt::format(
        "{}: the edge {} of the particle at ({:.6g}, {:.6g}, {:.6g}) m is inside body '{}': another particle "
        "lies beyond it; let the region hold no more than the outermost particles, or leave it out",
        chosen.where, kWallNames.at(face), at.x(), at.y(), at.z(), body.name));
  }
}

}  // namespace

bool Region::contains(const Vec3& point) const {
  if (kind == Kind::terrain) return terrain->contains(point);
  if (about_axis && point.x() < 0.0) return false;
  if (kind == Kind::box) return (point.array() >= box.min.array()).all() && (point.array() < box.max.array()).all();
  Vec3 arm = point - center;
  if (kind == Kind::cylinder) {
    if (arm[axis] < -0.5 * height || arm[axis] >= 0.5 * height) return false;
    arm[axis] = 0.0;
  }
  return arm.squaredNorm() < radius * radius;
}

Box Region::bounds() const {
  if (kind == Kind::terrain) return terrain->bounds();
  if (kind == Kind::box) return box;
  Vec3 half = Vec3::Constant(radius);
  if (kind == Kind::cylinder) half[axis] = 0.5 * height;
  Box bounds{center - half, center + half};
  if (about_axis) bounds.min.x() = 0.0;
  return bounds;
}

SimulationDefinition build(const Scene& scene) try {
  SimulationDefinition definition = scene.definition;
  double half_spacing = std::numeric_limits<double>::infinity();
  for (const int axis : axes_of(scene)) half_spacing = std::min(half_spacing, 0.5 * particle_spacing(scene, axis));
  for (const BodyDefinition& body : scene.bodies) check_place(body, scene);
  check_particles(scene);
  check_steps(scene);
  for (const BodyDefinition& body : scene.bodies) {
    DeformableBody filled = fill(body, scene);
    cut_out(body, scene, filled);
    for (const BodyDefinition& other : scene.bodies) {
      if (&other == &body) break;
      check_overlap(other, body, filled);
    }
    for (const RigidBodyDefinition& rigid : definition.rigid_bodies) check_rigid(body, filled, rigid, half_spacing);
    set_initial(body, filled);
    definition.bodies.push_back(std::move(filled));
  }
  const auto choose_all = [&](auto& loads, const std::vector<LoadRegion>& regions) {
    for (std::size_t i = 0; i < regions.size(); ++i) {
      const auto body = std::find_if(definition.bodies.begin(), definition.bodies.end(),
                                     [&](const DeformableBody& b) { return b.name == loads[i].body; });
      loads[i].particles = choose(regions[i], *body);
    }
  };
  choose_all(definition.particle_forces, scene.load_regions);
  choose_all(definition.tractions, scene.traction_regions);
  const auto check_all = [&](const auto& loads, const std::vector<LoadRegion>& regions) {
    for (std::size_t i = 0; i < loads.size(); ++i) {
      const auto made = std::find_if(definition.bodies.begin(), definition.bodies.end(),
                                     [&](const DeformableBody& b) { return b.name == loads[i].body; });
      const BodyDefinition& body = scene.bodies[made - definition.bodies.begin()];
      if (body.jitter == 0.0) check_faces(loads[i].face, loads[i].particles, regions[i], *made, scene);
    }
  };
  check_all(definition.tractions, scene.traction_regions);
  for (QuantityDefinition& quantity : definition.transport.quantities) {
    const std::vector<LoadRegion>& regions = scene.flux_regions[static_cast<std::size_t>(quantity.quantity)];
    choose_all(quantity.fluxes, regions);
    check_all(quantity.fluxes, regions);
  }
  return definition;
} catch (const std::bad_alloc&) {
  throw SceneError(lack_of_memory(scene));
}

}  // namespace mpm
