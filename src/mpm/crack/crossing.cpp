#include "mpm/crack/crossing.hpp"

#include <algorithm>

namespace mpm {
namespace {

Vec2 place_at(const Vec2& a, const Vec2& b, double part) { return a + part * (b - a); }

}  // namespace

double nearest_part(const Vec2& a, const Vec2& b, const Vec2& place) {
  const double length2 = (b - a).squaredNorm();
  return length2 > 0.0 ? std::clamp((place - a).dot(b - a) / length2, 0.0, 1.0) : 0.0;
}

int find_meetings(const Vec2* line, int points, const Vec2& a, const Vec2& b, std::vector<Meeting>& found) {
  found.clear();
  double of_to = double_area(a, b, line[0]);
  for (int k = 0; k + 1 < points; ++k) {
    const double of_from = of_to;
    of_to = double_area(a, b, line[k + 1]);
    if ((of_from < 0.0) == (of_to < 0.0)) continue;
    const double of_a = double_area(line[k], line[k + 1], a), of_b = double_area(line[k], line[k + 1], b);
    if ((of_a < 0.0) == (of_b < 0.0)) continue;
    found.push_back({of_a / (of_a - of_b), k, of_from / (of_from - of_to)});
  }
  const auto earlier = [](const Meeting& one, const Meeting& other) {
    return one.along < other.along || (one.along == other.along && one.segment < other.segment);
  };
  std::sort(found.begin(), found.end(), earlier);
  return static_cast<int>(found.size());
}

LineApproach find_approach(const Vec2* line, int points, const Vec2& a, const Vec2& b, double met, double within) {
  LineApproach first;
  const auto take = [&first](double along, const Vec2& place) {
    if (first.found && along >= first.along) return;
    first = {true, along, place};
  };
  std::vector<Meeting> meetings;
  if (find_meetings(line, points, a, b, meetings) > 0) {
    take(meetings.front().along, place_at(a, b, meetings.front().along));
  }
  for (int k = 0; k + 1 < points; ++k) {
    const Vec2 of_a = place_at(line[k], line[k + 1], nearest_part(line[k], line[k + 1], a));
    const Vec2 of_b = place_at(line[k], line[k + 1], nearest_part(line[k], line[k + 1], b));
    const double from_a = (of_a - a).norm(), from_b = (of_b - b).norm();
    if (from_a <= met) take(0.0, of_a);
    if (from_b <= within && from_b < from_a) take(1.0, of_b);
  }
  for (int k = 0; k < points; ++k) {
    const double part = nearest_part(a, b, line[k]);
    if (part > 0.0 && (place_at(a, b, part) - line[k]).norm() <= within) take(part, line[k]);
  }
  return first;
}

}  // namespace mpm
