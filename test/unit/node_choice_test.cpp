// Patches of particles that choose a velocity field at every node (grid/node_choice.hpp): which nodes stand for which,
// and what is handed to and fro.
#include "mpm/grid/node_choice.hpp"

#include <gtest/gtest.h>

#include "mpm/grid/field_map.hpp"

namespace node_choice_test {

using namespace mpm;

constexpr std::uint64_t kNodesOfBlock = 16;

/// Two fields of a plane of 16 x 16 cells, each with material in one block.
struct TwoFields {
  TwoFields() : fields(make_fields(GridLayout(2, Vec3::Constant(0.1), Vec3::Zero(), Vec3(1.6, 0.0, 1.6)), 2)) {
    key = fields[0]->layout.key({1, 2, 0});
    for (auto& field : fields) field->rebuild({key});
  }
  Fields fields;
  std::uint64_t key = 0;
};

/// Number of a node in the tile of block (1, 2).
int tile_node(int i, int k) { return (i - 2) * NodeChoice::kEdge + k - 6; }

TEST(NodeChoice, NodesStandForThoseOfTheChosenField) {
  TwoFields two;
  NodeChoice choice(two.fields, {0, 1});
  EXPECT_EQ(choice.number(), 2);
  choice.set_blocks({two.key}, 2);
  const int patch = choice.add_patch(0);
  choice.choose(patch, tile_node(4, 9), 0);   // in the block itself
  choice.choose(patch, tile_node(3, 12), 1);  // in the neighbour at low x and high z
  choice.finish(1);
  EXPECT_EQ(choice.grid().blocks.owners(), 1);
  EXPECT_EQ(choice.chosen_at(patch, {4, 9, 0}), 0);
  EXPECT_EQ(choice.chosen_at(patch, {3, 12, 0}), 1);
  EXPECT_EQ(choice.chosen_at(patch, {4, 8, 0}), -1);
  EXPECT_EQ(choice.chosen_at(patch, {99, 8, 0}), -1);

  for (auto& field : two.fields) std::fill_n(field->velocity.data(), field->blocks.size() * 2 * kNodesOfBlock, 0.0);
  const auto at = [&](int field, std::array<int, 3> block, int local, int component) -> double& {
    Grid& grid = *two.fields[field];
    return grid.velocity.at(grid.blocks.find(grid.layout.key(block)), component, local);
  };
  at(0, {1, 2, 0}, 0 * 4 + 1, 0) = 3.0;
  at(1, {0, 3, 0}, 3 * 4 + 0, 1) = 5.0;
  choice.take(&Grid::velocity);
  // Neighbours of an owner have the last axis fastest; 4 is the middle, 2 is low x and high z.
  EXPECT_EQ(choice.grid().velocity.at(choice.grid().blocks.neighbours(0)[4], 0, 1), 3.0);
  EXPECT_EQ(choice.grid().velocity.at(choice.grid().blocks.neighbours(0)[2], 1, 12), 5.0);

  choice.grid().velocity.at(choice.grid().blocks.neighbours(0)[4], 0, 1) = 0.25;
  choice.give(&Grid::velocity);
  EXPECT_EQ(at(0, {1, 2, 0}, 1, 0), 3.25);
  EXPECT_EQ(at(1, {0, 3, 0}, 12, 1), 10.0);
}

// Patches share no node: two of one block may choose differently at the same place.
TEST(NodeChoice, TwoPatchesOfABlockAddUp) {
  TwoFields two;
  NodeChoice choice(two.fields, {0, 1});
  choice.set_blocks({two.key}, 2);
  for (const int field : {0, 1, 1}) choice.choose(choice.add_patch(0), tile_node(5, 10), field);
  choice.finish(1);
  for (auto& field : two.fields) std::fill_n(field->mass.data(), field->blocks.size() * kNodesOfBlock, 0.0);
  const int local = 1 * 4 + 2;
  for (int patch = 0; patch < 3; ++patch) {
    choice.grid().mass.at(choice.grid().blocks.owner_block(patch), 0, local) = 1.0 + patch;
  }
  choice.give(&Grid::mass);
  const auto mass = [&](int field) {
    const Grid& grid = *two.fields[field];
    return grid.mass.at(grid.blocks.find(two.key), 0, local);
  };
  EXPECT_EQ(mass(0), 1.0);
  EXPECT_EQ(mass(1), 5.0);
}

// Bodies 0 and 2 share a group; a crack divides body 2 alone, several meet in body 1.
TEST(FieldMap, FieldsAcrossCracksFollowTheFirst) {
  const FieldMap map({0, 1, 0}, {false, false, false}, {0, 3, 1});
  EXPECT_EQ(map.count(), 6);
  EXPECT_EQ(map.fields(0), std::vector<int>({0}));
  EXPECT_EQ(map.fields(2), std::vector<int>({0, 1}));
  EXPECT_EQ(map.fields(1), std::vector<int>({2, 3, 4, 5}));
  EXPECT_EQ(map.chosen(), std::vector<int>({0, 1, 2, 3, 4, 5}));
  EXPECT_TRUE(FieldMap({0}, {false}).chosen().empty());
}

}  // namespace node_choice_test
