// Ground with an uneven surface: what lies between a level and heights given at the points of a regular grid.
//
// Between the points the height is bilinear in x and y (in a planar scene linear in x). A rigid body that is a
// height_field has two triangles in each cell instead, which touch the bilinear surface along the cell's edges.
#pragma once

#include "mpm/rigid/surface.hpp"

namespace mpm {

/// Points of a map, from the first to the last in x and y.
struct HeightPoints {
  int left = 0, right = 0, front = 0, back = 0;
};
/// The points from which heights between `low` and `high` [m] follow.
HeightPoints points_of(const HeightGrid& map, const Vec2& low, const Vec2& high);
/// Place of a point in x and y [m].
Vec2 place_of(const HeightGrid& map, int column, int row);

class Terrain {
 public:
  /// `bottom`: level below which there is no ground [m]. `low` and `high`: the part of the map that counts [m], which
  /// lies within the map. Heights that points_of() this part does not name may be NaN.
  Terrain(HeightGrid map, const Vec2& low, const Vec2& high, double bottom);

  /// Height of the surface [m] above a place within the map.
  double height(double x, double y) const;
  /// True if a point lies below the surface, not below `bottom`, and within the part: half-open, as other regions.
  bool contains(const Vec3& point) const {
    return point.x() >= low_.x() && point.x() < high_.x() &&
           (planar_ || (point.y() >= low_.y() && point.y() < high_.y())) && point.z() >= bottom_ &&
           point.z() < highest_ && point.z() < height(point.x(), point.y());
  }
  /// Infinite along y in a planar scene.
  Box bounds() const;
  /// Part of the volume of bounds() that the ground fills, from the mean of the heights.
  double fullness() const { return fullness_; }

 private:
  HeightGrid map_;
  Vec2 low_, high_;
  double bottom_, highest_ = 0.0, fullness_ = 0.0;
  bool planar_;
  Vec2 per_cell_;  ///< cells of the map in a metre
};

}  // namespace mpm
