// The blocked grid: numbering, neighbours, colours.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "mpm/grid/nodal_fields.hpp"
#include "mpm/math/lanes.hpp"

namespace grid_test {

using mpm::GridLayout;
using mpm::Vec3;
using mpm::whole_power;

TEST(GridLayout, NumbersBlocksBothWays) {
  const GridLayout layout(3, {0.1, 0.1, 0.1}, {0, 0, 0}, {1.0, 2.0, 3.0});
  std::set<std::uint64_t> keys;
  for (int x = -1; x <= 10 / 4 + 1; ++x) {
    for (int y = -1; y <= 20 / 4 + 1; ++y) {
      for (int z = -1; z <= 30 / 4 + 1; ++z) {
        const std::uint64_t key = layout.key({x, y, z});
        EXPECT_TRUE(keys.insert(key).second);
        EXPECT_EQ(layout.block(key), (std::array<int, 3>{x, y, z}));
      }
    }
  }
}

TEST(GridLayout, PlanarAxesAreXAndZ) {
  const GridLayout layout(2, {0.1, 9.0, 0.5}, {1.0, -7.0, 2.0}, {3.0, 7.0, 6.0});
  EXPECT_EQ(layout.last_node(0), 20);
  EXPECT_EQ(layout.last_node(1), 8);
  const mpm::Vec3 position = layout.node_position({1, 1}, 4 * 2 + 3);  // node (6, 7)
  EXPECT_TRUE(position.isApprox(mpm::Vec3(1.6, 0.0, 5.5), 1e-14));
}

TEST(GridLayout, ALinesAxisIsX) {
  const GridLayout layout(1, {0.1, 9.0, 0.5}, {1.0, -7.0, 2.0}, {3.0, 7.0, 6.0});
  EXPECT_EQ(layout.axis(0), 0);
  EXPECT_EQ(layout.nodes_per_block(), 4);
  EXPECT_EQ(layout.last_node(0), 20);
  EXPECT_EQ(layout.smallest_cell(), 0.1);
  EXPECT_EQ(layout.node({2}, 3)[0], 11);
  EXPECT_TRUE(layout.node_position({2}, 3).isApprox(mpm::Vec3(2.1, 0.0, 0.0), 1e-14));
  for (int block = -1; block <= 20 / 4 + 1; ++block) EXPECT_EQ(layout.block(layout.key({block}))[0], block);
}

TEST(BlockTable, OfALineHasTwoColoursAndThreeNeighbours) {
  const GridLayout layout(1, {1, 1, 1}, {0, 0, 0}, {40, 1, 1});
  mpm::BlockTable table(layout);
  table.rebuild({layout.key({2}), layout.key({3}), layout.key({6})});
  EXPECT_EQ(table.size(), 7);  // blocks 1 to 7
  EXPECT_EQ(table.colours(), 2);
  EXPECT_EQ(table.owners_of_colour(0), (std::vector<int>{0, 2}));
  EXPECT_EQ(table.owners_of_colour(1), (std::vector<int>{1}));
  for (int owner = 0; owner < table.owners(); ++owner) {
    const int* near = table.neighbours(owner);
    for (int s = 0; s < 3; ++s) EXPECT_EQ(table.block(near[s])[0], table.block(table.owner_block(owner))[0] + s - 1);
  }
}

TEST(GridLayout, RefusesWhatCannotBe) {
  EXPECT_THROW(GridLayout(3, {0.0, 0.1, 0.1}, {0, 0, 0}, {1, 1, 1}), mpm::GridError);
  EXPECT_THROW(GridLayout(3, {0.1, 0.1, 0.1}, {0, 0, 0}, {1, 1, 0.01}), mpm::GridError);
  EXPECT_THROW(GridLayout(3, {1e-7, 1e-7, 1e-7}, {0, 0, 0}, {90, 90, 90}), mpm::GridError);
}

TEST(BlockTable, KnowsNeighboursAndKeepsColoursApart) {
  const GridLayout layout(3, {1, 1, 1}, {0, 0, 0}, {40, 40, 40});
  std::vector<std::uint64_t> owners;
  for (int x = 0; x < 4; ++x) {
    for (int y = 2; y < 5; ++y) {
      for (int z = 0; z < 3; ++z) owners.push_back(layout.key({x, y, z}));
    }
  }
  mpm::BlockTable table(layout);
  table.rebuild(owners);
  EXPECT_EQ(table.owners(), 4 * 3 * 3);
  EXPECT_EQ(table.size(), 6 * 5 * 5);
  int seen = 0;
  for (int colour = 0; colour < 8; ++colour) {
    const auto& list = table.owners_of_colour(colour);
    seen += static_cast<int>(list.size());
    for (const int a : list) {
      for (int s = 0; s < 27; ++s) {
        const auto& block = table.block(table.owner_block(a));
        const auto& neighbour = table.block(table.neighbours(a)[s]);
        EXPECT_EQ(neighbour[0] - block[0], s / 9 - 1);
        EXPECT_EQ(neighbour[1] - block[1], s / 3 % 3 - 1);
        EXPECT_EQ(neighbour[2] - block[2], s % 3 - 1);
      }
      for (const int b : list) {
        if (a == b) continue;
        int apart = 0;
        for (int k = 0; k < 3; ++k) {
          apart =
              std::max(apart, std::abs(table.block(table.owner_block(a))[k] - table.block(table.owner_block(b))[k]));
        }
        EXPECT_GE(apart, 2);
      }
    }
  }
  EXPECT_EQ(seen, table.owners());
}

// By definition the blocks in use are the owners' neighbours, each once and in the order of their keys.
TEST(BlockTable, HoldsTheNeighboursOfAnyOwners) {
  for (const int dim : {1, 2, 3}) {
    const GridLayout layout(dim, {1, 1, 1}, {0, 0, 0}, Vec3::Constant(dim == 1 ? 2400 : 60));
    std::mt19937 engine(2);
    mpm::BlockTable table(layout);
    for (const std::size_t count : {1, 5, 40, 300, 12}) {
      std::set<std::uint64_t> owners, blocks;
      for (std::size_t i = 0; i < count; ++i) {
        std::array<int, 3> block{};
        for (int k = 0; k < dim; ++k) block[k] = static_cast<int>(engine() % (dim == 1 ? 600 : 16));
        owners.insert(layout.key(block));
      }
      const int span = whole_power(3, dim);
      const auto neighbour = [&](std::uint64_t owner, int s) {
        std::array<int, 3> block = layout.block(owner);
        for (int k = dim - 1; k >= 0; --k, s /= 3) block[k] += s % 3 - 1;
        return layout.key(block);
      };
      for (const std::uint64_t owner : owners) {
        for (int s = 0; s < span; ++s) blocks.insert(neighbour(owner, s));
      }
      table.rebuild({owners.begin(), owners.end()}, 3);
      ASSERT_EQ(static_cast<std::size_t>(table.size()), blocks.size());
      int index = 0;
      for (const std::uint64_t key : blocks) {
        EXPECT_EQ(table.key(index), key);
        EXPECT_EQ(table.block(index), layout.block(key));
        EXPECT_EQ(table.find(key), index++);
      }
      int o = 0;
      for (const std::uint64_t owner : owners) {
        EXPECT_EQ(table.key(table.owner_block(o)), owner);
        for (int s = 0; s < span; ++s) EXPECT_EQ(table.key(table.neighbours(o)[s]), neighbour(owner, s));
        ++o;
      }
    }
  }
}

}  // namespace grid_test
