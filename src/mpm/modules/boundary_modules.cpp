// Modules of boundary/: those at the faces of the domain and at the axis, and prescribed velocities.
#include <fmt/core.h>

#include "mpm/boundary/absorbing.hpp"
#include "mpm/boundary/axis.hpp"
#include "mpm/boundary/condition.hpp"
#include "mpm/boundary/leaving.hpp"
#include "mpm/boundary/periodic.hpp"
#include "mpm/boundary/wall.hpp"
#include "mpm/material/law.hpp"
#include "mpm/modules/shipped_modules.hpp"

namespace mpm {
namespace {

/// The domain's faces along the grid's axes: visit(2 * grid axis, + 1 for the upper one; its place in kWallNames).
template <class Visit>
void each_face(const GridLayout& layout, Visit&& visit) {
  for (int face = 0; face < 2 * layout.dim(); ++face) visit(face, 2 * layout.axis(face / 2) + face % 2);
}

}  // namespace

void add_periodic(RunParts& parts) {
  if (!parts.layout().any_periodic()) return;
  parts.modules.add(
      std::make_unique<PeriodicAxes>(parts.sets, parts.layout(), parts.definition.gravity, parts.threads));
}

void add_leaving(RunParts& parts) {
  const std::uint64_t limit = parts.definition.grid.leave_limit;
  if (limit > 0) parts.modules.add(std::make_unique<Leaving>(limit, parts.sets, parts.layout(), parts.ranks));
}

void add_axis(RunParts& parts) {
  const SimulationDefinition& definition = parts.definition;
  if (!axisymmetric(definition.geometry)) return;
  if (definition.method.update == UpdateScheme::implicit) return;  // implicit_module.cpp
  parts.add_in_fields([] { return std::make_unique<HoopForce>(); });
  const AxisRules& axis = definition.method.axis;
  if (definition.grid.min.x() == 0.0) {
    parts.add_in_fields([&] { return std::make_unique<Axis>(axis.ghosts); });
  }
  const bool to_zero = traits_of(definition.method.shape).massless_at_axis || axis.domains == AxisDomains::whole;
  if (axis.functions == AxisFunctions::weighted && to_zero) {
    parts.add_in_fields([&] { return std::make_unique<MasslessNodes>(definition.gravity); });
  }
}

void add_absorbing(RunParts& parts) {
  const SimulationDefinition& definition = parts.definition;
  each_face(parts.layout(), [&](int face, int name) {
    const WallDefinition& wall = definition.walls[name];
    if (wall.kind != WallKind::absorbing) return;
    std::vector<ElasticWaves> waves;
    for (const DeformableBody& body : definition.bodies) {
      const MaterialDefinition& material = find_material(definition, body);
      if (const LawTraits traits = traits_of(material); traits.stiffness_of_pressure && !traits.fluid()) {
        throw DefinitionError(fmt::format(
            "boundaries.{}: an absorbing face has the waves of the undeformed material, but those of '{}' ({}) "
            "follow its pressure; use fixed or slip farther away, or another law for the ground",
            kWallNames[name], material.name, law_name(material.law)));
      }
      waves.push_back(elastic_waves(material, definition.geometry));
    }
    const double phi = face_mass(definition.method.shape, definition.method.particles_per_direction);
    for (int field = 0; field < parts.map.count(); ++field) {
      ParticlesNearCracks near_cracks{parts.choice, {}};
      for (std::size_t s = 0; s < parts.sets.size(); ++s) {
        const int first = parts.sets[s].field, across = parts.map.across(static_cast<int>(s));
        near_cracks.gives_to.push_back(across > 0 && field >= first && field <= first + across ? 1 : 0);
      }
      parts.modules.add_in_field(std::make_unique<Absorbing>(face, kWallNames[name], parts.sets, waves, phi, wall.hold,
                                                             parts.ranks, std::move(near_cracks)),
                                 field);
    }
  });
}

void add_walls(RunParts& parts) {
  if (parts.definition.method.update == UpdateScheme::implicit) return;  // implicit_module.cpp
  each_face(parts.layout(), [&](int face, int name) {
    const WallDefinition& wall = parts.definition.walls[name];
    if (!is_wall(wall.kind)) return;
    parts.add_in_fields([&] {
      return std::make_unique<Wall>(face, wall, kWallNames[name], parts.definition.gravity, parts.threads, parts.heat);
    });
  });
}

void add_conditions(RunParts& parts) {
  const SimulationDefinition& definition = parts.definition;
  if (definition.conditions.empty()) return;
  std::vector<HeldFace> slip;
  each_face(parts.layout(), [&](int face, int name) {
    const WallKind kind = definition.walls[name].kind;
    if (kind == WallKind::slip || kind == WallKind::symmetry) slip.push_back({face, kWallNames[name]});
  });
  for (int field = 0; field < parts.map.count(); ++field) {
    auto conditions = std::make_unique<VelocityConditions>(definition.conditions, slip, parts.layout(), field);
    parts.rest_partners.push_back(&parts.modules.add_in_field(std::move(conditions), field));
  }
}

}  // namespace mpm
