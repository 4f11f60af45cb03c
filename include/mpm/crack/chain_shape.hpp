// Points of a crack's chain from corners and arcs, and what is wrong with a chain of points. Points lie in the plane of
// the grid's axes [m].
//
// Weak: a chain that touches itself is found exactly, one that nearly does is not.
// Source: crack reference 1.1; NairnMPM's manual, Cracks.
#pragma once

#include <string>
#include <vector>

#include "mpm/math/geometry.hpp"

namespace mpm {

/// The corners with points between them that divide each edge into equal segments, the fewest that are not longer than
/// `segment` [m], which is positive. A corner in the place of the one before is dropped.
std::vector<Vec2> subdivided(const std::vector<Vec2>& corners, double segment);

/// Points on a circle at equal angles from `from` to `to` [rad, counter-clockwise from the first axis], whichever is
/// larger, not farther apart than `segment` [m]. `radius` and `segment` are positive [m].
std::vector<Vec2> arc_points(const Vec2& centre, double radius, double from, double to, double segment);

/// One chain of several, in their order. A part that begins where the one before ends adds that point once; from one
/// that begins elsewhere a straight segment leads there.
std::vector<Vec2> joined(const std::vector<std::vector<Vec2>>& parts);

/// Fault of a chain and what to do, or an empty text: fewer than two points, a point that is no place, a
/// segment of no length or longer than two cells, a chain that crosses or touches itself. It may end where it starts.
/// `cell`: the smallest edge of a cell [m].
std::string line_fault(const std::vector<Vec2>& points, double cell);

/// True if a chain lies along another one: two of its points in sequence nearer to it than a twentieth of `cell` [m].
/// Cracks may cross and touch; where one lies on another, nothing is between them that their fields could hold.
bool lies_along(const std::vector<Vec2>& points, const std::vector<Vec2>& other, double cell);

}  // namespace mpm
