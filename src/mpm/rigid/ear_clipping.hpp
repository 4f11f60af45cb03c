// A polygon cut into triangles, to be drawn: ears are cut off one by one, a corner whose triangle holds no other corner
// (G. H. Meisters (1975): Polygons have ears. American Mathematical Monthly 82(6), 648-651).
//
// Weak: its time grows with the cube of the number of corners at worst, and the triangles may be slender.
#pragma once

#include <array>
#include <vector>

#include "mpm/rigid/surface.hpp"

namespace mpm {

/// Triangles, counter-clockwise, that fill a counter-clockwise polygon which does not cut itself.
std::vector<std::array<Vec2, 3>> cut_into_triangles(const Profile& profile);

}  // namespace mpm
