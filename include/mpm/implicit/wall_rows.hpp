// Walls of the domain in an implicit step. Where a wall always holds nodes (fixed, slip, symmetry) sweeps never move
// them; what it takes is found afterwards from the balance of each node. A wall with friction is a row of Coulomb's law
// at each of its nodes, whose impulse begins the next step's solve, less where the node has become lighter.
//
// Weak: friction acts along axes that no other wall holds, with the normal impulse of its own wall alone.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mpm/implicit/held_impulses.hpp"
#include "mpm/implicit/soil_grid.hpp"
#include "mpm/kernel/soil_cells.hpp"
#include "mpm/math/state_archive.hpp"
#include "mpm/step/module.hpp"

namespace mpm {

template <class T>
class WallRows {
 public:
  using Row = mpm_kernel::WallRow<T>;
  using Node = mpm_kernel::SoilNode<T>;
  using Impulses = HeldImpulses::OfWalls;

  WallRows(const std::array<WallDefinition, 6>& walls, const SoilGrid& grid);

  /// Finds the rows of nodes that carry material, with the impulses that they begin with, and gives these to the nodes.
  void find(std::vector<Node>& nodes, double dt);
  /// Forgets the rows of the last step; blocks have none until find().
  void clear() {
    rows_.clear();
    begin_.assign(grid_.grid().blocks.size() + 1, 0);
  }
  Row* rows(int block) { return rows_.data() + begin_[block]; }
  int count(int block) const { return begin_[block + 1] - begin_[block]; }
  /// Number of the rows of all blocks, which follow each other.
  int count() const { return begin_.back(); }
  /// Books the impulses of rows, with the nodes as they are now, and those of nodes that are held; keeps the rows' for
  /// the next step.
  void finish(const std::vector<Node>& nodes, const Impulses& of_held, double dt);

  void accounts(std::vector<ImpulseAccount>& list) const;
  void energies(EnergyReport& report) const;
  void serialise(StateArchive& archive);

 private:
  /// A row of the last step.
  struct Kept {
    std::uint64_t id;  ///< id of its node, and wall
    double own;        ///< 1 / mass of the node [1/kg]
    Vec3 force;        ///< [N]
  };
  std::uint64_t id_of(const SoilGrid::WallNode& node) const;

  std::array<WallDefinition, 6> walls_;
  const SoilGrid& grid_;
  std::vector<Row> rows_;
  std::vector<int> wall_of_, begin_;
  std::vector<std::uint64_t> ids_;
  std::vector<Kept> kept_;
  std::array<ImpulseAccount, 6> accounts_;
  double friction_ = 0.0, loss_ = 0.0;  ///< [J]
};

}  // namespace mpm
