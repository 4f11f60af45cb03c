// From a scene to the definition of a run: fills bodies with particles (filling.hpp), gives them what they start with,
// and refuses scenes that cannot start. Over several ranks each walks over the places of all particles and keeps its
// own.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <new>
#include <optional>

#include "filling.hpp"
#include "ground_source.hpp"
#include "mpm/advice/feasible.hpp"
#include "mpm/advice/scene_warnings.hpp"
#include "mpm/bed/bed_columns.hpp"
#include "mpm/definition/layout.hpp"
#include "mpm/ranks/agree.hpp"
#include "mpm/ranks/of_all.hpp"
#include "mpm/ranks/own_part.hpp"
#include "mpm/scene/scene_parts.hpp"
#include "mpm/terrain/terrain.hpp"

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

/// Fills `values` with `at` of every particle's position. @throws SceneError when a function has no value there.
template <class T, class At>
void evaluate(const BodyDefinition& body, const DeformableBody& filled, const char* what, std::vector<T>& values,
              StopCheck& check_stop, At&& at) {
  values.reserve(filled.positions.size());
  try {
    for (const Vec3& point : filled.positions) {
      check_stop();
      values.push_back(at(point));
    }
  } catch (const FunctionError& error) {
    throw SceneError(fmt::format("{}: initial {} of body '{}': {}", body.initial_where, what, body.name, error.what()));
  }
}

void set_initial(const BodyDefinition& body, DeformableBody& filled, const std::function<bool()>& interrupt) {
  StopCheck check_stop(interrupt, "the bodies were given their initial state");
  bool at_rest = true;
  for (const Function& component : body.velocity) at_rest = at_rest && component.is_constant() && component(0.0) == 0.0;
  if (!at_rest) {
    const auto& v = body.velocity;
    evaluate(body, filled, "velocity", filled.velocities, check_stop,
             [&](const Vec3& x) { return Vec3(v[0](0.0, x), v[1](0.0, x), v[2](0.0, x)); });
  }
  if (body.stress) {
    const auto& s = *body.stress;
    evaluate(body, filled, "stress", filled.stresses, check_stop, [&](const Vec3& x) {
      return Symmetric3<double>{s[0](0.0, x), s[1](0.0, x), s[2](0.0, x), s[3](0.0, x), s[4](0.0, x), s[5](0.0, x)};
    });
  }
  if (body.temperature) {
    evaluate(body, filled, "temperature", filled.temperatures, check_stop,
             [&](const Vec3& x) { return (*body.temperature)(0.0, x); });
  }
  filled.yy_follows = body.yy_follows;
  filled.geostatic = body.geostatic;
}

/// A body's definition without particles.
DeformableBody without_particles(const BodyDefinition& body, const Filling& filling) {
  DeformableBody filled;
  filled.name = body.name;
  filled.material = body.material;
  filled.field = body.field;
  filled.particle_volume = filling.particle_volume();
  filled.lattice = filling.lattice();
  filled.filling = filling.text();
  return filled;
}

/// The body as ground that follows others: its particles as far as they are there at the start. `bed` gets its source.
DeformableBody fill_ground(const Scene& scene, std::size_t number, BedDefinition& bed) {
  const BodyDefinition& body = scene.bodies[number];
  const auto source = std::make_shared<SceneGround>(scene, number);
  bed.source = source;
  const GridLayout layout = layout_of(scene.definition);
  const BedColumns columns(layout);
  std::vector<Vec3> places;
  for (const RigidBodyDefinition& rigid : scene.definition.rigid_bodies) {
    if (std::find(bed.follow.begin(), bed.follow.end(), rigid.name) != bed.follow.end())
      places.push_back(rigid.pose.position);
  }
  const BedColumns::Flags there = columns_with_ground(columns, places, bed.within);
  GroundParticles ground;
  for (int column = 0; column < columns.count(); ++column) {
    if (there[column] != 0) add_column(columns, column, *source, ground);
  }
  if (ground.positions.empty()) {
    throw SceneError(
        fmt::format("{}: no particle of body '{}' lies within {:g} m of what it follows; move one of them, "
                    "or raise terrain.within",
                    body.where, body.name, bed.within));
  }
  DeformableBody filled = without_particles(body, source->filling());
  filled.positions = std::move(ground.positions);
  filled.parts = std::move(ground.parts);
  filled.surfaces = std::move(ground.surfaces);
  return filled;
}

/// A body's particles as its definition, all of them or a rank's own.
DeformableBody fill(const BodyDefinition& body, const Filling& filling, OwnPart* part, std::size_t number) {
  DeformableBody filled = without_particles(body, filling);
  const auto add = [&](const FilledPlace& place) {
    filled.positions.push_back(place.centre);
    if (!filling.cuts()) return;
    filled.parts.push_back(place.part);
    filled.surfaces.push_back(place.surface);
  };
  const auto make_room = [&](std::size_t particles) {
    filled.positions.reserve(particles);
    if (!filling.cuts()) return;
    filled.parts.reserve(particles);
    filled.surfaces.reserve(particles);
  };
  // Counted first, because a growing list needs up to three times its memory.
  if (part == nullptr) {
    make_room(filling.places());
    filling.each(add);
    filling.check_left(filled.positions.size());
    return filled;
  }
  filled.part.emplace();
  filled.part->whole = part->whole(number);
  filled.part->cut = filling.cuts();
  make_room(part->own(number));
  filled.part->numbers.reserve(part->own(number));
  std::uint32_t next = 0;
  filling.each([&](const FilledPlace& place) {
    const std::uint32_t own = next++;
    if (!part->keeps(place.centre)) return;
    add(place);
    filled.part->numbers.push_back(own);
  });
  return filled;
}

