// Heights over a rectangle in x and y: triangles, and all that lies below them.
//
// Cells are looked at from the point's own outwards, ring by ring, until none of those left can be nearer. Whether a
// point is inside follows from the height above or below it, not from normals.
//
// Weak: a point far from the surface, in measures of a cell, has many rings to look at. Contact asks near the surface.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "height_profile.hpp"
#include "mpm/math/constants.hpp"
#include "mpm/rigid/surface.hpp"
#include "triangle.hpp"

namespace mpm {

namespace {

/// The nearest point of the surface, and what it is on.
struct Found {
  double squared = kInfinity;
  Vec3 point = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();  ///< outward, of the face
  bool inner = true;            ///< not an edge or corner of the face
};

class HeightField final : public Surface {
 public:
  explicit HeightField(HeightGrid grid)
      : grid_(std::move(grid)),
        cells_x_(grid_.columns - 1),
        cells_y_(grid_.rows - 1),
        step_((grid_.high.x() - grid_.low.x()) / cells_x_, (grid_.high.y() - grid_.low.y()) / cells_y_),
        lowest_(*std::min_element(grid_.heights.begin(), grid_.heights.end())),
        highest_(*std::max_element(grid_.heights.begin(), grid_.heights.end())) {}

  SurfacePoint at(const Vec3& point) const override {
    const Found found = find_nearest(point);
    const Vec3 away = point - found.point;
    SurfacePoint result;
    if (found.inner) {
      result.normal = found.normal;
      result.distance = away.dot(found.normal);
      return result;
    }
    const bool inside = over(point, 0) && over(point, 1) && point.z() < height(point);
    result.distance = (inside ? -1.0 : 1.0) * away.norm();
    const bool touching = std::abs(result.distance) <= kTouching * step_.minCoeff();
    result.normal = touching ? found.normal : Vec3(away / result.distance);
    return result;
  }

  bool within(const Vec3& point, double band, SurfacePoint& result) const override {
    if (point.z() - highest_ > band) return false;
    for (int k = 0; k < 2; ++k) {
      if (grid_.low[k] - point[k] > band || point[k] - grid_.high[k] > band) return false;
    }
    const SurfacePoint found = at(point);
    if (found.distance > band) return false;
    result = found;
    return true;
  }

  Box bounds() const override {
    return {{grid_.low.x(), grid_.low.y(), -kInfinity}, {grid_.high.x(), grid_.high.y(), highest_}};
  }

  double thickness() const override { return (grid_.high - grid_.low).minCoeff(); }

  std::vector<std::array<Vec3, 3>> triangles() const override {
    std::vector<std::array<Vec3, 3>> result;
    for (int j = 0; j < cells_y_; ++j) {
      for (int i = 0; i < cells_x_; ++i) {
        result.push_back({corner(i, j), corner(i + 1, j), corner(i + 1, j + 1)});
        result.push_back({corner(i, j), corner(i + 1, j + 1), corner(i, j + 1)});
      }
    }
    // Drawn half as deep below its lowest place as it is wide: sides, and a bottom about its middle.
    const double bottom = lowest_ - 0.5 * (grid_.high - grid_.low).maxCoeff();
    const auto below = [&](const Vec3& p) { return Vec3(p.x(), p.y(), bottom); };
    const Vec3 middle = below({0.5 * (grid_.low.x() + grid_.high.x()), 0.5 * (grid_.low.y() + grid_.high.y()), 0.0});
    const auto side = [&](const Vec3& from, const Vec3& to) {  // the body on its left, seen from above
      result.push_back({below(from), below(to), to});
      result.push_back({below(from), to, from});
      result.push_back({below(to), below(from), middle});
    };
    for (int i = 0; i < cells_x_; ++i) {
      side(corner(i, 0), corner(i + 1, 0));
      side(corner(i + 1, cells_y_), corner(i, cells_y_));
    }
    for (int j = 0; j < cells_y_; ++j) {
      side(corner(cells_x_, j), corner(cells_x_, j + 1));
      side(corner(0, j + 1), corner(0, j));
    }
    return result;
  }

 private:
  double place(int axis, int i) const {
    return i == (axis == 0 ? cells_x_ : cells_y_) ? grid_.high[axis] : grid_.low[axis] + i * step_[axis];
  }
  Vec3 corner(int i, int j) const {
    return {place(0, i), place(1, j), grid_.heights[static_cast<std::size_t>(j) * grid_.columns + i]};
  }
  int cell(const Vec3& point, int axis) const {
    const double last = (axis == 0 ? cells_x_ : cells_y_) - 1.0;
    return static_cast<int>(std::clamp(std::floor((point[axis] - grid_.low[axis]) / step_[axis]), 0.0, last));
  }
  bool over(const Vec3& point, int axis) const {
    return point[axis] >= grid_.low[axis] && point[axis] <= grid_.high[axis];
  }

