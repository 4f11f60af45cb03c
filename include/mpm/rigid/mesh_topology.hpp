// Checks and repairs by which a set of triangles becomes a solid: joined vertices, paired edges, outward orientation.
#pragma once

#include "mpm/rigid/surface.hpp"

namespace mpm {

/// Gives vertices of equal coordinates one index, in order of first appearance; vertices that no triangle uses are
/// left out. Formats such as STL repeat each vertex in every triangle.
/// @throws RigidError when empty, not finite, or an index is out of range
TriangleMesh join_equal_vertices(const TriangleMesh& mesh);

/// The mesh without triangles that repeat a vertex, turned outwards. Every directed edge must occur once and its
/// opposite once. Several closed parts are allowed: apart from each other, or as a cavity (turned inwards) in another.
/// Parts that pass through each other are not noticed if no sample point of one lies inside the other.
/// @throws RigidError when empty, not finite, degenerate, open, not consistently oriented, or with overlapping parts
TriangleMesh solid_mesh(const TriangleMesh& mesh);

/// Enclosed volume [m^3]; negative for a closed mesh turned inside out.
double signed_volume(const TriangleMesh& mesh);

}  // namespace mpm
