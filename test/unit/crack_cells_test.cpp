// Cells that cracks cut: which of them have two sides, and which particle is on which.
#include "mpm/crack/crack_cells.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace mpm {
namespace crack_cells_test {

/// Cells of 1 m; places below are in the block of nodes 4 to 7.
struct Cells {
  explicit Cells(const std::vector<std::pair<std::vector<Vec2>, CrackEnd>>& lines)
      : layout(2, Vec3::Ones(), Vec3::Zero(), Vec3::Constant(16.0)), sets(2) {
    for (const auto& [points, end] : lines) {
      cracks.push_back({{}, Chain(points, {CrackEnd::none, end}, false), {1, 0}, true});
    }
    cells = std::make_unique<CrackCells>(cracks, none, sets, layout);
    cells->look_at({1, 1, 0});
  }
  int part(double x, double z, std::size_t set = 0) const {
    return cells->part_of(sets[set], {static_cast<int>(x) - 4, static_cast<int>(z) - 4, 0}, {x, z});
  }
  GridLayout layout;
  std::vector<ParticleSet> sets;
  std::vector<Crack> cracks;
  ToolCuts none;
  std::unique_ptr<CrackCells> cells;
};

TEST(CrackCells, ACellThatACrackCutsHasTwoSides) {
  const Cells flat({{{{2.0, 5.5}, {6.25, 5.5}}, CrackEnd::tip}});
  EXPECT_EQ(flat.cells->most(), 2);
  EXPECT_NE(flat.part(4.25, 5.25), flat.part(4.75, 5.75));
  EXPECT_EQ(flat.part(4.25, 5.25), flat.part(4.75, 5.25));
  EXPECT_EQ(flat.part(4.25, 5.75), flat.part(4.75, 5.75));
  EXPECT_NE(flat.part(3.5, 5.25), flat.part(3.5, 5.75)) << "a cell before the block's first";
  EXPECT_EQ(flat.part(4.25, 4.25), flat.part(4.25, 4.75)) << "no crack in this cell";
  EXPECT_EQ(flat.part(4.25, 5.25, 1), flat.part(4.75, 5.75, 1)) << "a body that does not heed it";
}

TEST(CrackCells, ACellWithATipIsOne) {
  const Cells flat({{{{2.0, 5.5}, {6.75, 5.5}}, CrackEnd::tip}});
  EXPECT_NE(flat.part(5.5, 5.25), flat.part(5.5, 5.75));
  EXPECT_EQ(flat.part(6.25, 5.25), flat.part(6.25, 5.75));
  const Cells leaves({{{{2.0, 5.5}, {6.25, 5.5}, {6.75, 5.5}}, CrackEnd::exterior}});
  EXPECT_NE(leaves.part(6.25, 5.25), leaves.part(6.25, 5.75)) << "an exterior end is no end";
}

// A bent crack that comes back through the face by which it came in: between its arms is one side.
TEST(CrackCells, SidesFollowABend) {
  const Cells bent({{{{2.0, 5.25}, {4.5, 5.5}, {2.0, 5.75}}, CrackEnd::tip}});
  EXPECT_NE(bent.part(4.1, 5.5), bent.part(4.75, 5.5));
  EXPECT_EQ(bent.part(4.75, 5.1), bent.part(4.75, 5.9));
}

TEST(CrackCells, TwoCracksMakeFourParts) {
  const Cells cross({{{{2.0, 5.5}, {9.0, 5.5}}, CrackEnd::tip}, {{{5.5, 2.0}, {5.5, 9.0}}, CrackEnd::tip}});
  EXPECT_EQ(cross.cells->most(), 4);
  const std::vector<int> parts = {cross.part(5.25, 5.25), cross.part(5.75, 5.25), cross.part(5.25, 5.75),
                                  cross.part(5.75, 5.75)};
  EXPECT_EQ(std::vector<int>(parts), (std::vector<int>{0, 2, 1, 3}));
}

}  // namespace crack_cells_test
}  // namespace mpm
