#include "study/lattice.hpp"

#include <cmath>

namespace mpm::study {

SimulationDefinition empty_definition(const std::string& name, GeometryKind geometry, const MethodDefinition& method,
                                      const Discretisation& discretisation, double cell, const Vec3& min,
                                      const Vec3& max, double sync, double end) {
  SimulationDefinition definition;
  definition.name = name;
  definition.geometry = geometry;
  definition.grid = {Vec3::Constant(cell), min, max};
  definition.time.end = end;
  definition.time.cfl = discretisation.cfl;
  if (discretisation.step > 0.0) definition.time.step = discretisation.step;
  definition.time.sync = nanoseconds_of(sync);
  definition.method = method;
  definition.method.particles_per_direction = discretisation.particles_per_direction;
  return definition;
}

void add_block(SimulationDefinition& definition, const MaterialDefinition& material, const Box& box,
               const Inside& inside, const std::function<Vec3(const Vec3&)>& velocity, const std::string& name) {
  const std::vector<int> axes = axes_of(definition.geometry);
  const double spacing = definition.grid.cell.x() / definition.method.particles_per_direction;
  std::array<long, 3> counts = {1, 1, 1};
  Vec3 first = Vec3::Zero();
  double volume = definition.geometry == GeometryKind::solid ? 1.0 : definition.thickness;
  for (const int axis : axes) {
    counts[axis] = std::lround((box.max[axis] - box.min[axis]) / spacing);
    first[axis] = box.min[axis] + 0.5 * spacing;
    volume *= spacing;
  }
  DeformableBody body;
  body.name = name;
  body.material = material.name;
  body.particle_volume = volume;
  for (long i = 0; i < counts[0]; ++i) {
    for (long j = 0; j < counts[1]; ++j) {
      for (long k = 0; k < counts[2]; ++k) {
        const Vec3 place = first + spacing * Vec3(i, j, k);
        if (inside && !inside(place)) continue;
        body.positions.push_back(place);
        if (velocity) body.velocities.push_back(velocity(place));
      }
    }
  }
  if (body.positions.empty()) throw StudyError("suite '" + definition.name + "': no particle lies in " + name);
  definition.bodies.push_back(std::move(body));
  if (definition.materials.empty()) definition.materials.push_back(material);
}

}  // namespace mpm::study
