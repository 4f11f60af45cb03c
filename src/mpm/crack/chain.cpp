#include "mpm/crack/chain.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mpm/crack/crossing.hpp"

namespace mpm {
namespace {

constexpr double kBeside = 1e-8;      ///< part of a segment
constexpr double kShallow = 1e-5;     ///< depth that is let be, of a segment
constexpr double kPutBeside = 1e-12;  ///< part of a segment

Vec2 left_of(const Vec2& direction) { return {-direction[1], direction[0]}; }

CrackPoint point_in(const Vec2& place) {
  CrackPoint point;
  point.place = point.above = point.below = point.start = place;
  return point;
}

/// Displacement by which one of a point's places goes on.
Vec2 displacement(const SurfaceMotion& now, const Vec2& before, bool known, double dt) {
  if (now.pulled) return dt * now.velocity;
  const Vec2 old = known ? before : Vec2(now.velocity - dt * now.acceleration);
  return dt * (1.5 * now.velocity - 0.5 * old - dt * now.acceleration);
}

/// One segment as a surface of its first or last point sees it.
struct SegmentSeen {
  double length = 0.0;
  double along = 0.0;  ///< place of the surface's foot, outward from the point; part of the segment
  double depth = 0.0;  ///< depth of the surface behind its line
  Vec2 foot = Vec2::Zero();
  Vec2 left = Vec2::Zero();  ///< unit vector
};

/// `way`: the segment in the chain's direction; `outward`: 1 if it begins at the point, -1 if it ends there; `side`: 1
/// for a surface above, -1 below.
SegmentSeen segment_seen(const Vec2& from_point, const Vec2& way, double outward, double side) {
  SegmentSeen seen;
  seen.length = way.norm();
  seen.left = left_of(way) / seen.length;
  seen.along = outward * from_point.dot(way) / way.squaredNorm();
  seen.depth = -side * from_point.dot(seen.left);
  seen.foot = std::clamp(seen.along, 0.0, 1.0) * outward * way;
  return seen;
}

/// The segment, or the corner where two segments meet, that is nearest to a surface at `from_point` off its point.
SegmentSeen nearest_seen(const Vec2& from_point, const Vec2* into, const Vec2* out, double side) {
  if (into == nullptr) return segment_seen(from_point, *out, 1.0, side);
  if (out == nullptr) return segment_seen(from_point, *into, -1.0, side);
  const SegmentSeen first = segment_seen(from_point, *into, -1.0, side),
                    second = segment_seen(from_point, *out, 1.0, side);
  if (first.along < 0.0 && second.along < 0.0) {  // outside the corner: the left side if the chain bends to the right
    SegmentSeen corner;
    corner.length = std::min(first.length, second.length);
    const bool outside_is_left = double_area(Vec2::Zero(), *into, *out) < 0.0;
    corner.depth = (outside_is_left == (side > 0.0) ? -1.0 : 1.0) * from_point.norm();
    corner.left = (first.left + second.left).normalized();
    return corner;
  }
  if (second.along < 0.0) return first;
  return (from_point - first.foot).squaredNorm() < (from_point - second.foot).squaredNorm() ? first : second;
}

}  // namespace

Chain::Chain(const std::vector<Vec2>& points, const std::array<CrackEnd, 2>& ends, bool fixed)
    : ends_(ends), fixed_(fixed) {
  for (const Vec2& place : points) points_.push_back(point_in(place));
  update_line();
}

void Chain::set_end(int end, CrackEnd kind) {
  ends_[end] = kind;
  update_line();
}

void Chain::update_line() {
  line_.resize(points_.size());
  for (std::size_t k = 0; k < points_.size(); ++k) line_[k] = points_[k].place;
  const int last = size() - 1;
  if (ends_[0] == CrackEnd::exterior) line_[0] += kExteriorReach * (points_[0].place - points_[1].place);
  if (ends_[1] == CrackEnd::exterior) line_[last] += kExteriorReach * (points_[last].place - points_[last - 1].place);
  extents_.clear();
  for (int first = 0; first < last; first += kRun) {
    Extent extent{line_[first], line_[first]};
    for (int k = first + 1; k <= std::min(first + kRun, last); ++k) {
      extent.low = extent.low.cwiseMin(line_[k]);
      extent.high = extent.high.cwiseMax(line_[k]);
    }
    extents_.push_back(extent);
  }
}

double Chain::distance(const Vec2& place) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (int k = 0; k + 1 < size(); ++k) {
    const Vec2 &from = points_[k].place, &to = points_[k + 1].place;
    nearest = std::min(nearest, (from + nearest_part(from, to, place) * (to - from) - place).norm());
  }
  return nearest;
}

Vec2 Chain::direction(int end) const {
  const int last = size() - 1;
  return (end == 0 ? points_[0].place - points_[1].place : points_[last].place - points_[last - 1].place).normalized();
}

Vec2 Chain::tangent(int point) const {
  Vec2 sum = Vec2::Zero();
  if (point > 0) sum += (points_[point].place - points_[point - 1].place).normalized();
  if (point + 1 < size()) sum += (points_[point + 1].place - points_[point].place).normalized();
  return sum.normalized();
}

Vec2 Chain::tangent_area(int point) const {
  return 0.5 * (points_[std::min(point + 1, size() - 1)].place - points_[std::max(point - 1, 0)].place);
}

