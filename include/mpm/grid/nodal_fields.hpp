// The nodal fields that every scene has. Each is one array, block after block, and within a block component after
// component: [block][component][node].
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mpm/grid/block_shares.hpp"

namespace mpm {

/// A node, by its block and its index in that block.
struct NodeRef {
  int block;
  int node;
  bool operator==(const NodeRef& other) const { return block == other.block && node == other.node; }
};

class NodalField {
 public:
  NodalField(int components, int nodes_per_block) : components_(components), nodes_(nodes_per_block) {}

  int components() const { return components_; }
  int nodes_per_block() const { return nodes_; }
  /// Does not preserve the contents. When there is too little room it allocates a few blocks more than needed, since
  /// moving material takes new blocks a few at a time.
  void resize(int blocks) {
    const std::size_t size = static_cast<std::size_t>(blocks) * components_ * nodes_;
    if (size > data_.capacity()) {
      data_ = std::vector<double>();
      data_.reserve(size + size / 16);
    }
    data_.resize(size);
  }
  std::size_t size() const { return data_.size(); }
  double* data() { return data_.data(); }
  double* block(int b) { return data_.data() + static_cast<std::size_t>(b) * components_ * nodes_; }
  const double* block(int b) const { return data_.data() + static_cast<std::size_t>(b) * components_ * nodes_; }
  double& at(int b, int component, int node) { return block(b)[component * nodes_ + node]; }
  double at(int b, int component, int node) const { return block(b)[component * nodes_ + node]; }

 private:
  int components_, nodes_;
  std::vector<double> data_;
};

/// The grid of one velocity field (grid/fields.hpp) during a step.
struct Grid {
  explicit Grid(const GridLayout& grid_layout)
      : layout(grid_layout),
        blocks(layout),
        mass(1, layout.nodes_per_block()),
        momentum(layout.dim(), layout.nodes_per_block()),
        velocity(layout.dim(), layout.nodes_per_block()),
        force(layout.dim(), layout.nodes_per_block()),
        increment(layout.dim(), layout.nodes_per_block()),
        place(layout.dim(), layout.nodes_per_block()) {}
  Grid(const Grid&) = delete;
  Grid& operator=(const Grid&) = delete;

  /// Takes the blocks in use from the sorted particles, shares them out and makes room for their nodes. `particles`: of
  /// each owner; when empty, all owners count alike.
  void rebuild(const std::vector<std::uint64_t>& owner_keys, int threads = 1,
               const std::vector<std::uint32_t>& particles = {}) {
    blocks.rebuild(owner_keys, threads);
    shares.rebuild(blocks, particles, threads);
    for (NodalField* field : {&mass, &momentum, &velocity, &force}) field->resize(blocks.size());
    loose.assign(blocks.owners(), 0);
    elsewhere.clear();
  }

  /// Adds blocks that other ranks give to (ranks/halo.hpp), ascending and unique, after rebuild().
  void admit(const std::vector<std::uint64_t>& guests) {
    blocks.admit(guests);
    for (NodalField* field : {&mass, &momentum, &velocity, &force}) field->resize(blocks.size());
  }

  /// True if sums over nodes count those of this block here: over several ranks each node counts on one of them.
  bool counts(int block) const { return elsewhere.empty() || elsewhere[block] == 0; }

  /// True if the node takes part in the step. Nodes lighter than least_mass are left out: a particle that reaches a
  /// node with 1e-30 of its mass reaches it with 1e-15 of its force, the order of the last bit.
  bool carries(int block, int node) const { return mass.at(block, 0, node) > least_mass; }

  /// The grid axes across which a node, given by its numbers, has material on one side only, because it lies on a
  /// mirror or beyond it.
  std::array<bool, 3> mirrored(const std::array<int, 3>& node) const {
    std::array<bool, 3> across{};
    for (int k = 0; k < layout.dim(); ++k) {
      across[k] = (mirrors[2 * k] && node[k] <= 0) || (mirrors[2 * k + 1] && node[k] >= layout.last_node(k));
    }
    return across;
  }

  GridLayout layout;
  BlockTable blocks;
  BlockShares shares;
  double least_mass = 0.0;  ///< [kg]
  int wall_layers = 1;      ///< layers of nodes beyond a wall that particles may reach, which the wall constrains too
  std::array<bool, 6> has_wall{};  ///< faces of the domain that are walls: 2 * axis, + 1 for the upper one
  /// Faces at which the domain ends in its own mirror image, numbered as in has_wall: walls, and r = 0.
  std::array<bool, 6> mirrors{};
  int first_owner = 0;  ///< number of its first owner among the owners of all fields
  /// Per owner: whether some of its particles have moved beyond the block since they were sorted.
  std::vector<std::uint8_t> loose;
  /// Per block: whether it counts on another rank; empty where there is none.
  std::vector<std::uint8_t> elsewhere;
  /// Nodes that material asleep beside them holds at rest (sleep/sleep_border.hpp).
  std::vector<NodeRef> at_rest;
  /// Share of what is asleep in such a node, where volume changes are averaged over the grid (kernel/mean.hpp).
  struct MeanAtRest {
    NodeRef node;
    double mass;    ///< [kg]
    double stress;  ///< sum of m S times the mean stress over the initial density [J]
  };
  std::vector<MeanAtRest> means_at_rest;
  /// A component of a node's velocity, along a world axis, that a condition prescribes.
  struct Prescribed {
    NodeRef node;
    int axis;
    bool operator==(const Prescribed& other) const { return node == other.node && axis == other.axis; }
  };
  /// All of them in this step, for implicit steps, which find the others with these (boundary/condition.hpp).
  std::vector<Prescribed> prescribed;
  NodalField mass;       ///< m_i [kg]
  NodalField momentum;   ///< p_i as gathered, before conditions; valid until XPIC or the next gathering uses it [N s]
  NodalField velocity;   ///< with conditions: v_i^n while strain is updated, then v_i^{n+1} [m/s]
  NodalField force;      ///< f_i while forces are gathered [N], then the acceleration a_i [m/s^2]
  NodalField increment;  ///< terms of the velocity that particles adopt, where they have any; else empty [m/s]
  NodalField place;      ///< near thin tools: sum of m S x, mass times centre of mass; else empty [kg m]
};

}  // namespace mpm
