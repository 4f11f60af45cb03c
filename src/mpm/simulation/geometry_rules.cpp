#include "mpm/simulation/geometry_rules.hpp"

#include <fmt/core.h>

#include "mpm/material/law.hpp"

namespace mpm {

std::string refused_material(GeometryKind geometry, const MaterialDefinition& material) {
  if (geometry != GeometryKind::plane_stress) return {};
  const bool flows = std::visit([](const auto& law) { return law.kForgetsShape; }, make_law(material));
  if (!flows) return {};
  return fmt::format(
      "material '{}' ({}) in plane stress: a sheet of fluid with free faces carries no pressure; use plane_strain or "
      "solid",
      material.name, law_name(material.law));
}

std::string refused_geostatic(GeometryKind geometry) {
  switch (geometry) {
    case GeometryKind::line:
      return "a line has no ground to both sides that would hold it at rest; use plane_strain or solid, or write "
             "stress";
    case GeometryKind::plane_stress:
      return "a plate with free faces cannot hold soil at rest; use plane_strain or solid";
    case GeometryKind::plane_strain:
    case GeometryKind::axisymmetric:
    case GeometryKind::solid:
      break;
  }
  return {};
}

}  // namespace mpm