  /// Height of the surface above or below a point of the rectangle.
  double height(const Vec3& point) const {
    const int i = cell(point, 0), j = cell(point, 1);
    const Vec3 from = corner(i, j), to = corner(i + 1, j + 1);
    const double u = (point.x() - from.x()) / (to.x() - from.x()), v = (point.y() - from.y()) / (to.y() - from.y());
    if (u >= v) {
      const double side = corner(i + 1, j).z();
      return from.z() + u * (side - from.z()) + v * (to.z() - side);
    }
    const double side = corner(i, j + 1).z();
    return from.z() + v * (side - from.z()) + u * (to.z() - side);
  }

  /// Distance of a point from a cell's column, squared.
  double gap(const Vec3& p, int i, int j) const {
    const double x = std::max({place(0, i) - p.x(), p.x() - place(0, i + 1), 0.0});
    const double y = std::max({place(1, j) - p.y(), p.y() - place(1, j + 1), 0.0});
    return x * x + y * y;
  }

  void look_at(int i, int j, const Vec3& p, Nearest& best) const {
    const Vec3 a = corner(i, j), b = corner(i + 1, j), c = corner(i + 1, j + 1), d = corner(i, j + 1);
    const auto [least, most] = std::minmax({a.z(), b.z(), c.z(), d.z()});
    const double above = std::max({p.z() - most, least - p.z(), 0.0});
    if (gap(p, i, j) + above * above >= best.squared) return;
    const int index = 2 * (j * cells_x_ + i);
    nearest_of({a, b, c, index}, p, best);
    nearest_of({a, c, d, index + 1}, p, best);
  }

  Vec3 triangle_normal(int index) const {
    const int i = index / 2 % cells_x_, j = index / 2 / cells_x_;
    const Vec3 a = corner(i, j), c = corner(i + 1, j + 1);
    const Vec3 normal = index % 2 == 0 ? (corner(i + 1, j) - a).cross(c - a) : (c - a).cross(corner(i, j + 1) - a);
    return normal.normalized();
  }

  Found find_nearest(const Vec3& p) const {
    Nearest nearest;
    const int x = cell(p, 0), y = cell(p, 1);
    for (int ring = 0, nearer = 1; nearer != 0; ++ring) {
      nearer = 0;
      const auto visit = [&](int i, int j) {
        if (i < 0 || i >= cells_x_ || gap(p, i, j) >= nearest.squared) return;
        nearer = 1;
        look_at(i, j, p, nearest);
      };
      for (int j = std::max(y - ring, 0); j <= std::min(y + ring, cells_y_ - 1); ++j) {
        const bool whole_row = std::abs(j - y) == ring;
        for (int i = x - ring; i <= x + ring; i += whole_row || ring == 0 ? 1 : 2 * ring) visit(i, j);
      }
    }
    Found found{nearest.squared, nearest.point, triangle_normal(nearest.triangle), nearest.feature == kFace};
    for (int axis = 0; axis < 2; ++axis) {
      look_at_side(p, axis, grid_.low[axis], -1.0, found);
      look_at_side(p, axis, grid_.high[axis], 1.0, found);
    }
    return found;
  }

  /// The upright side across `axis` at `end`, where the point is beside it; and the upright edge at its end, for a
  /// point that is beyond it along both axes.
  void look_at_side(const Vec3& p, int axis, double end, double outwards, Found& found) const {
    Vec3 point = p;
    point[axis] = end;
    const int other = 1 - axis;
    point[other] = std::clamp(p[other], grid_.low[other], grid_.high[other]);
    const double squared = (p - point).squaredNorm();
    if (squared >= found.squared || p.z() >= height(point)) return;
    found = {squared, point, outwards * Vec3::Unit(axis), over(p, other)};
  }

  HeightGrid grid_;
  int cells_x_, cells_y_;
  Vec2 step_;
  double lowest_, highest_;
};

void check_extent(double low, double high, char axis) {
  if (std::isfinite(low) && std::isfinite(high) && high > low) return;
  throw RigidError(
      fmt::format("height_field: along {} it goes from {:g} to {:g} m; write the smaller number first, "
                  "both finite",
                  axis, low, high));
}

}  // namespace

std::unique_ptr<Surface> make_height_field(const HeightGrid& grid) {
  const auto count =
      static_cast<std::size_t>(std::max(grid.columns, 0)) * static_cast<std::size_t>(std::max(grid.rows, 0));
  if (grid.columns < 2 || grid.rows < 1 || count != grid.heights.size()) {
    throw RigidError(
        fmt::format("height_field: {} heights for {} x {} points; it needs one each, and two points along "
                    "an axis at least",
                    grid.heights.size(), grid.columns, grid.rows));
  }
  check_extent(grid.low.x(), grid.high.x(), 'x');
  if (grid.rows > 1) check_extent(grid.low.y(), grid.high.y(), 'y');
  for (std::size_t i = 0; i < count; ++i) {
    if (!std::isfinite(grid.heights[i])) {
      throw RigidError(fmt::format("height_field: height {} of row {} is {:g}; all must be finite",
                                   i % grid.columns + 1, i / grid.columns + 1, grid.heights[i]));
    }
  }
  if (grid.rows == 1) return make_height_profile(grid);
  return std::make_unique<HeightField>(grid);
}

}  // namespace mpm
