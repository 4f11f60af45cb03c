// Points on the surface of a rigid body at which an implicit solver lets contact act, with the area of each.
//
// In a plane the section of the drawn surface at y = 0 is cut at its corners into chains, and each chain into equal
// parts with a point in the middle. About an axis it is the half section, and parts begin half a spacing from convex
// edges, so that the outermost points lie about a spacing from them: a rim makes twice the error of an edge, and this
// is what centres it (doc/implicit.md). In space flat faces get a regular grid along their longest border; of curved
// ones fine triangles are gathered in cubes about the points of a lattice through the body's origin, so that a body
// that is symmetric about its origin is sampled symmetrically as far as its triangles are. Points of curved faces are
// moved from the drawn surface to the exact one. What lies inside the body, as where parts of a compound overlap or
// behind what is drawn of an endless body, gives no point.
//
// Weak: cubes cut a curved face into pieces of unequal area, and two sheets of one curved face that are less than
// `spacing` apart are only told apart by the octants of their normals. Areas are those of the drawn surface, a little
// less than those of a round one. Where outer faces of two overlapping parts coincide, both give points. A face of a
// rough mesh that is smaller than the spacing gives a point of its own, and where rough faces are gathered the point
// may be a few hundredths of a spacing off the surface. A flat face is as wide as its bounding rectangle, so a narrow
// arm of a wide face is not taken for narrow. An edge less than about half a spacing from another part of the body is
// taken for none.
//
// Source: own derivation.
#pragma once

#include <vector>

#include "mpm/math/geometry.hpp"
#include "mpm/math/geometry_kind.hpp"
#include "mpm/rigid/surface.hpp"

namespace mpm {

/// A point at which contact with a rigid body acts.
struct SurfaceSample {
  Vec3 place = Vec3::Zero();    ///< in the body's frame [m]
  Vec3 normal = Vec3::UnitZ();  ///< outward unit normal, in the body's frame
  double area = 0.0;            ///< [m^2]; in a plane and in axisymmetry length in the x-z plane [m]
};

struct SampleRules {
  double spacing = 0.0;    ///< distance that points should have from each other, positive [m]
  double clearance = 0.0;  ///< least distance of a point from a convex edge, not negative [m]
};

/// Points on a body's surface, always in the same order. In a plane and in axisymmetry they lie at y = 0 (there with
/// x >= 0) and normals have no y component. With no clearance the areas sum to that of the drawn surface outside the
/// body. Points nearer than the clearance to an edge at which their face meets another one outwards, at more than 30
/// degrees, are left out and their area with them; but not along a direction in which the face is narrower than six
/// spacings (of a curved face: twice its area by the length of such edges). In axisymmetry any clearance stands for
/// half a spacing at such an edge before the first part, in a face of two spacings or more. Ends of what is drawn of an
/// endless body are no edges, nor is the axis in axisymmetry.
/// @throws RigidError in a line, or when the spacing is not positive and finite or the clearance negative or not finite
std::vector<SurfaceSample> sample_surface(const Surface& surface, GeometryKind geometry, const SampleRules& rules);

}  // namespace mpm
