#include "mpm/crack/chain_shape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include "mpm/crack/crossing.hpp"

namespace mpm {
namespace {

constexpr double kSamePlace = 1e-9;      ///< part of the length at hand: rounding of what was meant to be one place
constexpr double kLongestSegment = 2.0;  ///< [cells]
constexpr double kAlong = 0.05;          ///< [cells] between chains of which one lies along the other

std::string place_text(const Vec2& point) { return fmt::format("({:.6g}, {:.6g})", point[0], point[1]); }

/// The fewest equal parts of a length that are not longer than `part`.
int parts_of(double length, double part) {
  return std::max(1, static_cast<int>(std::ceil(length / part - kSamePlace)));
}

/// True if a point on the line through a and b lies between them.
bool lies_between(const Vec2& a, const Vec2& b, const Vec2& point) { return (point - a).dot(point - b) <= 0.0; }

/// True if segments a-b and c-e have a point in common; `common` is then one of them.
bool have_common_point(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& e, Vec2& common) {
  const double of_c = double_area(a, b, c), of_e = double_area(a, b, e);
  const double of_a = double_area(c, e, a), of_b = double_area(c, e, b);
  const auto touches = [&common](double area, const Vec2& from, const Vec2& to, const Vec2& point) {
    if (area != 0.0 || !lies_between(from, to, point)) return false;
    common = point;
    return true;
  };
  if (touches(of_c, a, b, c) || touches(of_e, a, b, e) || touches(of_a, c, e, a) || touches(of_b, c, e, b)) return true;
  if (of_c * of_e >= 0.0 || of_a * of_b >= 0.0) return false;
  common = c + of_c / (of_c - of_e) * (e - c);
  return true;
}

/// True if a chain that goes from `before` over `at` to `after` turns back onto itself.
bool folds_back(const Vec2& before, const Vec2& at, const Vec2& after) {
  return double_area(before, at, after) == 0.0 && (before - at).dot(after - at) > 0.0;
}

/// The segments of a chain by the squares of a grid that they pass, so that those near a place are found without
/// looking at all.
class SegmentSquares {
 public:
  /// `side`: of a square, best that of the longest segment.
  SegmentSquares(const std::vector<Vec2>& points, double side) : side_(side) {
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
      each_square(points[k].cwiseMin(points[k + 1]), points[k].cwiseMax(points[k + 1]),
                  [&](const Square& square) { squares_[square].push_back(k); });
    }
  }
  /// Those that can meet the box from `low` to `high`, in their order.
  std::vector<std::size_t> near(const Vec2& low, const Vec2& high) const {
    std::vector<std::size_t> found;
    each_square(low, high, [&](const Square& square) {
      const auto here = squares_.find(square);
      if (here != squares_.end()) found.insert(found.end(), here->second.begin(), here->second.end());
    });
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

 private:
  using Square = std::pair<std::int64_t, std::int64_t>;
  static constexpr double kFarthest = 1e15;  ///< [squares]; beyond, all are one

  template <class Visit>
  void each_square(const Vec2& low, const Vec2& high, const Visit& visit) const {
    const auto number = [&](double place) {
      return static_cast<std::int64_t>(std::floor(std::clamp(place / side_, -kFarthest, kFarthest)));
    };
    for (std::int64_t i = number(low.x()); i <= number(high.x()); ++i) {
      for (std::int64_t j = number(low.y()); j <= number(high.y()); ++j) visit({i, j});
    }
  }

  double side_;
  std::map<Square, std::vector<std::size_t>> squares_;
};

std::string crossing_fault(const std::vector<Vec2>& points, bool closed, double side) {
  const std::size_t segments = points.size() - 1;
  const auto fault = [](std::size_t one, std::size_t other, const Vec2& place) {
    return fmt::format("segments {} and {} of the chain meet at {} m; a crack must not cross itself: divide it in two",
                       one + 1, other + 1, place_text(place));
  };
  const SegmentSquares squares(points, side);
  for (std::size_t one = 0; one < segments; ++one) {
    const Vec2 &from = points[one], &to = points[one + 1], pad = Vec2::Constant(kSamePlace * side);
    for (const std::size_t other : squares.near(from.cwiseMin(to) - pad, from.cwiseMax(to) + pad)) {
      if (other <= one) continue;
      if (other == one + 1) {
        if (!folds_back(points[one], points[other], points[other + 1])) continue;
        return fault(one, other, points[other]);
      }
      if (closed && one == 0 && other + 1 == segments) {
        if (!folds_back(points[other], points[0], points[1])) continue;
        return fault(one, other, points[0]);
      }
      Vec2 common;
      if (!have_common_point(points[one], points[one + 1], points[other], points[other + 1], common)) continue;
      return fault(one, other, common);
    }
  }
  return {};
}

}  // namespace

std::vector<Vec2> subdivided(const std::vector<Vec2>& corners, double segment) {
  std::vector<Vec2> points;
  for (const Vec2& corner : corners) {
    if (points.empty()) {
      points.push_back(corner);
      continue;
    }
    const Vec2 from = points.back();
    const double length = (corner - from).norm();
    if (length <= kSamePlace * segment) continue;
    const int parts = parts_of(length, segment);
    for (int k = 1; k < parts; ++k) points.push_back(from + static_cast<double>(k) / parts * (corner - from));
    points.push_back(corner);
  }
  return points;
}

std::vector<Vec2> arc_points(const Vec2& centre, double radius, double from, double to, double segment) {
  const int parts = parts_of(radius * std::abs(to - from), segment);
  std::vector<Vec2> points;
  for (int k = 0; k <= parts; ++k) {
    const double angle = from + static_cast<double>(k) / parts * (to - from);
    points.push_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  return points;
}

std::vector<Vec2> joined(const std::vector<std::vector<Vec2>>& parts) {
  std::vector<Vec2> points;
  for (const std::vector<Vec2>& part : parts) {
    if (part.empty()) continue;
    const double size = part.size() > 1 ? (part[1] - part[0]).norm() : 0.0;
    const bool continues = !points.empty() && (part.front() - points.back()).norm() <= kSamePlace * size;
    points.insert(points.end(), part.begin() + (continues ? 1 : 0), part.end());
  }
  return points;
}

std::string line_fault(const std::vector<Vec2>& points, double cell) {
  if (points.size() < 2) return fmt::format("a crack has two points or more, this one has {}", points.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!points[k].allFinite()) return fmt::format("point {} is no place; give finite coordinates", k + 1);
  }
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    const double length = (points[k + 1] - points[k]).norm();
    if (length <= kSamePlace * cell) {
      return fmt::format("points {} and {} lie in one place, {} m; leave one out", k + 1, k + 2, place_text(points[k]));
    }
    if (length > kLongestSegment * cell * (1.0 + kSamePlace)) {
      return fmt::format(
          "the segment from {} to {} m is {:.6g} m long, more than two cells ({:.6g} m); divide it, best into "
          "segments of half a cell",
          place_text(points[k]), place_text(points[k + 1]), length, kLongestSegment * cell);
    }
  }
  return crossing_fault(points, (points.back() - points.front()).norm() <= kSamePlace * cell, kLongestSegment * cell);
}

bool lies_along(const std::vector<Vec2>& points, const std::vector<Vec2>& other, double cell) {
  const SegmentSquares squares(other, kLongestSegment * cell);
  const Vec2 around = Vec2::Constant(kAlong * cell);
  const auto near = [&](const Vec2& point) {
    for (const std::size_t k : squares.near(point - around, point + around)) {
      const double part = nearest_part(other[k], other[k + 1], point);
      if ((other[k] + part * (other[k + 1] - other[k]) - point).norm() < kAlong * cell) return true;
    }
    return false;
  };
  double along = 0.0;  // length of consecutive points that are near; a line that only crosses is near for twice kAlong
  bool before = near(points.front());
  for (std::size_t k = 1; k < points.size(); ++k) {
    const bool now = near(points[k]);
    along = before && now ? along + (points[k] - points[k - 1]).norm() : 0.0;
    if (along > 4.0 * kAlong * cell) return true;
    before = now;
  }
  return false;
}

}  // namespace mpm
