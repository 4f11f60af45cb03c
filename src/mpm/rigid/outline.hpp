// A closed polygon as a signed distance in its plane: the outline of a body of revolution or of a planar one.
//
// The side of a point follows from the normal at the nearest point, at a corner from the sum of its edges' normals
// (Baerentzen & Aanaes 2005). In a body of revolution an edge on the axis is not part of the surface, and a corner on
// the axis has its mirror image's edge beside its own.
//
// Weak: every edge is looked at, so an outline of hundreds of points is slow; curves are as smooth as their points.
#pragma once

#include <utility>
#include <vector>

#include "mpm/rigid/surface.hpp"

namespace mpm {

/// An edge, the body on its left.
struct OutlineEdge {
  Vec2 from, to;
  Vec2 normal;                  ///< outward
  Vec2 from_normal, to_normal;  ///< normals of its corners: sum of their edges' normals, unit
  double length;
};

/// @throws RigidError that begins with `shape` and names the point: fewer than 3, not finite, repeated, turning back,
/// or the outline cuts itself; about an axis: r < 0, or a point alone on the axis.
void check_outline(const Profile& profile, const char* shape, bool about_axis);

/// Twice the signed area; positive when counter-clockwise, the first axis to the right and the second up.
double twice_area(const Profile& profile);

class Outline {
 public:
  /// Makes the outline of a profile that check_outline() has passed, in either sense.
  Outline(Profile profile, bool about_axis);

  const std::vector<OutlineEdge>& edges() const { return edges_; }  ///< edges on the axis left out
  const Profile& profile() const { return profile_; }               ///< counter-clockwise
  const Vec2& low() const { return low_; }
  const Vec2& high() const { return high_; }
  /// Signed distance, and its gradient.
  std::pair<double, Vec2> nearest(const Vec2& point) const;

 private:
  Profile profile_;
  std::vector<OutlineEdge> edges_;
  Vec2 low_, high_;
};

}  // namespace mpm
