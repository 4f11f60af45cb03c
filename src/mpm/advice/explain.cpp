#include "mpm/advice/explain.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numeric>

#include "mpm/advice/feasible.hpp"
#include "mpm/rules/method_text.hpp"
#include "mpm/rules/transport_work.hpp"
#include "mpm/scene/scene_parts.hpp"
#include "mpm/shape/ring.hpp"

namespace mpm {
namespace {

std::string geometry_text(const SimulationDefinition& definition) {
  if (definition.geometry == GeometryKind::line) return fmt::format("line, {:g} m^2 across", definition.area);
  std::string text = spoken_name(definition.geometry);
  if (planar(definition.geometry)) text += fmt::format(", {:g} m thick", definition.thickness);
  return text;
}

std::string law_text(const ContactLaw& law) {
  switch (law.kind) {
    case ContactLaw::Kind::stick:
      return "sticks";
    case ContactLaw::Kind::coulomb:
      return law.friction.is_constant() ? fmt::format("friction {:g}", law.friction(0.0))
                                        : fmt::format("friction {}", law.friction.text());
    default:
      return "a law of its own";
  }
}

std::string mass_text(const RigidBodyDefinition& rigid) {
  if (!rigid.free) return "motion prescribed";
  static constexpr std::array<const char*, 6> kNames = {"x", "y", "z", "rx", "ry", "rz"};
  std::string axes;
  for (std::size_t k = 0; k < kNames.size(); ++k) {
    if (rigid.free->axes[k]) axes += fmt::format("{}{}", axes.empty() ? "" : ", ", kNames[k]);
  }
  return fmt::format("{:.4g} kg, free along {}", rigid.free->mass, axes);
}

/// Tells where it is at the start, how large and heavy, and how it may move: what a wrong unit changes.
std::string rigid_text(const RigidBodyDefinition& rigid, const SimulationDefinition& built) {
  std::string text = fmt::format("rigid body {}:", rigid.name);
  const Box bounds = world_bounds(rigid.pose, rigid.surface->bounds());
  for (const int axis : axes_of(built.geometry)) {
    const bool ends = std::isfinite(bounds.min[axis]) && std::isfinite(bounds.max[axis]);
    text += fmt::format(
        " {} {}", axis_name(axis),
        ends ? fmt::format("{:.4g} to {:.4g} m,", bounds.min[axis], bounds.max[axis]) : std::string("without an end,"));
  }
  const double across = planar(built.geometry) ? built.thickness : std::sqrt(built.area);
  const auto moments = rigid.surface->moments(across);
  if (moments && std::isfinite(moments->volume)) text += fmt::format(" {:.4g} m^3,", moments->volume);
  text += fmt::format(" {}, {}", mass_text(rigid),
                      rigid.friction.stick ? "sticks" : fmt::format("friction {:g}", rigid.friction.coefficient));
  for (const PairDefinition& pair : built.contact.pairs) {
    if (pair.second == rigid.name) text += fmt::format(", {}: {}", pair.first, law_text(pair.law));
  }
  return text + "\n";
}

void add_bodies(const Scene& scene, const SimulationDefinition& built, std::string& text) {
  double particles = 0.0;
  for (const DeformableBody& body : built.bodies) {
    for (const MaterialDefinition& material : built.materials) {
      if (material.name != body.material) continue;
      const auto count = static_cast<double>(body.positions.size());
      particles += count;
      double lengths = count;  // lengths of the rings; their number in other geometries
      const auto part = [&](std::size_t p) { return body.parts.empty() ? 1.0 : body.parts[p]; };
      if (!body.parts.empty()) lengths = std::accumulate(body.parts.begin(), body.parts.end(), 0.0);
      if (axisymmetric(built.geometry)) {
        const double half = 0.5 * (body.lattice ? body.lattice->spacing.x() : particle_spacing(scene, 0));
        const bool whole = built.method.axis.domains == AxisDomains::whole;
        lengths = 0.0;
        for (std::size_t p = 0; p < body.positions.size(); ++p)
          lengths += part(p) * ring_length(body.positions[p].x(), half, whole);
      }
      text += fmt::format("body {}: {:.0f} particles of {} ({}), {:.6g} kg{}\n", body.name, count, material.name,
                          law_name(material.law), lengths * body.particle_volume * material.density,
                          body.filling.empty() ? "" : ": " + body.filling);
    }
  }
  for (const RigidBodyDefinition& rigid : built.rigid_bodies) text += rigid_text(rigid, built);
  const double per_cell = std::pow(built.method.particles_per_direction, axes_of(scene).size());
  text += fmt::format("total: {:.0f} particles in {:.0f} cells\n", particles, particles / per_cell);
}

void add_steps(const Scene& scene, const SimulationDefinition& built, std::string& text) {
  const TimeDefinition& time = built.time;
  const WaveStep wave = wave_step(scene);
  const double sync = seconds_of(time.sync);
  double limit = wave.dt;
  std::string reason =
      fmt::format("the wave in {} ({:.5g} m/s) crosses {:g} of a cell", wave.material, wave.speed, time.cfl);
  if (time.step && *time.step < limit) {
    limit = *time.step;
    reason = "time.step";
  }
  if (sync < limit) {
    limit = sync;
    reason = "the sync period";
  }
  const double steps = std::ceil(sync / limit);
  text += fmt::format("time step: at most {:.4g} s, set by {}\n", limit, reason);
  std::vector<std::string> materials;
  for (const DeformableBody& body : built.bodies) materials.push_back(body.material);
  for (const TransportWork& transport : transport_work(built, materials)) {
    text += fmt::format("transport of {}: {:.3g} m^2/s at most{}, {:.0f} stage{} in each step\n", transport.quantity,
                        transport.diffusivity, transport.material.empty() ? "" : " in " + transport.material,
                        transport.stages, transport.stages == 1.0 ? "" : "s");
  }
  text += fmt::format("sync period: {:.9g} s, {:.0f} step{} each while the material is unstrained\n", sync, steps,
                      steps == 1.0 ? "" : "s");
  if (time.budget) {
    text +=
        fmt::format("budget: sweeps end after {:.4g} ms of wall time in a sync period, so runs depend on the clock\n",
                    1e3 * *time.budget);
  }
  if (time.end > 0.0) {
    text += fmt::format("run: to {:g} s in about {:.0f} steps\n", time.end, std::ceil(time.end / sync - 1e-9) * steps);
  } else {
    text += "run: until it is stopped\n";
  }
}

}  // namespace

std::string explain(const Scene& scene, const SimulationDefinition& built) {
  std::string text = fmt::format("scene {} ({})\n", built.name, scene.path);
  text += fmt::format("method: {}, {}\n", geometry_text(built), method_text(built.method));
  text += "grid:";
  for (const int axis : axes_of(scene)) {
    const GridDefinition& grid = built.grid;
    text += fmt::format(" {} {:g} to {:g} m by {:g} m{}", axis_name(axis), grid.min[axis], grid.max[axis],
                        grid.cell[axis], axis == axes_of(scene).back() ? "\n" : ",");
  }
  add_bodies(scene, built, text);
  add_steps(scene, built, text);
  text += fmt::format("output: every {:.9g} s\n", scene.output.period);
  if (!scene.choices.empty()) text += "chosen, because the scene does not specify them:\n";
  for (const auto& [key, reason] : scene.choices) text += fmt::format("  {}: {}\n", key, reason);
  return text;
}

}  // namespace mpm
