// Particles that choose a velocity field at every node: near a crack the nodes across it are in another field than the
// others (crack/crack_fields.hpp says which).
//
// Particles of one block that choose alike form a patch. A patch spreads to and gathers from nodes of its own, a tile
// of 3^dim blocks that it shares with no other, so that the kernels know nothing of the choice; each node of the tile
// stands for a node of one of the fields. What was spread is given on to these (give), and what is to be gathered is
// taken from them before (take). Nodes are handed on patch by patch in one order: the same sums for any number of
// threads. So every shape function, transfer and pass works with a choice as it does without one.
//
// The patches have a number of their own among the fields, one more than the last; the sort puts their particles there
// (ParticleSet::far_field), by block. How they are made into patches: step/patch_sorter.hpp.
// Weak: a patch costs as much as a block, however few particles it has.
// Source: Nairn (2003), Material point method calculations with explicit cracks, CMES 4(6), 649-663, for fields that
// are chosen by pairs of particle and node.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mpm/grid/fields.hpp"
#include "mpm/math/geometry.hpp"

namespace mpm {

class NodeChoice {
 public:
  static constexpr int kEdge = 8;    ///< nodes of a tile along an axis: of the block, and two beyond it on each side
  static constexpr int kMargin = 2;  ///< number of these before the block's first
  static constexpr int kTileNodes = kEdge * kEdge;  ///< choices are made in planes alone

  /// `chosen`: the fields that particles choose from; they outlive this object.
  NodeChoice(Fields& fields, std::vector<int> chosen);

  /// The nodes of the patches; the first owner is that of the first patch.
  Grid& grid() { return grid_; }
  const Grid& grid() const { return grid_; }
  /// Number that it has among the fields.
  int number() const { return static_cast<int>(fields_.size()); }
  const std::vector<int>& chosen() const { return chosen_; }
  const Grid& field(int number) const { return *fields_[number]; }

  // By the sort.

  /// The blocks that hold particles which choose: keys ascending; `first_owner`: number of the first among all owners.
  /// The fields chosen from have these blocks and their neighbours.
  void set_blocks(std::vector<std::uint64_t> keys, int first_owner);
  /// Finds these blocks in the fields again, when their indices have changed (BlockTable::admit).
  void find_places();
  const std::vector<std::uint64_t>& blocks() const { return block_keys_; }
  /// Number of calls of set_blocks().
  std::uint64_t sorted() const { return sorted_; }

  // Functions for making patches anew, once a step.

  void clear_patches();
  /// Adds a patch in block `block` of blocks(), and returns its number. Patches follow their blocks' order.
  int add_patch(int block);
  /// The node of a patch's tile (the last axis fastest) stands for that of `field`.
  void choose(int patch, int tile_node, int field);
  /// In this step the strain of the patch's particles also feels that this node moves by so much [m]: in the last step
  /// they had another one there.
  void jump(int patch, int tile_node, const Vec2& by);
  /// Makes room for the nodes. Walls, mirrors and the least mass are those of the first field chosen from.
  void finish(int threads);
  int patches() const { return static_cast<int>(patch_blocks_.size()); }
  /// The node of `field` that a tile node in block `block` of blocks() stands for; its block is negative if the field
  /// does not have it.
  struct Node {
    int block, node;
  };
  Node node_of(int block, int tile_node, int field) const;

  /// `patches`: of each, whether it may give to a marked block of a field (one mark a block).
  void find_givers(int field, const std::vector<std::uint8_t>& marked, std::vector<std::uint8_t>& patches) const;
  /// The field that a patch has chosen at a node, given by its numbers, or -1.
  int chosen_at(int patch, const std::array<int, 3>& node) const;

  // In a step.

  /// Zeroes the patches' nodes.
  void clear(NodalField& own) const;
  /// Adds what the patches' nodes have to the nodes that they stand for.
  void give(NodalField Grid::*what);
  /// Sets the patches' nodes to what the nodes have that they stand for.
  void take(NodalField Grid::*what);
  /// Takes the velocities for a pass that updates the strain in a step of length `step` [s], with the jumps.
  void take_for_strain(double step);
  /// The same for nodes of one field, in any other nodal field. take() leaves those of other fields as they are.
  void give(const NodalField& own, int field, NodalField& to) const;
  void take(const NodalField& from, int field, NodalField& own) const;

 private:
  struct Entry {
    int own_block, block;
    std::uint8_t own_node, node;
    std::uint16_t field;
  };

  Fields& fields_;
  std::vector<int> chosen_;
  std::array<Node, kTileNodes> in_tile_;  ///< for each node of a tile: its neighbour's number, and its place there
  Grid grid_;
  std::vector<std::uint64_t> block_keys_;
  std::uint64_t sorted_ = 0;
  std::vector<int> places_;  ///< [block][field][neighbour]: index of the block in the field, or -1
  std::vector<int> patch_blocks_;
  std::vector<std::uint64_t> patch_keys_;
  std::vector<Entry> entries_;
  struct Jump {
    int own_block;
    std::uint8_t own_node;
    Vec2 by;
  };
  std::vector<Jump> jumps_;
  std::vector<std::int16_t> chosen_at_;  ///< [patch][tile node]: field, or -1
};

}  // namespace mpm
