// Test whether the straight way from a particle to a node crosses a crack, and where a straight way meets it. A crack's
// line is a list of points joined by straight segments; above it is the left side for one who walks along the list.
//
// Half-open rule: of a segment c-e, a way p-i crosses it if c and e lie on different sides of the line p-i and p and i
// on different sides of the line c-e, where a point exactly on a line counts as left of it. The side of a crack point
// is found once and serves both segments that share it, so that a way through a crack point meets the line once: it is
// neither lost nor counted twice. A second crossing takes back the first: what counts is whether their number is odd.
//
// Weak: which of two segments gets the meeting at a crack point they share, and whether a way exactly through an end of
// the line meets it, depends on the way's direction. A node exactly on a segment belongs to the side above, except for
// a particle exactly on the continuation of that segment. Around a closed path, a crack point exactly on a corner of
// the path, or a segment along one of its edges, may be met once too often or too seldom. Where a way crosses and also
// touches a corner of the crack exactly, the side and the segment may be those of the touch. Coordinates that are not
// exact in double precision put a node on the crack on one side or the other, the same for all particles; a way along a
// segment to round-off may then be decided wrongly.
//
// Source: crack reference 1.2, 2.5; J. A. Nairn (2003), CMES 4, 649-664, whose rule this is away from coincidences.
#pragma once

#include <vector>

#include "mpm/math/geometry.hpp"

namespace mpm {

/// Twice the signed area of the triangle p, q, r [m^2], positive if they lie counter-clockwise (x right, z up): if r is
/// left of the way from p to q. Exact for whole numbers below 2^25.
inline double double_area(const Vec2& p, const Vec2& q, const Vec2& r) {
  return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
}

/// Cracks that lie between a particle and a node. Unless `crosses`, the other members mean nothing.
struct Crossing {
  bool crosses = false;
  bool above = false;          ///< the particle is above and the node below, by the crossing nearest to the node
  Vec2 normal = Vec2::Zero();  ///< sum over all crossed segments, each as long as its segment, from above to below [m]
  int segment = -1;            ///< the crossed one nearest to the node; segment k begins at point k
};

/// The way from `particle` to `node` against the line of `points` points, at least two [m].
inline Crossing find_crossing(const Vec2* line, int points, const Vec2& particle, const Vec2& node) {
  Crossing found;
  double nearest = -1.0;
  bool left = double_area(particle, node, line[0]) >= 0.0;
  for (int k = 0; k + 1 < points; ++k) {
    const Vec2 &from = line[k], &to = line[k + 1];
    const bool was_left = left;
    left = double_area(particle, node, to) >= 0.0;
    if (left == was_left) continue;
    const double of_particle = double_area(from, to, particle), of_node = double_area(from, to, node);
    if ((of_particle < 0.0) == (of_node < 0.0)) continue;
    found.crosses = !found.crosses;
    found.normal += Vec2(to[1] - from[1], from[0] - to[0]);
    const double along = of_particle / (of_particle - of_node);
    if (along < nearest) continue;
    nearest = along;
    found.above = of_particle >= 0.0;
    found.segment = k;
  }
  return found;
}

/// Place where a straight way meets a line.
struct Meeting {
  double along = 0.0;          ///< part of the way that lies before it, from 0 to 1
  int segment = 0;             ///< segment k begins at point k
  double along_segment = 0.0;  ///< part of the segment that lies before it, from 0 to 1
};

/// Sets `found` to where the way from `a` to `b` meets the line of `points` points, at least two, in their order along
/// the way, and returns their number. The rule is that of find_crossing().
int find_meetings(const Vec2* line, int points, const Vec2& a, const Vec2& b, std::vector<Meeting>& found);

/// Part of the way from `a` to `b` at which it is nearest to a place, from 0 to 1.
double nearest_part(const Vec2& a, const Vec2& b, const Vec2& place);

/// Place where a way first comes near a line.
struct LineApproach {
  bool found = false;
  double along = 0.0;         ///< part of the way that lies before it, from 0 to 1
  Vec2 place = Vec2::Zero();  ///< on the line [m]
};

/// Finds where the way from `a` to `b` first meets the line of `points` points, at least two, or comes nearer to it
/// than `within` [m] while it nears it. A way that begins nearer than `met` [m] has met it there. find_meetings() alone
/// sees no line that the way runs along.
LineApproach find_approach(const Vec2* line, int points, const Vec2& a, const Vec2& b, double met, double within);

}  // namespace mpm
