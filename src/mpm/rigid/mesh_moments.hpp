// Volume, centre and second moments of solids that meshes enclose.
#pragma once

#include <vector>

#include "mpm/rigid/solid_moments.hpp"
#include "signed_mesh.hpp"

namespace mpm {

/// Exact, for parts that do not overlap.
SolidMoments moments_of(const TriangleMesh& mesh);

/// Moments of the union of meshes: the sum of theirs, less what is counted twice. Where bodies overlap in a box along
/// the axes this is exact, else to about a thousandth of what overlaps.
SolidMoments moments_of_union(const std::vector<const SignedMesh*>& meshes);

}  // namespace mpm