Vec2 Chain::beside(int point, bool above) const {
  const CrackPoint& at = points_[point];
  const Vec2& surface = above ? at.above : at.below;
  const Vec2 out = (above ? 1.0 : -1.0) * left_of(tangent(point));
  const double margin = kBeside * tangent_area(point).norm();
  // Surfaces of closed faces lie across the line by less than prevent() puts back: their own side is that of the place.
  return ((surface - at.place).dot(out) < 0.0 ? at.place : surface) + margin * out;
}

Vec2 Chain::tip_opening(int end) const {
  const auto behind = [&](int k) { return opening(end == 0 ? k : size() - 1 - k); };
  Vec2 mean = behind(1);
  if (size() >= 4) mean = (behind(1) + 4.0 * behind(2) + behind(3)) / 6.0;
  if (end == 0) mean = -mean;  // the left side of a tip that points backwards is the one below
  const Vec2 ahead = direction(end);
  return {mean.dot(left_of(ahead)), mean.dot(ahead)};
}

double Chain::length() const {
  return open_length([](int) { return true; });
}

int Chain::move(const SurfaceMotion* above, const SurfaceMotion* below, const SurfaceMotion* centre, double dt, Move by,
                double largest) {
  if (fixed_) return 0;
  int stopped = 0;
  const auto advance = [&](const SurfaceMotion& now, Vec2& velocity, bool& known) -> Vec2 {
    const Vec2 way = displacement(now, velocity, known, dt);
    known = now.known && way.norm() <= largest;
    if (now.known && !known) ++stopped;
    velocity = known ? now.velocity : Vec2(Vec2::Zero());
    return known ? way : Vec2(Vec2::Zero());
  };
  for (int k = 0; k < size(); ++k) {
    CrackPoint& point = points_[k];
    Vec2 up = advance(above[k], point.velocity_above, point.known_above);
    Vec2 down = advance(below[k], point.velocity_below, point.known_below);
    if (!above[k].known) {
      up = down;
      point.velocity_above = point.velocity_below;
    }
    if (!below[k].known) {
      down = up;
      point.velocity_below = point.velocity_above;
    }
    point.above += up;
    point.below += down;
    if (by == Move::centre_of_mass) {
      point.place += advance(centre[k], point.velocity, point.known);
    } else {
      point.place += 0.5 * (up + down);
      point.velocity = 0.5 * (point.velocity_above + point.velocity_below);
    }
  }
  update_line();
  return stopped;
}

int Chain::prevent() {
  if (fixed_) return 0;
  int put_back = 0;
  for (int k = 0; k < size(); ++k) {
    CrackPoint& point = points_[k];
    Vec2 into = Vec2::Zero(), out = Vec2::Zero();
    if (k > 0) into = point.place - points_[k - 1].place;
    if (k + 1 < size()) out = points_[k + 1].place - point.place;
    for (const double side : {1.0, -1.0}) {
      Vec2& surface = side > 0.0 ? point.above : point.below;
      const Vec2 off = surface - point.place;
      const SegmentSeen seen = nearest_seen(off, k > 0 ? &into : nullptr, k + 1 < size() ? &out : nullptr, side);
      if (!(seen.depth > kShallow * seen.length) || off.norm() > seen.length) continue;
      surface = point.place + seen.foot + side * kPutBeside * seen.length * seen.left;
      ++put_back;
    }
  }
  return put_back;
}

void Chain::grow(int end, const std::vector<Vec2>& points) {
  for (const Vec2& place : points) points_.insert(end == 0 ? points_.begin() : points_.end(), point_in(place));
  update_line();
}

void Chain::serialise(StateArchive& archive) {
  archive.rows("points", points_);
  archive.column("place", points_, &CrackPoint::place);
  archive.column("above", points_, &CrackPoint::above);
  archive.column("below", points_, &CrackPoint::below);
  archive.column("start", points_, &CrackPoint::start);
  archive.column("velocity", points_, &CrackPoint::velocity);
  archive.column("velocity_above", points_, &CrackPoint::velocity_above);
  archive.column("velocity_below", points_, &CrackPoint::velocity_below);
  archive.column("known", points_, &CrackPoint::known);
  archive.column("known_above", points_, &CrackPoint::known_above);
  archive.column("known_below", points_, &CrackPoint::known_below);
  archive.value("start_end", ends_[0]);
  archive.value("end_end", ends_[1]);
  if (archive.reading()) update_line();
}

void Chain::hashed(std::vector<double>& numbers) const {
  for (const CrackPoint& point : points_) {
    for (const Vec2* value :
         {&point.place, &point.above, &point.below, &point.velocity, &point.velocity_above, &point.velocity_below}) {
      numbers.insert(numbers.end(), value->data(), value->data() + 2);
    }
  }
}

double cell_along(const Vec2& direction, const Vec2& cells) {
  return std::abs(direction[0]) >= std::abs(direction[1]) ? cells[0] : cells[1];
}

std::vector<Vec2> growth_points(const Vec2& tip, const Vec2& direction, double length, const Vec2& cells) {
  // Crack reference 5.3; below 0.75 edges this is one.
  const int parts = std::max(1, static_cast<int>(2.0 * (length + 0.25)));
  const Vec2 whole = length * cell_along(direction, cells) * direction;
  std::vector<Vec2> points;
  for (int k = 1; k <= parts; ++k) points.push_back(tip + static_cast<double>(k) / parts * whole);
  return points;
}

}  // namespace mpm
