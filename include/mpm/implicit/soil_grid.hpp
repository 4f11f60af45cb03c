// The grid as sweeps of the implicit step need it: which blocks lie above a block, which thread sweeps which blocks in
// which order, and which nodes a wall holds along which axes. It changes with the blocks in use, when particles are
// sorted.
//
// A node is numbered block * nodes_per_block + node, as in NodalField. After them each block has a number that stands
// for no node, one each, since blocks that are swept at once write there. Every block in use is swept, so that its
// number among the blocks that are swept is its number in the grid.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mpm/boundary/wall_definition.hpp"
#include "mpm/grid/nodal_fields.hpp"

namespace mpm {

class SoilGrid {
 public:
  static constexpr std::uint8_t kFree = 255, kAtRest = 6, kPrescribed = 7;  ///< in place of the number of a wall
  static constexpr std::uint8_t kAxis = 0;  ///< that of the wall which an axis takes the place of

  /// `walls`: of the domain's faces, in the order of kWallNames. `rings`: cells are sections of rings; where their grid
  /// begins at r = 0 nothing moves along r there.
  SoilGrid(const Grid& grid, const std::array<WallDefinition, 6>& walls, bool rings, int threads);

  /// Looks again at the blocks, and at what conditions prescribe, if they have changed. Returns true if blocks have.
  bool rebuild();

  const Grid& grid() const { return grid_; }
  bool rings() const { return rings_; }
  /// True if the grid begins at an axis of symmetry.
  bool axis() const { return rings_ && grid_.layout.origin(0) == 0.0; }
  int nodes() const { return grid_.blocks.size() * grid_.layout.nodes_per_block(); }
  /// With those that stand for none.
  int numbers() const { return nodes() + grid_.blocks.size(); }
  int no_node(int block) const { return nodes() + block; }
  /// Number of the node above a block's node by the bits of `corner` along the grid's axes; no_node() if there is none.
  int corner(int block, const std::array<int, 3>& local, int corner) const;
  /// Block and number along each axis inside it of the node at `at`, numbers along the grid's axes from the domain's
  /// first node on; false where no block is in use.
  bool find(const std::array<int, 3>& at, int& block, std::array<int, 3>& local) const;
  /// The wall that holds a node along a world axis, in the order of kWallNames; kAxis where that is the axis, kAtRest
  /// where what is asleep beside it holds it, kPrescribed where a condition gives it its velocity, or kFree.
  std::uint8_t holder(int node, int axis) const { return holders_[3 * static_cast<std::size_t>(node) + axis]; }
  bool held(int node) const {
    const std::uint8_t* own = &holders_[3 * static_cast<std::size_t>(node)];
    return own[0] != kFree || own[1] != kFree || own[2] != kFree;
  }
  /// A node on a wall with friction.
  struct WallNode {
    int block, node, wall;  ///< node: number among all
  };
  /// By block.
  const std::vector<WallNode>& frictional() const { return frictional_; }

  const BlockShares& shares() const { return shares_; }
  /// Blocks of one of 2^dim colours, which share no node with each other; sweeps take the colours in this order.
  const std::vector<int>& blocks_of_colour(int colour) const { return swept_.owners_of_colour(colour); }
  /// True if test(block) is for a block or one of those around it.
  template <class Test>
  bool any_around(int block, Test&& test) const {
    const int count = neighbours();
    for (const int *at = &around_[static_cast<std::size_t>(count) * block], *end = at + count; at != end; ++at) {
      if (*at >= 0 && test(*at)) return true;
    }
    return false;
  }

 private:
  int neighbours() const { return grid_.layout.dim() == 3 ? 27 : 9; }
  void find_around();
  void find_held();

  const Grid& grid_;
  std::array<WallDefinition, 6> walls_;
  bool rings_;
  int threads_;
  std::uint64_t generation_ = 0;
  std::vector<Grid::Prescribed> prescribed_;  ///< those that holders_ were found with
  /// One block more at the lower ends, so that blocks beyond walls have neighbours, too; periodic axes as they are.
  GridLayout wider_;
  BlockTable swept_;  ///< the blocks of the grid as owners
  BlockShares shares_;
  std::vector<int> around_;  ///< [block][3^dim]: the blocks around it and itself, the last axis fastest, or -1
  std::vector<std::uint8_t> holders_;
  std::vector<WallNode> frictional_;
  std::vector<std::uint64_t> keys_;
  std::vector<std::uint32_t> work_;
};

}  // namespace mpm
