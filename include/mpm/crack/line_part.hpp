// Part of a crack's line near a place: a few of its segments in place of all.
#pragma once

#include "mpm/crack/chain.hpp"
#include "mpm/math/geometry.hpp"

namespace mpm {

/// Segments of a line: from the first point on, so many points; none: fewer than two.
struct LinePart {
  int first = 0, points = 0;
  Vec2 low = Vec2::Zero(), high = Vec2::Zero();  ///< bounds [m]
  bool misses(const Vec2& other_low, const Vec2& other_high) const {
    return points < 2 || (low.array() > other_high.array()).any() || (high.array() < other_low.array()).any();
  }
};

/// The whole line of a chain.
inline LinePart whole_line(const Chain& chain) { return {0, static_cast<int>(chain.line().size()), {}, {}}; }
/// The fewest consecutive segments that hold all of `within` whose bounds meet those of a box [m].
LinePart part_between(const Chain& chain, const LinePart& within, const Vec2& low, const Vec2& high);

}  // namespace mpm
