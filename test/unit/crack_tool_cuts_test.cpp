// Thin tools in bodies that cracks divide: which places a blade lies between, which blocks it is near, and which cells
// it parts. Cost: nothing to speak of.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "mpm/crack/crack_cells.hpp"
#include "mpm/crack/tool_cuts.hpp"

namespace mpm {
namespace crack_tool_cuts_test {

/// An upright blade, x from 5.25 to 5.75 and z from 5 on, that divides the first of two sets. Cells of 1 m. Beside it a
/// crack far away, number 0.
struct Blade {
  Blade() : layout(2, Vec3::Ones(), Vec3::Zero(), Vec3::Constant(24.0)), sets(2), body(definition()) {
    tool = std::make_unique<ThinTool>(body, GeometryKind::plane_strain);
    cuts = ToolCuts({{tool.get(), {1, 0}}}, 1);
    cracks.push_back({{}, Chain({{18.0, 18.5}, {20.0, 18.5}}, {CrackEnd::none, CrackEnd::tip}, false), {1, 1}, true});
  }
  static RigidBodyDefinition definition() {
    RigidBodyDefinition definition;
    definition.name = "blade";
    definition.surface = make_box({0.5, std::numeric_limits<double>::infinity(), 6.0});
    definition.pose.position = Vec3(5.5, 0.0, 8.0);
    return definition;
  }
  CracksBetween between(const Vec2& from, const Vec2& to, std::size_t set = 0) const {
    CracksBetween found;
    EXPECT_TRUE(cuts.add_between(
        from, to, [&](int cut) { return cuts.divides(cut, set); }, found));
    return found;
  }

  GridLayout layout;
  std::vector<ParticleSet> sets;
  RigidBody body;
  std::unique_ptr<ThinTool> tool;
  ToolCuts cuts;
  std::vector<Crack> cracks;
};

TEST(CrackToolCuts, ABladeLiesBetweenItsSides) {
  const Blade blade;
  const CracksBetween right = blade.between({5.9, 7.0}, {5.0, 7.0}), left = blade.between({5.1, 7.0}, {6.0, 7.0});
  ASSERT_EQ(right.count, 1);
  ASSERT_EQ(left.count, 1);
  EXPECT_EQ(right.across[0].crack, 1) << "its number follows that of the crack";
  EXPECT_NE(right.across[0].above, left.across[0].above);
  EXPECT_EQ(blade.between({5.9, 7.0}, {6.0, 8.0}).count, 0) << "on one side";
  EXPECT_EQ(blade.between({5.9, 4.9}, {5.0, 4.0}).count, 0) << "below its end";
  EXPECT_EQ(blade.between({5.9, 5.1}, {5.0, 4.8}).count, 1) << "through its corner, at (5.75, 5.05)";
  EXPECT_EQ(blade.between({5.9, 7.0}, {5.0, 7.0}, 1).count, 0) << "a body that it does not divide";
}

// The node lies in the blade, 0.2 m above its end or 2 m above it: before the end, or before its left face.
TEST(CrackToolCuts, ANodeInTheBladeStandsForThePlaceBeforeItsNearestFace) {
  const Blade blade;
  const Vec2 near_end(5.48, 5.2), inside(5.4, 7.0);
  EXPECT_EQ(blade.between({5.9, 4.8}, near_end).count, 0);
  EXPECT_EQ(blade.between({5.1, 4.8}, near_end).count, 0);
  EXPECT_EQ(blade.between({5.9, 7.0}, inside).count, 1);
  EXPECT_EQ(blade.between({5.1, 7.0}, inside).count, 0);
}

TEST(CrackToolCuts, MoreThanTwoDoNotFit) {
  const Blade blade;
  CracksBetween found;
  found.across = {AcrossCrack{0, true}, AcrossCrack{0, false}};
  found.count = 2;
  const auto all = [](int) { return true; };
  EXPECT_FALSE(blade.cuts.add_between({5.9, 7.0}, {5.0, 7.0}, all, found));
  EXPECT_TRUE(blade.cuts.add_between({5.9, 7.0}, {6.0, 7.0}, all, found));
  EXPECT_EQ(found.count, 2);
}

// The tile of block (i, j) has the nodes from 4 i - 2 to 4 i + 5. All blocks that it reaches must be there; a ball
// around a tile, of 5 m, may bring others.
TEST(CrackToolCuts, BlocksNearABladeAreFound) {
  const Blade blade;
  std::vector<std::array<int, 3>> found;
  blade.cuts.each_near_block(blade.layout, 0.0, [&](const std::array<int, 3>& block) { found.push_back(block); });
  for (int i = 0; i <= 6; ++i) {
    for (int j = 0; j <= 6; ++j) {
      const bool meets = 4 * i - 2 <= 5.75 && 4 * i + 5 >= 5.25 && 4 * j - 2 <= 11.0 && 4 * j + 5 >= 5.0;
      const bool has = std::find(found.begin(), found.end(), std::array<int, 3>{i, j, 0}) != found.end();
      if (meets) {
        EXPECT_TRUE(has) << i << ", " << j;
      }
      if (4 * i - 2 > 6.0 + 5.0) {
        EXPECT_FALSE(has) << i << ", " << j;
      }
    }
  }
}

TEST(CrackToolCuts, ACellThatABladePartsHasTwoSides) {
  const Blade blade;
  CrackCells cells(blade.cracks, blade.cuts, blade.sets, blade.layout);
  EXPECT_EQ(cells.most(), 4);
  cells.look_at({1, 1, 0});
  const auto part = [&](double x, double z, std::size_t set = 0) {
    return cells.part_of(blade.sets[set], {static_cast<int>(x) - 4, static_cast<int>(z) - 4, 0}, {x, z});
  };
  EXPECT_NE(part(5.1, 6.5), part(5.9, 6.5));
  EXPECT_EQ(part(5.1, 6.2), part(5.1, 6.8));
  EXPECT_EQ(part(5.1, 4.5), part(5.9, 4.5)) << "below its end";
  EXPECT_EQ(part(5.1, 6.5, 1), part(5.9, 6.5, 1)) << "a body that it does not divide";
}

}  // namespace crack_tool_cuts_test
}  // namespace mpm
