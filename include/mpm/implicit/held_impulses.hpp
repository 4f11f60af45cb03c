// Impulses that a step gives to the components of velocity that are held. A wall takes them in total; material asleep
// beside a node, or a condition that prescribes its velocity, takes them from the node (sleep/sleep.hpp,
// boundary/condition.hpp), by the velocity that it would have had.
#pragma once

#include <array>

#include "mpm/implicit/soil_grid.hpp"

namespace mpm {

class HeldImpulses {
 public:
  /// Impulses of walls by name, as in kWallNames, and axis [N s].
  using OfWalls = std::array<std::array<double, 3>, 6>;

  /// `grid` outlives it. Nodes that are at rest or prescribed keep theirs in its field of forces.
  explicit HeldImpulses(Grid& grid) : grid_(grid) {}

  /// Forgets those of the step before.
  void clear() {
    walls_ = {};
    for (const NodeRef& node : grid_.at_rest) forget(node);
    for (const Grid::Prescribed& one : grid_.prescribed) forget(one.node);
  }
  /// `impulse` [N s] is given to a node's component along a world axis, which `holder` holds (SoilGrid::holder()).
  void add(int node, int axis, std::uint8_t holder, double impulse) {
    if (holder < SoilGrid::kAtRest) {
      walls_[holder][axis] += impulse;
      return;
    }
    const int per_block = grid_.layout.nodes_per_block();
    for (int k = 0; k < grid_.layout.dim(); ++k) {
      if (grid_.layout.axis(k) == axis) grid_.force.at(node / per_block, k, node % per_block) += impulse;
    }
  }
  /// Impulses of all nodes, of walls.
  void add(const double (&walls)[6][3]) {
    for (std::size_t w = 0; w < 6; ++w) {
      for (std::size_t a = 0; a < 3; ++a) walls_[w][a] += walls[w][a];
    }
  }
  const OfWalls& walls() const { return walls_; }

 private:
  void forget(const NodeRef& node) {
    for (int k = 0; k < grid_.layout.dim(); ++k) grid_.force.at(node.block, k, node.node) = 0.0;
  }

  Grid& grid_;
  OfWalls walls_{};
};

}  // namespace mpm
