#include "mpm/rules/geometry_rules.hpp"

#include <fmt/core.h>

#include <cmath>

#include "mpm/material/law.hpp"
#include "mpm/math/constants.hpp"

namespace mpm {
namespace {

constexpr double kNotable = 1.0 * kDegree;  ///< a difference of friction angles

const char* const kOtherMatch = "leave match out, or write mohr_coulomb or plane_strain";

}  // namespace

std::string refused_material(GeometryKind geometry, const MaterialDefinition& material) {
  if (geometry == GeometryKind::plane_strain && friction_in_plane_strain(material.law).value_or(0.0) >= 1.0) {
    return fmt::format(
        "material '{}' (drucker_prager) in plane strain: with this match and {:g} degrees of friction it has no limit: "
        "whatever presses on it, it does not flow; {}",
        material.name, *friction_angle(material.law) / kDegree, kOtherMatch);
  }
  if (geometry != GeometryKind::plane_stress) return {};
  if (!traits_of(material).forgets_shape) return {};
  return fmt::format(
      "material '{}' ({}) in plane stress: a sheet of fluid with free faces carries no pressure; use plane_strain or "
      "solid",
      material.name, law_name(material.law));
}

std::string material_warning(GeometryKind geometry, const MaterialDefinition& material) {
  const std::optional<double> sine = friction_in_plane_strain(material.law);
  if (!sine) return {};
  const double asked = *friction_angle(material.law);
  if (geometry == GeometryKind::solid && *sine >= 1.0) {
    return fmt::format(
        "material '{}': with this match and {:g} degrees of friction it has no limit where it moves in a plane, as "
        "before a wide blade: it does not flow there; {}",
        material.name, asked / kDegree, kOtherMatch);
  }
  if (geometry != GeometryKind::plane_strain || *sine >= 1.0 || std::abs(std::asin(*sine) - asked) < kNotable) {
    return {};
  }
  return fmt::format(
      "material '{}': with this match it acts in plane strain as one of {:.1f} degrees of friction, not "
      "{:g}; for {:g}, {}",
      material.name, std::asin(*sine) / kDegree, asked / kDegree, asked / kDegree, kOtherMatch);
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

std::optional<AxisFault> axis_fault(const SimulationDefinition& definition) {
  if (!axisymmetric(definition.geometry)) return {};
  const double inner = definition.grid.min.x(), cell = definition.grid.cell.x();
  if (inner < 0.0) {
    return AxisFault{"grid", fmt::format("min: r = {:g} m is beyond the axis; an axisymmetric grid begins at r = 0, or "
                                         "outside it",
                                         inner)};
  }
  // A domain reaches half a cell at most, and its functions' nodes a cell more.
  if (inner > 0.0 && inner < 2.0 * cell) {
    return AxisFault{"grid", fmt::format("min: the grid begins at r = {:g} m, {:.3g} cells from the axis, and has no "
                                         "nodes on it: write r = 0, or keep two cells away",
                                         inner, inner / cell)};
  }
  if (inner == 0.0 && definition.walls[0].kind != WallKind::none) {
    return AxisFault{"boundaries", "x_min is the axis, where nothing moves along r of itself; leave it out"};
  }
  if (definition.gravity.x() != 0.0) {
    return AxisFault{"gravity",
                     fmt::format("{:g} m/s^2 along r; an axisymmetric scene has gravity along z alone: write "
                                 "[0, {:g}]",
                                 definition.gravity.x(), definition.gravity.z())};
  }
  for (const DeformableBody& body : definition.bodies) {
    for (const Vec3& place : body.positions) {
      if (place.x() >= 0.0) continue;
      return AxisFault{"bodies", fmt::format("body '{}' has material at r = {:g} m; about an axis r is 0 or more",
                                             body.name, place.x())};
    }
  }
  return {};
}

}  // namespace mpm
