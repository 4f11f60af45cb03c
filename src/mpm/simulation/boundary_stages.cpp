// Conditions on the grid that are no walls, as stages of a run.
#include <fmt/core.h>

#include "mpm/boundary/periodic.hpp"
#include "state.hpp"

namespace mpm {
namespace {

/// The domain's faces along the grid's axes: visit(2 * grid axis, + 1 for the upper one; its place in kWallNames).
template <class Visit>
void each_face(const GridLayout& layout, Visit&& visit) {
  for (int face = 0; face < 2 * layout.dim(); ++face) visit(face, 2 * layout.axis(face / 2) + face % 2);
}

}  // namespace

void Simulation::State::add_absorbing() {
  each_face(layout(), [&](int face, int name) {
    const WallDefinition& wall = definition.walls[name];
    if (wall.kind != WallKind::absorbing) return;
    std::vector<ElasticWaves> waves;
    for (const DeformableBody& body : definition.bodies) {
      waves.push_back(elastic_waves(find_material(definition, body), definition.geometry));
    }
    const double phi = face_mass(definition.method.shape, definition.method.particles_per_direction);
    for (int f = 0; f < field_map.count(); ++f) {
      auto stage = std::make_unique<Absorbing>(face, kWallNames[name], sets, waves, phi, wall.hold);
      absorbing.push_back(&modules.add_in_field(std::move(stage), f));
    }
  });
}

void Simulation::State::check_periodic(const RigidBody& body) const {
  const std::string face = periodic_face_reached(body, layout());
  if (face.empty()) return;
  throw RigidError(
      fmt::format("rigid body '{}' comes to within a cell and a half of {}, which is periodic, and rigid bodies do not "
                  "go around; keep it away from there, make it endless along {}, or use walls",
                  body.name(), face, face[0]));
}

void Simulation::State::add_conditions() {
  if (definition.conditions.empty()) return;
  std::vector<HeldFace> slip;
  each_face(layout(), [&](int face, int name) {
    const WallKind kind = definition.walls[name].kind;
    if (kind == WallKind::slip || kind == WallKind::symmetry) slip.push_back({face, kWallNames[name]});
  });
  for (int f = 0; f < field_map.count(); ++f) {
    auto stage = std::make_unique<VelocityConditions>(definition.conditions, slip, layout());
    conditions.push_back(&modules.add_in_field(std::move(stage), f));
  }
}

}  // namespace mpm
