// Choice of the velocity field that a particle has at each node near cracks (grid/node_choice.hpp), found anew in every
// step from the places of particles and chains at its start:
//
//   0   the way from particle to node crosses no crack
//   1   it crosses one, and 1 of this node has that crack and side, or none yet
//   2   it crosses one that is not that of 1
//   3   it crosses two
//
// With one crack only 0 and 1 exist. 0 of a node holds what lies on the node's own side, so above a crack is 0 at some
// nodes and 1 at others; the side of what is across stands with the node. What does not fit is put into 0 and counted.
//
// A thin tool that divides the material does so in the same way (crack/tool_cuts.hpp), and is told from cracks by its
// number.
//
// Particles choose where they lie in blocks whose tile a chain or such a tool reaches; these are found at a sort, with
// room for it to move, and a sort is asked for when it has used that up. All others spread to one field as ever. Over
// several ranks each finds the pairs of its own particles; then all agree on what the fields of a node hold, and know
// all nodes with the same bits (crack_fields_ranks.cpp).
//
// Weak: the way begins at the particle's centre, so a domain that reaches over a crack is not cut.
// Source: Nairn (2003), CMES 4(6), 649-663; crack reference 1.2, 2.1, 2.2, 2.5.
#pragma once

#include <array>
#include <vector>

#include "mpm/crack/around_point.hpp"
#include "mpm/crack/chain.hpp"
#include "mpm/crack/divided_node.hpp"
#include "mpm/crack/field_jumps.hpp"
#include "mpm/crack/line_part.hpp"
#include "mpm/crack/tool_cuts.hpp"
#include "mpm/grid/field_map.hpp"
#include "mpm/grid/node_choice.hpp"
#include "mpm/ranks/communicator.hpp"
#include "mpm/shape/kind.hpp"
#include "mpm/step/material_nodes.hpp"
#include "mpm/step/patch_sorter.hpp"
#include "mpm/step/step_context.hpp"

namespace mpm {

/// A crack in the run.
struct Crack {
  CrackDefinition definition;
  Chain chain;
  std::vector<std::uint8_t> divides;  ///< for each set, 1 if it heeds the crack
  bool felt = true;                   ///< false: its faces are joined as if it were not there
};

class CrackFields final : public SideOfCracks {
 public:
  /// All outlive this object; `choice` chooses from the fields of the sets that a crack divides. `jumps`: of pairs
  /// that growth has put into another field since the last step. `cuts`: tools that divide such sets. `ranks`: null on
  /// one process.
  CrackFields(std::vector<Crack>& cracks, std::vector<ParticleSet>& sets, NodeChoice& choice, const FieldJumps& jumps,
              const FieldMap& map, Grouping grouping, ShapeKind shape, ToolCuts cuts, int threads, Communicator* ranks);

  /// Says which particles choose, before a sort.
  void before_sort();
  /// True if a chain or a tool has come near particles that do not choose.
  bool needs_sort() const;
  /// Finds the fields of all pairs, and sorts particles into patches. Collective.
  void choose();
  /// True if nodes of the block may lie within so many cells of a chain or a tool, until the next sort.
  bool near(const std::array<int, 3>& block, double cells) const;

  /// Nodes at which something has been found across a crack, in the order of their finding; over several ranks in that
  /// of their places.
  const std::vector<DividedNode>& nodes() const { return nodes_; }
  using NodeOfField = FieldNode;
  /// visit(node, hat function) for the nodes around a place, each in the field that material at `from` has there.
  /// Without those that have nothing on that side of the cracks between them and `from`.
  template <class Visit>
  void each_node_around(int first, const Vec2& place, const Vec2& from, Visit&& visit) const {
    look_around(first, place, from);
    each_hat(choice_.grid().layout, place, [&](const std::array<int, 2>& node, double hat) {
      const NodeOfField own = find_node(first, from, node);
      if (own.ref.block >= 0) visit(own, hat);
    });
  }
  FieldNode node_of(int set, const Vec3& from, const std::array<int, 3>& node) const override;
  /// visit(field, NodeRef) for the fields of a group that have the node.
  template <class Visit>
  void each_field(int first, const std::array<int, 2>& node, Visit&& visit) const {
    const Place at = place_of_node(first, node);
    if (at.number < 0) return;
    visit(first, NodeRef{at.number, at.local});
    const int divided = node_at_[first][at.index];
    for (int f = 1; f < DividedNode::kFields && divided >= 0; ++f) {
      if (nodes_[divided].ref[f].block >= 0) visit(first + f, nodes_[divided].ref[f]);
    }
  }
  /// The node in a field; block -1: that field does not have it.
  NodeRef find_place(int field, const std::array<int, 2>& node) const;
  /// The node in the field of what is across this one crack from it.
  NodeOfField find_across(int first, int crack, const std::array<int, 2>& node) const;
  /// Number of fields that a group has, field 0 among them.
  int fields_of(int first) const { return 1 + across_[first]; }
  const Grid& patches() const { return choice_.grid(); }
  const ToolCuts& cuts() const { return cuts_; }
  /// The field 0 of every set that the crack divides, each once.
  std::vector<int> groups(int crack) const;

