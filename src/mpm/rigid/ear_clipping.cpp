#include "ear_clipping.hpp"

#include <algorithm>

namespace mpm {

namespace {

/// Twice the signed area of a triangle.
double turn(const Vec2& a, const Vec2& b, const Vec2& c) {
  const Vec2 first = b - a, second = c - a;
  return first.x() * second.y() - first.y() * second.x();
}

bool is_ear(const Profile& corners, std::size_t at) {
  const std::size_t n = corners.size(), before = (at + n - 1) % n, after = (at + 1) % n;
  const Vec2 &a = corners[before], &b = corners[at], &c = corners[after];
  if (turn(a, b, c) <= 0.0) return false;
  for (std::size_t i = 0; i < n; ++i) {
    if (i == before || i == at || i == after) continue;
    const Vec2& p = corners[i];
    if (turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0) return false;
  }
  return true;
}

}  // namespace

std::vector<std::array<Vec2, 3>> cut_into_triangles(const Profile& profile) {
  Profile corners = profile;
  std::vector<std::array<Vec2, 3>> triangles;
  while (corners.size() >= 3) {
    const std::size_t n = corners.size();
    std::size_t ear = 0;
    while (ear < n && !is_ear(corners, ear)) ++ear;
    if (ear == n) break;  // ends with a rest of no area, but for rounding
    triangles.push_back({corners[(ear + n - 1) % n], corners[ear], corners[(ear + 1) % n]});
    corners.erase(corners.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  return triangles;
}

}  // namespace mpm
