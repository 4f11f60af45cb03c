#include "mpm/crack/contour.hpp"

#include <algorithm>
#include <cmath>

#include "mpm/crack/crack_error.hpp"

namespace mpm {
namespace {

/// Meetings closer than this part of a cell are one: a corner of the path on the crack.
constexpr double kOneMeeting = 1e-9;

constexpr int kLeast = 2;                    ///< cells from the tip to a path that is drawn in
constexpr double kShort = 1.0, kMost = 3.0;  ///< cells from such a path to the other tip

/// Counter-clockwise around the rectangle.
void list_nodes(ContourPath& path) {
  const std::array<int, 2> low = path.low, high = path.high;
  path.nodes.clear();
  for (int i = low[0]; i < high[0]; ++i) path.nodes.push_back({i, low[1]});
  for (int j = low[1]; j < high[1]; ++j) path.nodes.push_back({high[0], j});
  for (int i = high[0]; i > low[0]; --i) path.nodes.push_back({i, high[1]});
  for (int j = high[1]; j > low[1]; --j) path.nodes.push_back({low[0], j});
}

/// Draws the rectangle around node `middle` in, away from the other tips: each along the axis on which it is farther.
/// Returns whether there is room.
bool keep_apart(const GridLines& lines, const std::array<int, 2>& middle, const std::vector<Vec2>& others,
                ContourPath& path) {
  for (const Vec2& other : others) {
    const Vec2 place = (other - lines.origin).cwiseQuotient(lines.cell);
    const auto near = [&](int k) { return place[k] > path.low[k] - kShort && place[k] < path.high[k] + kShort; };
    if (!near(0) || !near(1)) continue;
    const Vec2 away = place - Vec2(middle[0], middle[1]);
    const int axis = std::abs(away[0]) >= std::abs(away[1]) ? 0 : 1;
    const double distance = std::abs(away[axis]);
    if (distance < kLeast + kShort) return false;
    const int reach = std::max(kLeast, static_cast<int>(std::ceil(distance - kMost)));
    if (away[axis] > 0.0) {
      path.high[axis] = std::min(path.high[axis], middle[axis] + reach);
    } else {
      path.low[axis] = std::max(path.low[axis], middle[axis] - reach);
    }
  }
  return true;
}

ContourStatus lay_around(const GridLines& lines, const Vec2* line, int points, const std::array<int, 2>& middle,
                         int size, const std::vector<Vec2>& others, ContourPath& path) {
  for (int k = 0; k < 2; ++k) {
    path.low[k] = middle[k] - size;
    path.high[k] = middle[k] + size;
  }
  if (!keep_apart(lines, middle, others, path)) return ContourStatus::holds_other_tip;
  list_nodes(path);
  for (int k = 0; k < 2; ++k) {
    if (path.low[k] < 0 || path.high[k] >= lines.nodes[k]) return ContourStatus::leaves_grid;
  }
  bool met = false;
  const int edges = static_cast<int>(path.nodes.size());
  for (int edge = 0; edge < edges; ++edge) {
    const Vec2 from = lines.place(path.nodes[edge]), to = lines.place(path.nodes[(edge + 1) % edges]);
    path.meetings.clear();
    find_meetings(line, points, from, to, path.meetings);
    for (const Meeting& meeting : path.meetings) {
      const Vec2 place = from + meeting.along * (to - from);
      if (met && (place - path.crossing.place).norm() > kOneMeeting * lines.cell.minCoeff()) {
        return ContourStatus::meets_crack_again;
      }
      if (!met) path.crossing = {edge, meeting.along, meeting.segment, meeting.along_segment, place};
      met = true;
    }
  }
  return met ? ContourStatus::complete : ContourStatus::meets_no_crack;
}

}  // namespace

const char* describe(ContourStatus status) {
  switch (status) {
    case ContourStatus::complete:
      return "the contour is complete";
    case ContourStatus::leaves_grid:
      return "the contour leaves the grid";
    case ContourStatus::meets_no_crack:
      return "the contour does not meet the crack: all of it lies inside";
    case ContourStatus::meets_crack_again:
      return "the contour meets the crack at more than one place";
    case ContourStatus::holds_other_tip:
      return "another tip is too near: no contour goes between them";
    case ContourStatus::no_material:
      return "the contour runs through nodes without material";
  }
  return "";
}

void make_path(const GridLines& lines, const Vec2* line, int points, const Vec2& tip, int size, ContourPath& path,
               const std::vector<Vec2>& others) {
  if (size < 1) throw CrackError("contour around a crack's tip: its size must be at least one cell");
  if (points < 2) throw CrackError("contour around a crack's tip: the crack has less than two points");
  const Vec2 scaled = (tip - lines.origin).cwiseQuotient(lines.cell);
  std::array<int, 2> nearest{static_cast<int>(std::lround(scaled[0])), static_cast<int>(std::lround(scaled[1]))};
  path.status = lay_around(lines, line, points, nearest, size, others, path);
  if (path.status != ContourStatus::meets_crack_again) return;
  // The next nearest node is a neighbour along the axis where that gains least in distance squared, c^2 (1 - 2 |f|).
  const Vec2 off = scaled - Vec2(nearest[0], nearest[1]);
  const Vec2 gain = lines.cell.cwiseAbs2().cwiseProduct(Vec2::Ones() - 2.0 * off.cwiseAbs());
  const int axis = gain[0] <= gain[1] ? 0 : 1;
  nearest[axis] += off[axis] < 0.0 ? -1 : 1;
  path.status = lay_around(lines, line, points, nearest, size, others, path);
}

}  // namespace mpm