/// Numbers of the particles of `body` on which a load acts, on all ranks; empty without a region.
std::vector<std::uint32_t> choose(const LoadRegion& chosen, const DeformableBody& body, Communicator* ranks) {
  std::vector<std::uint32_t> particles;
  if (!chosen.region) return particles;
  for (std::size_t p = 0; p < body.positions.size(); ++p) {
    if (!chosen.region->contains(body.positions[p])) continue;
    particles.push_back(body.part ? body.part->numbers[p] : static_cast<std::uint32_t>(p));
  }
  particles = list_of_all(ranks, std::move(particles));
  std::sort(particles.begin(), particles.end());
  if (particles.empty()) {
    throw SceneError(fmt::format("{}: no particle of body '{}' has its centre in it; make it larger, or move it",
                                 chosen.where, body.name));
  }
  return particles;
}

/// Refuses tractions and fluxes inside a body, that is on chosen particles with a neighbour of their body beyond the
/// face. With jitter this is not checked, since positions then do not show which particles are neighbours.
void check_faces(int face, const LoadRegion& chosen, const DeformableBody& body, const Filling& filling) {
  for (const Vec3& at : body.positions) {
    if (!chosen.region || !chosen.region->contains(at)) continue;
    if (!filling.has_neighbour(at, face / 2, face % 2 == 1)) continue;
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

SimulationDefinition build(const Scene& scene, Communicator* ranks, const std::function<bool()>& interrupt) try {
  SimulationDefinition definition = scene.definition;
  definition.warnings = scene_warnings(scene);
  double half_spacing = std::numeric_limits<double>::infinity();
  for (const int axis : axes_of(scene)) half_spacing = std::min(half_spacing, 0.5 * particle_spacing(scene, axis));
  for (const BodyDefinition& body : scene.bodies) check_place(body, scene);
  check_particles(scene, ranks == nullptr ? 1.0 : static_cast<double>(ranks->on_this_machine()) / ranks->size());
  check_steps(scene);
  check_transport(scene);
  std::optional<OwnPart> part;
  if (ranks != nullptr) part.emplace(*ranks, layout_of(definition));
  std::vector<Filling> fillings;
  for (const BodyDefinition& body : scene.bodies) {
    const bool follows = definition.bed.has_value();
    if (!follows)
      fillings.emplace_back(body, scene, ranks == nullptr ? interrupt : nullptr);  // ranks stop together only
    FillingChecks checks(body, scene, half_spacing);
    if (part) {
      part->begin_body();
      fillings.back().each([&](const FilledPlace& place) {
        part->count(place.centre);
        checks.look(place.centre);
      });
      fillings.back().check_left(part->whole(fillings.size() - 1));
      checks.end();
      continue;
    }
    DeformableBody filled =
        follows ? fill_ground(scene, fillings.size(), *definition.bed) : fill(body, fillings.back(), nullptr, 0);
    for (const Vec3& point : filled.positions) checks.look(point);
    checks.end();
    set_initial(body, filled, interrupt);
    definition.bodies.push_back(std::move(filled));
  }
  if (part) {
    part->divide();
    agree<SceneError>(ranks, [&] {
      for (std::size_t b = 0; b < fillings.size(); ++b) {
        definition.bodies.push_back(fill(scene.bodies[b], fillings[b], &*part, b));
        set_initial(scene.bodies[b], definition.bodies.back(), nullptr);
      }
    });
  }
  const auto find_body = [&](const std::string& name) {
    const auto named = [&](const DeformableBody& body) { return body.name == name; };
    return std::find_if(definition.bodies.begin(), definition.bodies.end(), named) - definition.bodies.begin();
  };
  const auto choose_all = [&](auto& loads, const std::vector<LoadRegion>& regions) {
    for (std::size_t i = 0; i < regions.size(); ++i) {
      loads[i].particles = choose(regions[i], definition.bodies[find_body(loads[i].body)], ranks);
    }
  };
  choose_all(definition.particle_forces, scene.load_regions);
  choose_all(definition.tractions, scene.traction_regions);
  const auto check_all = [&](const auto& loads, const std::vector<LoadRegion>& regions) {
    agree<SceneError>(ranks, [&] {
      for (std::size_t i = 0; i < loads.size(); ++i) {
        const auto b = find_body(loads[i].body);
        if (scene.bodies[b].jitter > 0.0) continue;
        check_faces(loads[i].face, regions[i], definition.bodies[b], fillings[b]);
      }
    });
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
