#include "outline.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace mpm {

namespace {

constexpr std::size_t kMostPoints = 4000;  ///< every edge is checked against every other, and looked at from a point

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// The profile with the number of a point, for a reader who counts from 1.
std::string point_text(const Profile& profile, std::size_t i, bool about_axis) {
  return fmt::format("point {} of {}, ({}, z) = ({:g}, {:g}) m", i + 1, profile.size(), about_axis ? "r" : "x",
                     profile[i].x(), profile[i].y());
}

/// True if two edges have a point in common.
bool touch(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const double c_side = cross(b - a, c - a), d_side = cross(b - a, d - a);
  const double a_side = cross(d - c, a - c), b_side = cross(d - c, b - c);
  if (c_side * d_side < 0.0 && a_side * b_side < 0.0) return true;
  const auto within = [](const Vec2& p, const Vec2& from, const Vec2& to) {
    return (p - from).dot(p - to) <= 0.0;  // true for a point on the line
  };
  return (c_side == 0.0 && within(c, a, b)) || (d_side == 0.0 && within(d, a, b)) ||
         (a_side == 0.0 && within(a, c, d)) || (b_side == 0.0 && within(b, c, d));
}

void check_points(const Profile& profile, const char* shape, bool about_axis) {
  const std::size_t n = profile.size();
  if (n < 3) throw RigidError(fmt::format("{}: the profile has {} points; it needs at least 3", shape, n));
  if (n > kMostPoints)
    throw RigidError(fmt::format("{}: the profile has {} points; write {} at most", shape, n, kMostPoints));
  for (std::size_t i = 0; i < n; ++i) {
    const auto refuse = [&](const char* what) {
      throw RigidError(fmt::format("{}: {} {}", shape, point_text(profile, i, about_axis), what));
    };
    if (!profile[i].allFinite()) refuse("is not finite");
    if (about_axis && profile[i].x() < 0.0) refuse("has r < 0; the profile lies on one side of the axis, r >= 0");
  }
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t next = (i + 1) % n;
    if (profile[i] == profile[next]) {
      throw RigidError(fmt::format("{}: {} is the same as the next one; leave it out (the profile closes itself)",
                                   shape, point_text(profile, i, about_axis)));
    }
    const Vec2 &before = profile[(i + n - 1) % n], &after = profile[next];
    if (about_axis && profile[i].x() == 0.0 && before.x() > 0.0 && after.x() > 0.0) {
      throw RigidError(fmt::format("{}: {} alone is on the axis; give it an edge along r = 0, or r > 0", shape,
                                   point_text(profile, i, about_axis)));
    }
    const Vec2 in = profile[i] - before, out = after - profile[i];
    if (cross(in, out) == 0.0 && in.dot(out) < 0.0) {
      throw RigidError(
          fmt::format("{}: the profile turns back on itself at {}", shape, point_text(profile, i, about_axis)));
    }
  }
}

}  // namespace

double twice_area(const Profile& profile) {
  double sum = 0.0;
  for (std::size_t i = 0; i < profile.size(); ++i) sum += cross(profile[i], profile[(i + 1) % profile.size()]);
  return sum;
}

void check_outline(const Profile& profile, const char* shape, bool about_axis) {
  check_points(profile, shape, about_axis);
  const std::size_t n = profile.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 2; j < n; ++j) {
      if ((j + 1) % n == i) continue;  // neighbours share a point
      if (!touch(profile[i], profile[i + 1], profile[j], profile[(j + 1) % n])) continue;
      throw RigidError(fmt::format("{}: the profile cuts itself: the edge that begins at {} meets the one at {}", shape,
                                   point_text(profile, i, about_axis), point_text(profile, j, about_axis)));
    }
  }
}

Outline::Outline(Profile profile, bool about_axis) : profile_(std::move(profile)) {
  if (twice_area(profile_) < 0.0) std::reverse(profile_.begin(), profile_.end());
  const std::size_t n = profile_.size();
  const auto on_axis = [&](std::size_t i) {
    return about_axis && profile_[i].x() == 0.0 && profile_[(i + 1) % n].x() == 0.0;
  };
  const auto normal = [&](std::size_t i) {
    const Vec2 along = profile_[(i + 1) % n] - profile_[i];
    return Vec2(Vec2(along.y(), -along.x()).normalized());
  };
  // Between an edge and the axis lies a corner with the edge's mirror image.
  const auto corner = [&](std::size_t first, std::size_t second) {
    const auto mirrored = [](const Vec2& v) { return Vec2(-v.x(), v.y()); };
    const Vec2 one = on_axis(first) ? mirrored(normal(second)) : normal(first);
    const Vec2 two = on_axis(second) ? mirrored(normal(first)) : normal(second);
    return Vec2((one + two).normalized());
  };
  for (std::size_t i = 0; i < n; ++i) {
    if (on_axis(i)) continue;
    const Vec2 &from = profile_[i], &to = profile_[(i + 1) % n];
    edges_.push_back({from, to, normal(i), corner((i + n - 1) % n, i), corner(i, (i + 1) % n), (to - from).norm()});
  }
  low_ = high_ = profile_.front();
  for (const Vec2& point : profile_) {
    low_ = low_.cwiseMin(point);
    high_ = high_.cwiseMax(point);
  }
}

std::pair<double, Vec2> Outline::nearest(const Vec2& point) const {
  double least = std::numeric_limits<double>::infinity();
  const OutlineEdge* edge = nullptr;
  double along = 0.0;
  for (const OutlineEdge& e : edges_) {
    const Vec2 arm = point - e.from, direction = (e.to - e.from) / e.length;
    const double t = arm.dot(direction);
    const double squared = t <= 0.0        ? arm.squaredNorm()
                           : t >= e.length ? (point - e.to).squaredNorm()
                                           : std::pow(arm.dot(e.normal), 2);
    if (squared >= least) continue;
    least = squared;
    edge = &e;
    along = t;
  }
  if (along > 0.0 && along < edge->length) return {(point - edge->from).dot(edge->normal), edge->normal};
  const bool at_start = along <= 0.0;
  const Vec2& corner_normal = at_start ? edge->from_normal : edge->to_normal;
  const Vec2 arm = point - (at_start ? edge->from : edge->to);
  const double distance = arm.norm();
  if (distance == 0.0) return {0.0, corner_normal};
  const double side = arm.dot(corner_normal) < 0.0 ? -1.0 : 1.0;
  return {side * distance, side / distance * arm};
}

}  // namespace mpm
