#include "mpm/terrain/terrain.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mpm/math/constants.hpp"

namespace mpm {
namespace {

constexpr double kAtPoint = 1e-9;  // in cells of the map

}  // namespace

HeightPoints points_of(const HeightGrid& map, const Vec2& low, const Vec2& high) {
  const auto range = [&](int axis, int points, int& first, int& last) {
    const double per_cell = (points - 1) / (map.high[axis] - map.low[axis]);
    // A part that ends at a point does not need the next one, whatever the rounding.
    const double from = std::floor((low[axis] - map.low[axis]) * per_cell + kAtPoint);
    const double to = std::ceil((high[axis] - map.low[axis]) * per_cell - kAtPoint);
    first = static_cast<int>(std::clamp(from, 0.0, points - 1.0));
    last = static_cast<int>(std::clamp(to, 0.0, points - 1.0));
  };
  HeightPoints points;
  range(0, map.columns, points.left, points.right);
  if (map.rows > 1) range(1, map.rows, points.front, points.back);
  return points;
}

Vec2 place_of(const HeightGrid& map, int column, int row) {
  const double v = map.rows > 1 ? static_cast<double>(row) / (map.rows - 1) : 0.0;
  const Vec2 part(static_cast<double>(column) / (map.columns - 1), v);
  return map.low + (map.high - map.low).cwiseProduct(part);
}

Terrain::Terrain(HeightGrid map, const Vec2& low, const Vec2& high, double bottom)
    : map_(std::move(map)), low_(low), high_(high), bottom_(bottom), highest_(bottom), planar_(map_.rows == 1) {
  const Vec2 size = map_.high - map_.low;
  per_cell_ = {(map_.columns - 1) / size.x(), planar_ ? 0.0 : (map_.rows - 1) / size.y()};
  const HeightPoints points = points_of(map_, low_, high_);
  double sum = 0.0;
  for (int j = points.front; j <= points.back; ++j) {
    for (int i = points.left; i <= points.right; ++i) {
      const double height = map_.heights[static_cast<std::size_t>(j) * map_.columns + i];
      highest_ = std::max(highest_, height);
      sum += std::max(height - bottom_, 0.0);
    }
  }
  const double count = static_cast<double>(points.right - points.left + 1) * (points.back - points.front + 1);
  if (highest_ > bottom_) fullness_ = sum / count / (highest_ - bottom_);
}

double Terrain::height(double x, double y) const {
  const double u = (x - map_.low.x()) * per_cell_.x();
  const int i = std::clamp(static_cast<int>(u), 0, map_.columns - 2);
  const double along = u - i;
  const auto in_row = [&](int j) {
    const double* from = &map_.heights[static_cast<std::size_t>(j) * map_.columns + i];
    return from[0] + along * (from[1] - from[0]);
  };
  if (planar_) return in_row(0);
  const double v = (y - map_.low.y()) * per_cell_.y();
  const int j = std::clamp(static_cast<int>(v), 0, map_.rows - 2);
  const double before = in_row(j);
  return before + (v - j) * (in_row(j + 1) - before);
}

Box Terrain::bounds() const {
  Box box{{low_.x(), low_.y(), bottom_}, {high_.x(), high_.y(), highest_}};
  if (planar_) box.min.y() = -kInfinity, box.max.y() = kInfinity;
  return box;
}

}  // namespace mpm
