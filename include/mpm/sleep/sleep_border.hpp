// The nodes between material that is awake and blocks that are asleep. What is asleep does not move, so they are held
// at rest. By how much the force of both sides and their weight fail to balance there, and how fast the material awake
// comes in, says which blocks have to wake.
//
// A force without balance is told as the speed of a plane wave that would bring it: |f| / (m c / h), with m c / h the
// wave's impedance over the area of a node [m/s].
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mpm/grid/fields.hpp"
#include "mpm/sleep/sleeping_blocks.hpp"
#include "mpm/step/step_context.hpp"

namespace mpm {

class SleepBorder {
 public:
  struct Node {
    NodeRef ref;
    double mass = 0.0;          ///< of what is asleep [kg]
    Vec3 force = Vec3::Zero();  ///< internal, of what is asleep [N]
    double rate = 0.0;          ///< by which a wave would cross a cell [1/s]
    std::uint32_t from = 0;     ///< a bit for each block around that is asleep and reaches the node
    bool at_wall = false;       ///< a wall holds it too, with a force that is not known here
  };

  explicit SleepBorder(const GridLayout& layout);

  /// Of a velocity field, as particles are sorted now.
  void find(int field, const Grid& grid, const SleepingBlocks& asleep);
  const std::vector<Node>& nodes() const { return nodes_; }
  /// Adds the names of the blocks asleep that reach a node.
  void add_names(const Node& node, const Grid& grid, std::vector<BlockName>& names) const;
  /// What fails to balance at a node, once the forces are gathered, or the speed of what comes in: the larger [m/s].
  static double unrest(const Node& node, const Grid& grid, const Vec3& gravity);

 private:
  /// A node of a block in the tile of a block beside it.
  struct Shared {
    int node, of_tile;
  };

  std::uint64_t key_beside(const std::array<int, 3>& block, int side) const;
  void add_block(int block, const Grid& grid);

  const GridLayout* layout_;
  int field_ = 0;
  int sides_ = 0;                               ///< 3^dim: the blocks around one, itself in the middle
  std::array<std::vector<Shared>, 27> shared_;  ///< with the block on each side
  std::vector<const SleepingBlock*> around_;    ///< on each side
  std::vector<Node> of_block_, nodes_;
};

}  // namespace mpm
