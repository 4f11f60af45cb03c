#include "mpm/scene/scene_parts.hpp"

#include <algorithm>
#include <array>

namespace mpm {

const MaterialDefinition& material_of(const BodyDefinition& body, const Scene& scene) {
  const auto& materials = scene.definition.materials;
  return *std::find_if(materials.begin(), materials.end(),
                       [&](const MaterialDefinition& material) { return material.name == body.material; });
}

const char* axis_name(int axis) {
  static constexpr std::array<const char*, 3> kNames = {"x", "y", "z"};
  return kNames.at(static_cast<std::size_t>(axis));
}

std::vector<int> axes_of(const Scene& scene) { return axes_of(scene.definition.geometry); }

const char* scene_kind(GeometryKind geometry) {
  if (geometry == GeometryKind::line) return "a line";
  if (axisymmetric(geometry)) return "an axisymmetric scene";
  return planar(geometry) ? "a planar scene" : "a solid scene";
}

double particle_spacing(const Scene& scene, int axis) {
  return scene.definition.grid.cell[axis] / scene.definition.method.particles_per_direction;
}

}  // namespace mpm
