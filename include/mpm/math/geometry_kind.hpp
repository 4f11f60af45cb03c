// The geometries that a scene can have: their names, and which world axes their grids have. How each treats the
// directions without an axis is stated by its type (math/dimension.hpp).
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace mpm {

enum class GeometryKind {
  line,          ///< along x; no strain along y and z
  plane_strain,  ///< x and z; no strain along y
  plane_stress,  ///< x and z; no stress along y
  axisymmetric,  ///< r = x >= 0 and z about the axis x = 0; a particle is a ring, y its hoop direction
  solid,         ///< all three axes
};

/// In the order of GeometryKind.
inline constexpr std::array<const char*, 5> kGeometryNames = {"line", "plane_strain", "plane_stress", "axisymmetric",
                                                              "solid"};
inline const char* geometry_name(GeometryKind kind) { return kGeometryNames[static_cast<int>(kind)]; }
/// The name as it stands in text for readers: "plane strain".
inline std::string spoken_name(GeometryKind kind) {
  std::string name = geometry_name(kind);
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

/// Axes of the grid: 1, 2 or 3.
constexpr int dimensions(GeometryKind kind) {
  return kind == GeometryKind::solid ? 3 : (kind == GeometryKind::line ? 1 : 2);
}
constexpr bool axisymmetric(GeometryKind kind) { return kind == GeometryKind::axisymmetric; }
/// True if the geometry has two axes, x and z, and a thickness along y.
constexpr bool planar(GeometryKind kind) { return dimensions(kind) == 2 && !axisymmetric(kind); }

/// The world axes of the grid's axes: x; x, z; or x, y, z.
inline std::vector<int> axes_of(GeometryKind kind) {
  if (kind == GeometryKind::line) return {0};
  return dimensions(kind) == 2 ? std::vector<int>{0, 2} : std::vector<int>{0, 1, 2};
}
/// The world axes that the grid lacks: y, z; y; or none.
inline std::vector<int> axes_beside(GeometryKind kind) {
  if (kind == GeometryKind::line) return {1, 2};
  return dimensions(kind) == 2 ? std::vector<int>{1} : std::vector<int>{};
}
/// True if bodies can turn about world axis `axis`: only about y in a plane, about none in a line or in axisymmetry.
constexpr bool turns_about(GeometryKind kind, int axis) {
  return kind == GeometryKind::solid || (planar(kind) && axis == 1);
}

}  // namespace mpm