  /// Pairs, since the start, that fitted into none of the fields; over several ranks those of this one's particles.
  long misfits() const { return misfits_; }
  void serialise(StateArchive& archive);

 private:
  /// Nodes of a tile, a bit each: the one at row i and column j is bit kEdge i + j.
  using NodeSet = std::uint64_t;
  static_assert(NodeChoice::kTileNodes == 64);
  /// Fields that have been chosen at the nodes of a tile.
  struct Chosen {
    NodeSet nodes = 0;                                      ///< at which a field is chosen
    std::array<NodeSet, DividedNode::kFields> of_field{};   ///< each node in one of them
    NodeSet jumping = 0;                                    ///< nodes whose pairs jump, by `code`
    std::array<std::uint8_t, NodeChoice::kTileNodes> code;  ///< set only where they jump
  };
  /// Particles of one block that choose alike.
  struct Patch {
    int number, first;
    Chosen chosen;
  };
  struct Tile {
    int block;                    ///< block of NodeChoice::blocks()
    std::array<int, 3> corner;    ///< number of its first node along each axis
    std::vector<LinePart> parts;  ///< part of each crack
    bool tools = false;           ///< true if a tool that divides material may lie in it
  };

  /// A node in the first field of a group: its block's number (-1: none), its place there, and in node_at_.
  struct Place {
    int number, local;
    std::size_t index;
  };
  /// True if the crack, or the tool of that number, divides material of this group.
  bool divides(int crack, int first) const;
  /// Finds the segments of cracks between `from` and the nodes around a place, for find_node().
  void look_around(int first, const Vec2& place, const Vec2& from) const;
  NodeOfField find_node(int first, const Vec2& from, const std::array<int, 2>& node) const;
  Place place_of_node(int first, const std::array<int, 2>& node) const;
  Vec2 node_place(const std::array<int, 2>& node) const;
  /// The node at this place in the field of a group that holds what lies beyond these cracks.
  NodeOfField field_at(int first, const Place& own, const CracksBetween& between) const;
  void find_listed();
  /// Forgets the nodes, and makes room for those of the fields' blocks.
  void clear_nodes();
  bool has_room() const;
  void forget_nodes();
  /// Makes patches of this rank's particles, and adds what it finds to the nodes.
  void find_patches();
  /// Makes the nodes those of all ranks. Whether the fields of this rank's pairs are others then.
  bool share_nodes();
  int& node_at(int first, NodeRef ref) {
    return node_at_[first][static_cast<std::size_t>(ref.block) * choice_.grid().layout.nodes_per_block() + ref.node];
  }
  template <class Visit>
  void each_near_block(double margin, Visit&& visit) const;
  void find_wanted(const Tile& tile, std::size_t set, std::size_t particle);
  int find_slot(const Tile& tile, int tile_node, std::size_t set, const Vec2& particle, const Vec2& node);
  int take_slot(DividedNode& node, const CracksBetween& between, const std::array<Vec2, 2>& normals);
  /// Over several ranks: notes where the first to have this field of the node lies.
  void note_found(const DividedNode& node, int slot);
  DividedNode& divided_node(const Tile& tile, int tile_node, int first, const Vec2& place);
  int fit(const Tile& tile, int first);

  std::vector<Crack>& cracks_;
  std::vector<ParticleSet>& sets_;
  NodeChoice& choice_;
  const FieldJumps& jumps_;
  PatchSorter sorter_;
  std::vector<int> across_;                        ///< number of fields that follow each field 0
  std::vector<std::vector<std::uint8_t>> heeded_;  ///< [set][crack]
  ShapeKind shape_;
  ToolCuts cuts_;
  int threads_;
  Communicator* ranks_;
  std::vector<std::uint64_t> listed_;  ///< blocks whose particles choose
  Tile tile_;
  std::vector<LinePart> near_;                     ///< part of each crack, near a particle
  bool tools_near_ = false;                        ///< true if a tool may lie near it
  mutable std::vector<LinePart> around_;           ///< the same near a place and the nodes around it
  Chosen wanted_;                                  ///< by a particle
  std::array<Vec2, NodeChoice::kTileNodes> jump_;  ///< jumps of wanted_, set only where pairs jump [m]
  std::vector<Patch> patches_;
  std::vector<std::vector<int>> patch_of_;  ///< [set][particle that chooses]
  std::vector<DividedNode> nodes_;
  std::vector<std::vector<int>> node_at_;  ///< [field 0][node]: place in nodes_, or -1
  /// Over several ranks, of each of nodes_: the block of the particle that was the first to have field 1, 2 and 3.
  std::vector<std::array<std::uint64_t, 3>> found_in_;
  long misfits_ = 0;
};

}  // namespace mpm
