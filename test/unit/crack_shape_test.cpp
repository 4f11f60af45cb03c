// Points of chains from corners and arcs, and what is wrong with a chain.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "mpm/crack/chain_shape.hpp"
#include "mpm/math/constants.hpp"

namespace mpm::test {
namespace crack_shape_test {

double longest_segment(const std::vector<Vec2>& points) {
  double longest = 0.0;
  for (std::size_t k = 0; k + 1 < points.size(); ++k) longest = std::max(longest, (points[k + 1] - points[k]).norm());
  return longest;
}

TEST(CrackShape, DividesEdgesIntoEqualSegmentsNotTooLong) {
  // 1.0 by 0.3 at most: 4 of 0.25; 0.9 by 0.3: 3. A corner in the place of another to round-off is dropped.
  const std::vector<Vec2> points = subdivided({{0, 0}, {0, 0}, {1, 0}, {1 + 1e-15, 0}, {1, 0.9}, {1, 0.9}}, 0.3);
  const std::vector<Vec2> expected{{0, 0}, {0.25, 0}, {0.5, 0}, {0.75, 0}, {1, 0}, {1, 0.3}, {1, 0.6}, {1, 0.9}};
  ASSERT_EQ(points.size(), expected.size());
  for (std::size_t k = 0; k < points.size(); ++k) EXPECT_LT((points[k] - expected[k]).norm(), 1e-15) << k;  // round-off
  EXPECT_EQ(points.back(), Vec2(1, 0.9));                     // corners are kept to the last bit
  EXPECT_EQ(subdivided({{0, 0}, {2.1, 0}}, 0.7).size(), 4u);  // 2.1 / 0.7 is more than 3 in double precision
  // An edge shorter than a segment stays one.
  EXPECT_EQ(subdivided({{0, 0}, {0.1, 0}}, 0.3).size(), 2u);
}

TEST(CrackShape, PutsPointsOnArcs) {
  const Vec2 centre(1, 2);
  // A quarter, clockwise; 0.1 pi of arc by 0.1 at most: 4 segments.
  const std::vector<Vec2> points = arc_points(centre, 0.2, kPi, 0.5 * kPi, 0.1);
  ASSERT_EQ(points.size(), 5u);
  for (const Vec2& point : points) EXPECT_NEAR((point - centre).norm(), 0.2, 1e-15);  // round-off
  EXPECT_LT((points.front() - Vec2(0.8, 2.0)).norm(), 1e-15);
  EXPECT_LT((points.back() - Vec2(1.0, 2.2)).norm(), 1e-15);
  EXPECT_LT((points[2] - (centre + 0.2 * std::sqrt(0.5) * Vec2(-1, 1))).norm(), 1e-15);
  EXPECT_LT(longest_segment(points), 0.1);
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    EXPECT_NEAR((points[k + 1] - points[k]).norm(), 0.4 * std::sin(kPi / 16.0), 1e-15);  // chords of equal angles
  }
}

TEST(CrackShape, JoinsPartsAndDropsTheirDoublePoint) {
  const std::vector<Vec2> line{{0, 0}, {1, 0}}, arc = arc_points({1, 1}, 1.0, -0.5 * kPi, 0.0, 0.4);
  // The arc begins at (1, 0) to round-off.
  const std::vector<Vec2> both = joined({line, {}, arc, {{2, 3}, {2, 4}}});
  ASSERT_EQ(both.size(), 2 + arc.size() - 1 + 2);
  EXPECT_EQ(both[1], Vec2(1, 0));
  EXPECT_EQ(both[2], arc[1]);
  EXPECT_EQ(both[both.size() - 2], Vec2(2, 3));
  EXPECT_TRUE(joined({}).empty());
}

TEST(CrackShape, FindsFaults) {
  const auto says = [](const std::vector<Vec2>& points, const std::string& text) {
    const std::string fault = line_fault(points, 0.1);
    EXPECT_NE(fault.find(text), std::string::npos) << "'" << fault << "' does not say '" << text << "'";
  };
  says({}, "has 0");
  says({{0, 0}}, "has 1");
  says({{0, 0}, {0.1, std::numeric_limits<double>::quiet_NaN()}}, "point 2 is no place");
  says({{0, 0}, {0.1, 0}, {0.1, 0}}, "points 2 and 3 lie in one place, (0.1, 0)");
  says({{0, 0}, {0.1, 0}, {0.1, 0.21}}, "from (0.1, 0) to (0.1, 0.21) m is 0.21 m long");
  // The first and the last segment cross at a quarter of the first.
  says({{0, 0}, {0.2, 0}, {0.2, 0.1}, {0.05, 0.1}, {0.05, -0.05}}, "segments 1 and 4 of the chain meet at (0.05, 0) m");
  // The last point touches the first segment; the chain turns back; two segments lie in one line.
  says({{0, 0}, {0.2, 0}, {0.2, 0.1}, {0.05, 0.1}, {0.05, 0}}, "segments 1 and 4 of the chain meet at (0.05, 0) m");
  says({{0, 0}, {0.2, 0}, {0.1, 0}}, "segments 1 and 2 of the chain meet at (0.2, 0) m");
  says({{0, 0}, {0.2, 0}, {0.3, 0.1}, {0.15, 0.1}, {0.1, 0}, {0, 0}}, "segments 1 and 4");
}

// A zigzag of 2,499 segments in 50 rows, and one more that turns back.
TEST(CrackShape, FindsACrossingAmongManySegments) {
  std::vector<Vec2> chain;
  for (int row = 0; row < 50; ++row) {
    for (int k = 0; k < 50; ++k) chain.emplace_back(0.05 * (row % 2 == 0 ? k : 49 - k), 0.05 * row);
  }
  EXPECT_EQ(line_fault(chain, 0.1), "");
  chain.emplace_back(0.025, 2.45);  // back along the last row, which ends at x = 0
  const std::string fault = line_fault(chain, 0.1);
  EXPECT_NE(fault.find("segments 2499 and 2500"), std::string::npos) << fault;
  EXPECT_TRUE(lies_along({{1.0, 0.1}, {1.2, 0.1}, {1.4, 0.1}}, chain, 0.1));
  EXPECT_FALSE(lies_along({{1.0, 0.07}, {1.2, 0.07}, {1.4, 0.07}}, chain, 0.1));
}

TEST(CrackShape, FindsNoFaultInSoundChains) {
  EXPECT_EQ(line_fault({{0, 0}, {0.1, 0}}, 0.1), "");
  EXPECT_EQ(line_fault({{0, 0}, {0.2, 0}, {0.4, 0}}, 0.1), "");  // two cells exactly
  // Segments in one line that do not touch, and a chain that turns sharply.
  EXPECT_EQ(line_fault({{0, 0}, {0.1, 0}, {0.15, 0.1}, {0.2, 0}, {0.3, 0}}, 0.1), "");
  EXPECT_EQ(line_fault({{0, 0}, {0.2, 0}, {0.02, 0.01}}, 0.1), "");
  // The line through the last segment parts the ends of the first, but the segment ends before it.
  EXPECT_EQ(line_fault({{0, 0}, {0.1, 0}, {0.15, 0.1}, {0.05, 0.15}, {0.05, 0.05}}, 0.1), "");
  // Closed: the end is the start, to round-off for the circle.
  EXPECT_EQ(line_fault({{0, 0}, {0.1, 0}, {0.1, 0.1}, {0, 0}}, 0.1), "");
  EXPECT_EQ(line_fault(arc_points({0.7, 0.3}, 0.5, 0.3, 0.3 + 2.0 * kPi, 0.05), 0.1), "");
}

}  // namespace crack_shape_test
}  // namespace mpm::test
