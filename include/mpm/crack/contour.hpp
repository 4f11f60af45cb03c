// The path around the tip of a crack on which J is taken: a rectangle of grid lines around the node nearest to the
// tip, walked counter-clockwise (x to the right, z up), and the place where it meets the crack. Where other tips lie
// within it or less than a cell beside it, it is drawn in on their sides until it is one to three cells short of them,
// as the values at nodes around a tip are too smooth.
//
// Weak: the rectangle does not turn with the crack; where the crack turns back into it, there is no J at this tip.
// Source: crack reference 4.2, as in NairnMPM.
#pragma once

#include <array>
#include <vector>

#include "mpm/crack/crossing.hpp"
#include "mpm/math/geometry.hpp"

namespace mpm {

/// The lines of the grid in its plane.
struct GridLines {
  Vec2 origin{0.0, 0.0};       ///< place of node (0, 0) [m]
  Vec2 cell{1.0, 1.0};         ///< [m]
  std::array<int, 2> nodes{};  ///< along x (or r) and z
  Vec2 place(const std::array<int, 2>& node) const { return origin + cell.cwiseProduct(Vec2(node[0], node[1])); }
};

enum class ContourStatus {
  complete,
  leaves_grid,  ///< a node of the path is none of the grid's
  meets_no_crack,
  meets_crack_again,  ///< the path meets the crack at two places, and so does that around the next nearest node
  holds_other_tip,    ///< another tip is so near that no path of two cells keeps a cell away from it
  no_material         ///< a node of the path has no material on its own side
};
/// For reports: "the contour leaves the grid", ...
const char* describe(ContourStatus status);

/// Place where the path meets the crack.
struct ContourCrossing {
  int edge = 0;                ///< from node `edge` of the path to the next one
  double along = 0.0;          ///< part of that edge, 0 at its first node
  int segment = 0;             ///< segment of the crack's line, from its point `segment` to the next one
  double along_segment = 0.0;  ///< part of it
  Vec2 place{0.0, 0.0};        ///< [m]
};

struct ContourPath {
  ContourStatus status = ContourStatus::meets_no_crack;
  std::array<int, 2> low{}, high{};       ///< opposite corners of the rectangle
  std::vector<std::array<int, 2>> nodes;  ///< counter-clockwise from `low`; the last is followed by the first
  ContourCrossing crossing;               ///< set where the status is `complete`
  std::vector<Meeting> meetings;          ///< workspace

  double area(const GridLines& lines) const {
    return lines.cell[0] * (high[0] - low[0]) * lines.cell[1] * (high[1] - low[1]);
  }
  bool contains(const GridLines& lines, const Vec2& point) const {
    return (point.array() >= lines.place(low).array()).all() && (point.array() < lines.place(high).array()).all();
  }
};

/// Lays the path of `size` cells in each direction (1 or more) around `tip`, an end of the crack's line of `points`
/// points [m], away from `others`, the places of other tips. What came of it is in `path.status`; the path keeps its
/// memory from call to call.
/// @throws CrackError if `size` is less than 1 or the line has less than two points.
void make_path(const GridLines& lines, const Vec2* line, int points, const Vec2& tip, int size, ContourPath& path,
               const std::vector<Vec2>& others = {});

}  // namespace mpm
