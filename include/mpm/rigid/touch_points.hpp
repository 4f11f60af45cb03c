// Points by which a rigid body touches other surfaces: balls that lie in it and reach its surface.
//
// A sphere is one ball, a capsule those along its axis. Any other body has its corners and points along its edges, of
// radius zero, where edges are those of the drawn surface whose faces make an angle outwards; so a cylinder has lines
// along its round face and points on its rims. Flat faces have none: what touches there touches with its own points.
//
// Weak: two edges that cross touch at the nearest point of one of them, up to half the spacing away; until then they
// overlap by at most as much. A cylinder touches flat ground with 48 lines around it, between which its centre sinks by
// 0.2 % of the radius as it rolls.
#pragma once

#include <vector>

#include "mpm/rigid/surface.hpp"

namespace mpm {

/// Points of a surface, in its frame, always in the same order. `in_plane`: of a planar scene, where they are the
/// corners of the section at y = 0. None for a body without end, such as a plane; of a height field those of its
/// ground.
std::vector<TouchPoint> touch_points(const Surface& surface, bool in_plane);

}  // namespace mpm
