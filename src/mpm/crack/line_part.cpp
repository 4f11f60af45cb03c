#include "mpm/crack/line_part.hpp"

#include <algorithm>
#include <vector>

namespace mpm {

LinePart part_between(const Chain& chain, const LinePart& within, const Vec2& low, const Vec2& high) {
  const std::vector<Vec2>& line = chain.line();
  const std::vector<Chain::Extent>& extents = chain.extents();
  int first = -1, last = -1;
  for (int k = within.first; k + 1 < within.first + within.points; ++k) {
    if (k % Chain::kRun == 0 && extents[k / Chain::kRun].misses(low, high)) {
      k += Chain::kRun - 1;
      continue;
    }
    const Vec2 &a = line[k], &b = line[k + 1];
    if (std::min(a[0], b[0]) > high[0] || std::max(a[0], b[0]) < low[0]) continue;
    if (std::min(a[1], b[1]) > high[1] || std::max(a[1], b[1]) < low[1]) continue;
    if (first < 0) first = k;
    last = k;
  }
  if (first < 0) return {};
  LinePart part{first, last - first + 2, line[first], line[first]};
  for (int k = first + 1; k < first + part.points; ++k) {
    part.low = part.low.cwiseMin(line[k]);
    part.high = part.high.cwiseMax(line[k]);
  }
  return part;
}

}  // namespace mpm
