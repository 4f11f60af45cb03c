#include "mpm/crack/crossing.hpp"

#include <algorithm>

namespace mpm {

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

}  // namespace mpm
