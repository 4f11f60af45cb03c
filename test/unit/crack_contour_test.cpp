// The path around a crack's tip: its nodes, where it meets the crack, when there is none, and the values along it.
#include <gtest/gtest.h>

#include "mpm/crack/contour_values.hpp"
#include "mpm/crack/crack_error.hpp"

namespace mpm::test {
namespace crack_contour_test {

using Nodes = std::vector<std::array<int, 2>>;

/// 11 x 9 nodes, cells of 0.5 m x 0.25 m.
const GridLines kLines{{1.0, -1.0}, {0.5, 0.25}, {11, 9}};

Vec2 at(double i, double j) { return kLines.origin + kLines.cell.cwiseProduct(Vec2(i, j)); }

ContourPath path_of(const std::vector<Vec2>& line, int size) {
  ContourPath path;
  make_path(kLines, line.data(), static_cast<int>(line.size()), line.back(), size, path);
  return path;
}

TEST(CrackContour, SurroundsTheNearestNodeCounterClockwise) {
  const ContourPath path = path_of({at(0.2, 4.3), at(4.6, 3.8)}, 1);
  ASSERT_EQ(path.status, ContourStatus::complete);
  EXPECT_EQ(path.nodes, (Nodes{{4, 3}, {5, 3}, {6, 3}, {6, 4}, {6, 5}, {5, 5}, {4, 5}, {4, 4}}));
  EXPECT_DOUBLE_EQ(path.area(kLines), 1.0 * 0.5);
  EXPECT_TRUE(path.contains(kLines, at(4.6, 3.8)));
  EXPECT_FALSE(path.contains(kLines, at(3.9, 3.8)));
  // On the left side, i = 4, the crack is at j = 4.3 - 0.5 (4 - 0.2) / (4.6 - 0.2) = 3.8682: the last edge but none,
  // from node (4, 4) down to (4, 3).
  EXPECT_EQ(path.crossing.edge, 7);
  EXPECT_NEAR(path.crossing.along, 4.0 - (4.3 - 0.5 * 3.8 / 4.4), 1e-12);
  EXPECT_EQ(path.crossing.segment, 0);
  EXPECT_NEAR(path.crossing.along_segment, 3.8 / 4.4, 1e-12);
  EXPECT_NEAR((path.crossing.place - at(4.0, 4.3 - 0.5 * 3.8 / 4.4)).norm(), 0.0, 1e-12);
}

TEST(CrackContour, SaysWhyThereIsNone) {
  EXPECT_EQ(path_of({at(-0.8, 4.3), at(1.6, 4.3)}, 2).status, ContourStatus::complete);
  EXPECT_EQ(path_of({at(-0.8, 4.3), at(1.4, 4.3)}, 2).status, ContourStatus::leaves_grid);
  EXPECT_EQ(path_of({at(4.2, 4.3), at(5.4, 4.3)}, 2).status, ContourStatus::meets_no_crack);
  EXPECT_THROW(path_of({at(0.2, 4.3), at(4.6, 3.8)}, 0), CrackError);
  EXPECT_THROW(path_of({at(0.2, 4.3)}, 1), CrackError);
  for (const ContourStatus status : {ContourStatus::leaves_grid, ContourStatus::meets_no_crack,
                                     ContourStatus::meets_crack_again, ContourStatus::no_material}) {
    EXPECT_GT(std::string(describe(status)).size(), 10u);
  }
}

// The crack comes back to its tip and passes through i = 6.4 on its way: around the node nearest to the tip, (5, 4),
// the path of one cell meets it at three places. The next nearest node is (4, 4), since the cell is wide and the tip,
// at (4.55, 4.2), is off by 0.225 m along x but 0.05 m along z: a neighbour along x is (1 - 0.9) 0.25 m^2, one along z
// (1 - 0.4) 0.0625 m^2 farther, squared.
TEST(CrackContour, TriesTheNextNearestNode) {
  const std::vector<Vec2> line{at(0.3, 2.6), at(5.3, 2.6), at(5.3, 3.4), at(5.7, 3.4), at(5.7, 2.4),
                               at(7.5, 2.4), at(7.5, 7.5), at(1.5, 7.5), at(1.5, 4.2), at(4.55, 4.2)};
  const ContourPath path = path_of(line, 1);
  EXPECT_EQ(path.status, ContourStatus::complete);
  EXPECT_EQ(path.low, (std::array<int, 2>{3, 3}));
  EXPECT_EQ(path.high, (std::array<int, 2>{5, 5}));
  EXPECT_EQ(path.crossing.segment, 8);
  // With the loop moved towards the tip both paths meet it.
  std::vector<Vec2> near = line;
  near[1] = near[2] = at(4.3, 2.6);
  near[2] = at(4.3, 3.4);
  EXPECT_EQ(path_of(near, 1).status, ContourStatus::meets_crack_again);
}

// A crack through a corner of the path lies on two of its edges, but meets it once.
TEST(CrackContour, MeetsACornerOnce) {
  const ContourPath path = path_of({at(2.0, 2.0), at(5.0, 5.0)}, 1);
  ASSERT_EQ(path.status, ContourStatus::complete);
  EXPECT_NEAR((path.crossing.place - at(4.0, 4.0)).norm(), 0.0, 1e-12);
}

/// 31 x 31 nodes, cells of 1 m; a crack whose tip lies beside node (15, 15).
ContourPath path_beside(const std::vector<Vec2>& others, int size) {
  const GridLines lines{{0.0, 0.0}, {1.0, 1.0}, {31, 31}};
  const std::vector<Vec2> line{{0.0, 15.4}, {15.1, 15.4}};
  ContourPath path;
  make_path(lines, line.data(), 2, line.back(), size, path, others);
  return path;
}

using Node = std::array<int, 2>;

// One to three cells short of the other tip, two from its own at least, on the side where the other is.
TEST(CrackContour, KeepsAwayFromOtherTips) {
  const auto expect = [](const std::vector<Vec2>& others, int size, const Node& low, const Node& high) {
    const ContourPath path = path_beside(others, size);
    ASSERT_EQ(path.status, ContourStatus::complete);
    EXPECT_EQ(path.low, low);
    EXPECT_EQ(path.high, high);
    EXPECT_EQ(static_cast<int>(path.nodes.size()), 2 * (high[0] - low[0] + high[1] - low[1]));
  };
  expect({}, 4, {11, 11}, {19, 19});
  expect({{20.1, 15.4}}, 4, {11, 11}, {19, 19});  // more than a cell beside it
  expect({{15.0, 20.1}}, 4, {11, 11}, {19, 19});
  expect({{19.9, 15.4}}, 4, {11, 11}, {17, 19});  // 2.9 cells short
  expect({{18.0, 15.4}}, 4, {11, 11}, {17, 19});  // one cell short
  expect({{20.5, 12.0}}, 6, {9, 9}, {18, 21});    // 2.5 cells short
  expect({{16.0, 11.2}}, 4, {11, 13}, {19, 19});
  expect({{11.3, 18.0}}, 4, {13, 11}, {19, 19});  // on the side on which it is farther
  expect({{19.4, 15.4}, {15.0, 18.2}}, 4, {11, 11}, {17, 17});
}

TEST(CrackContour, HasNoRoomBetweenTipsNextToEachOther) {
  for (const Vec2& other : {Vec2(17.9, 15.4), Vec2(15.0, 17.9), Vec2(12.1, 12.1), Vec2(15.1, 15.4)}) {
    EXPECT_EQ(path_beside({other}, 4).status, ContourStatus::holds_other_tip);
  }
  EXPECT_GT(std::string(describe(ContourStatus::holds_other_tip)).size(), 10u);
}

/// A number as energy: 1 below the crack, 2 above, of which some nodes may have none.
class TwoSides final : public ContourSource {
 public:
  std::array<int, 2> without{-1, -1};  ///< has no material across
  std::array<int, 2> without_own{-1, -1};
  bool find(const std::array<int, 2>& node, ContourField field, ContourValues& values) const override {
    if (node == (field == ContourField::own ? without_own : without)) return false;
    const bool above = (node[1] >= 4) == (field == ContourField::own);
    values = {};
    values.energy = above ? 2.0 + 0.1 * node[1] : 1.0 + 0.1 * node[1];
    return true;
  }
};

TEST(CrackContour, HasOnePointOnEachFace) {
  // The crack at j = 3.7, between nodes (4, 4), above, and (4, 3), below: the values on its faces are those of the
  // sides at j = 3.7.
  const ContourPath path = path_of({at(0.2, 3.7), at(5.1, 3.7)}, 1);
  ASSERT_EQ(path.status, ContourStatus::complete);
  TwoSides source;
  std::vector<ContourPiece> pieces;
  ASSERT_EQ(gather_contour(kLines, path, source, pieces), ContourStatus::complete);
  ASSERT_EQ(pieces.size(), 9u);
  EXPECT_NEAR(pieces.front().first.energy, 1.37, 1e-12);
  EXPECT_NEAR(pieces.back().last.energy, 2.37, 1e-12);
  EXPECT_EQ(pieces.front().last.energy, 1.3);  // node (4, 3)
  EXPECT_EQ(pieces.back().first.energy, 2.4);  // node (4, 4)
  Vec2 turn{0.0, 0.0};
  double around = 0.0;
  for (const ContourPiece& piece : pieces) {
    turn += piece.length() * piece.normal;
    around += piece.length();
    EXPECT_NEAR(piece.normal.dot(piece.to - piece.from), 0.0, 1e-15);
    EXPECT_GT(piece.normal.dot(0.5 * (piece.from + piece.to) - at(5, 4)), 0.0);
  }
  EXPECT_NEAR(turn.norm(), 0.0, 1e-14);  // sum over a closed line
  EXPECT_NEAR(around, 2.0 * (1.0 + 0.5), 1e-14);

  // A node without material across: its face has what the other node has.
  source.without = {4, 4};
  ASSERT_EQ(gather_contour(kLines, path, source, pieces), ContourStatus::complete);
  EXPECT_EQ(pieces.front().first.energy, 1.3);
  EXPECT_NEAR(pieces.back().last.energy, 2.37, 1e-12);
  source.without = {4, 3};
  ASSERT_EQ(gather_contour(kLines, path, source, pieces), ContourStatus::complete);
  EXPECT_NEAR(pieces.front().first.energy, 1.37, 1e-12);
  EXPECT_EQ(pieces.back().last.energy, 2.4);
  for (const std::array<int, 2>& node : path.nodes) {
    source.without_own = node;
    EXPECT_EQ(gather_contour(kLines, path, source, pieces), ContourStatus::no_material);
  }
}

/// Energy that is linear on each side, as means of material whose centres lie off the nodes beside the crack at j
/// = 3.5.
class OffCentre final : public ContourSource {
 public:
  double aside = 0.0;  ///< offset of the centres of material across [cells]
  static double energy(double j, bool above) { return above ? 2.0 + 0.3 * j : 1.0 - 0.2 * j; }
  bool find(const std::array<int, 2>& node, ContourField field, ContourValues& values) const override {
    const bool own = field == ContourField::own, above = (node[1] >= 4) == own;
    double off = 0.0;
    if (!own) off = above ? 0.75 : -0.75;
    if (own && (node[1] == 3 || node[1] == 4)) off = above ? 0.1 : -0.1;
    values = {};
    values.energy = energy(node[1] + off, above);
    values.centre = at(node[0] + (own ? 0.0 : aside), node[1] + off);
    return true;
  }
};

// At the face and at the node beside it a linear field is exact: by values as if of the nodes it is off by the slope
// times 0.425 and 0.1 cells. Centres that lie aside count as at their nodes.
TEST(CrackContour, TakesMeansAtTheirCentres) {
  const ContourPath path = path_of({at(0.2, 3.5), at(5.1, 3.5)}, 1);
  ASSERT_EQ(path.status, ContourStatus::complete);
  OffCentre source;
  std::vector<ContourPiece> pieces;
  ASSERT_EQ(gather_contour(kLines, path, source, pieces), ContourStatus::complete);
  EXPECT_NEAR(pieces.front().first.energy, OffCentre::energy(3.5, false), 1e-12);
  EXPECT_NEAR(pieces.front().last.energy, OffCentre::energy(3.0, false), 1e-12);
  EXPECT_EQ(pieces[1].first.energy, pieces.front().last.energy);
  EXPECT_NEAR(pieces.back().last.energy, OffCentre::energy(3.5, true), 1e-12);
  EXPECT_NEAR(pieces.back().first.energy, OffCentre::energy(4.0, true), 1e-12);
  EXPECT_EQ(pieces[pieces.size() - 2].last.energy, pieces.back().first.energy);
  source.aside = 0.3;
  ASSERT_EQ(gather_contour(kLines, path, source, pieces), ContourStatus::complete);
  EXPECT_NEAR(pieces.front().first.energy, OffCentre::energy(3.5 - 0.425, false), 1e-12);
  EXPECT_NEAR(pieces.front().last.energy, OffCentre::energy(3.0 - 0.1, false), 1e-12);
}

}  // namespace crack_contour_test
}  // namespace mpm::test
