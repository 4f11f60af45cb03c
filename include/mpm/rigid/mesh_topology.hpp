// Checks and repairs by which a set of triangles becomes a solid: joined vertices, paired sides, outward orientation.
#pragma once

#include <cstddef>
#include <vector>

#include "mpm/rigid/surface.hpp"

namespace mpm {

/// Gives vertices of equal coordinates one index, in order of first appearance; vertices that no triangle uses are
/// left out. Formats such as STL repeat each vertex in every triangle.
/// @throws RigidError when empty, too large, not finite, or an index is out of range
TriangleMesh join_equal_vertices(const TriangleMesh& mesh);

/// Refuses more triangles than a body may have. @throws RigidError
void check_triangle_count(std::size_t triangles);

/// A mesh whose surface is closed. Side 3 t + e of triangle t leads from its corner e to the next one.
struct SolidMesh {
  TriangleMesh mesh;
  std::vector<int> mate;  ///< side along each side in the other direction
  std::vector<int> part;  ///< connected part of each triangle, from 0
  int parts = 0;
};

/// The mesh without triangles that repeat a vertex, turned outwards as a whole. Every side has another one along it in
/// the other direction. Where several parts meet at an edge, as bodies do that touch, sides are paired so that each
/// pair encloses material; parts then have vertices of their own.
/// @throws RigidError when empty, not finite, degenerate, open, not consistently oriented, or without volume
SolidMesh solid_mesh(const TriangleMesh& mesh);

/// Parts of a mesh that are one region together: chosen so that in each group no two bodies overlap or touch, and all
/// holes are with the body around them. The union of the groups is the solid. One group when there is one part, or all
/// are apart.
/// @throws RigidError for a body inside another one, a hole in none, holes that overlap, or too many parts
std::vector<SolidMesh> disjoint_groups(SolidMesh solid);

/// Enclosed volume [m^3]; negative for a closed mesh turned inside out.
double signed_volume(const TriangleMesh& mesh);

}  // namespace mpm
