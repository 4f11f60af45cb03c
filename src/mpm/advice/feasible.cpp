#include "mpm/advice/feasible.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "mpm/advice/memory.hpp"
#include "mpm/grid/grid_layout.hpp"
#include "mpm/material/material_point.hpp"
#include "mpm/math/constants.hpp"
#include "mpm/rules/transport_work.hpp"
#include "mpm/scene/scene_parts.hpp"
#include "mpm/simulation/simulation.hpp"
#include "mpm/terrain/terrain.hpp"

namespace mpm {
namespace {

// Largest number of particles: they are numbered by signed 32-bit integers.
constexpr double kMostParticles = 2147483647.0;
constexpr double kGigabyte = 1e9;

/// Volume of a region relative to its bounds; in planar scenes, where a sphere is a disk, area; in a line length.
double fullness(const Region& region, GeometryKind geometry) {
  if (region.kind == Region::Kind::terrain) return region.terrain->fullness();
  if (region.kind == Region::Kind::box || geometry == GeometryKind::line) return 1.0;
  if (axisymmetric(geometry) && region.kind == Region::Kind::cylinder) return 1.0;
  return region.kind == Region::Kind::sphere && geometry == GeometryKind::solid ? kPi / 6.0 : kPi / 4.0;
}

/// Part of ground that follows bodies that is there at the start, at most.
double part_at_start(const Box& bounds, const SimulationDefinition& definition) {
  const BedDefinition& bed = *definition.bed;
  double part = 0.0;
  for (std::size_t follower = 0; follower < bed.follow.size(); ++follower) {
    double own = 1.0;
    for (const int axis : axes_of(definition.geometry)) {
      const double reach = bed.within + 2.0 * kBlockEdge * definition.grid.cell[axis];
      if (axis != 2) own *= std::min(1.0, 2.0 * reach / (bounds.max[axis] - bounds.min[axis]));
    }
    part += own;
  }
  return std::min(1.0, part);
}

/// Number of particles that a body will have, about.
double particles_of(const BodyDefinition& body, const Scene& scene) {
  const Box bounds = body.region.bounds();
  double places = fullness(body.region, scene.definition.geometry);
  if (scene.definition.bed) places *= part_at_start(bounds, scene.definition);
  for (const int axis : axes_of(scene)) places *= (bounds.max[axis] - bounds.min[axis]) / particle_spacing(scene, axis);
  return places;
}

/// Memory of a particle when the run is put together: its place in the definition is there beside it; where bodies
/// start geostatic, so are the stress there, and a second run that settles.
double least_bytes(const Scene& scene) {
  const double particle = least_bytes_of_particle(scene.definition.method, scene.definition.geometry);
  const bool settles = std::any_of(scene.bodies.begin(), scene.bodies.end(),
                                   [](const BodyDefinition& body) { return body.geostatic.has_value(); });
  const double defined = sizeof(Vec3) + (settles ? sizeof(Symmetric3<double>) : 0.0);
  return (settles ? 2.0 : 1.0) * (particle + defined);
}

}  // namespace

WaveStep wave_step(const Scene& scene) {
  const SimulationDefinition& definition = scene.definition;
  WaveStep step;
  if (definition.method.update == UpdateScheme::implicit) {  // resolves no waves
    step.dt = std::numeric_limits<double>::infinity();
    return step;
  }
  for (const MaterialDefinition& material : definition.materials) {
    const auto is_used = [&](const BodyDefinition& body) { return body.material == material.name; };
    if (std::none_of(scene.bodies.begin(), scene.bodies.end(), is_used)) continue;
    const double speed = MaterialPoint(material).wave_speed();
    if (speed <= step.speed) continue;
    step.speed = speed;
    step.material = material.name;
  }
  step.dt = definition.time.cfl * definition.smallest_cell() / step.speed;
  return step;
}

double expected_particles(const Scene& scene) {
  double total = 0.0;
  for (const BodyDefinition& body : scene.bodies) total += particles_of(body, scene);
  return total;
}

void check_particles(const Scene& scene, double part) {
  const double memory = usable_memory(), bytes = part * least_bytes(scene);
  double total = 0.0;
  for (const BodyDefinition& body : scene.bodies) {
    total += particles_of(body, scene);
    const std::string start =
        fmt::format("{}: with body '{}' there would be about {:.2g} particles", body.where, body.name, total);
    if (!(total <= kMostParticles)) {
      throw SceneError(fmt::format("{}, more than {:.0f}; make grid.cell larger", start, kMostParticles));
    }
    if (total * bytes > memory) {
      throw SceneError(
          fmt::format("{}, which need at least {:.3g} GB of memory; {:.3g} GB can be had here: make grid.cell larger",
                      start, total * bytes / kGigabyte, memory / kGigabyte));
    }
  }
}

void check_transport(const Scene& scene) {
  std::vector<std::string> materials;
  for (const BodyDefinition& body : scene.bodies) materials.push_back(body.material);
  try {
    transport_warning(scene.definition, materials);
  } catch (const DefinitionError& error) {
    throw SceneError(fmt::format("{}: {}", scene.path, error.what()));
  }
}

void check_steps(const Scene& scene) {
  const TimeDefinition& time = scene.definition.time;
  const WaveStep wave = wave_step(scene);
  const bool chosen = time.step && *time.step < wave.dt;
  const double dt = chosen ? *time.step : wave.dt, sync = seconds_of(time.sync);
  if (std::ceil(sync / dt) <= kMostSteps) return;
  const std::string steps =
      fmt::format("{:.3g} steps of {:.3g} s in each sync period of {:g} s; at most {:.0e} are taken",
                  std::ceil(sync / dt), dt, sync, kMostSteps);
  if (chosen) throw SceneError(fmt::format("{}: time.step: it means {}: make it longer", scene.path, steps));
  throw SceneError(
      fmt::format("{}: materials.{}: its wave of {:.4g} m/s crosses {:g} of a cell in {}: check its stiffness, its "
                  "density and their units, make grid.cell larger, or time.sync shorter",
                  scene.path, wave.material, wave.speed, time.cfl, steps));
}

std::string lack_of_memory(const Scene& scene) {
  double particles = 0.0;
  for (const BodyDefinition& body : scene.bodies) particles += particles_of(body, scene);
  return fmt::format(
      "{}: there is not enough memory for its {:.2g} particles, which need at least {:.3g} GB and more for outputs and "
      "grid; {:.3g} GB can be had here, shared with all that runs: use a larger grid.cell or a smaller scene",
      scene.path, particles, particles * least_bytes(scene) / kGigabyte, usable_memory() / kGigabyte);
}

}  // namespace mpm
