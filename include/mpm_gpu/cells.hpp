// The order of particles and the table of blocks, found anew when a particle has left its cell: the cell of a particle
// is that around its nearest node. Sorted keys are the table: a block's number is its place among them, and its
// neighbours are looked up once. Everything is made of loops over indices, scans and stable sorts.
#pragma once

#include <vector>

#include "mpm_gpu/error.hpp"
#include "mpm_gpu/executor.hpp"
#include "mpm_gpu/views.hpp"

namespace mpm_gpu {

class CellTable {
 public:
  CellTable(const GridView& grid, int dim);

  /// Places of particles [m], and their ids.
  struct Places {
    const double* x[3];
    const std::uint32_t* id;
    /// Number of each id among those of all sets, in their order; null where a set's ids have no gap.
    const std::uint32_t* number = nullptr;
  };

  /// Makes room for so many particles, and for twice as many blocks as hold particles now. Between steps only.
  void make_room(Executor& run, const Places& places, const std::vector<SetView>& sets);
  /// Finds the order in which the particles are to lie, by cells and in a cell by ids, whatever it was before: particle
  /// i is to be the one that lies at order()[i] now. Sets stay where they are. Then the table of blocks. @throws
  /// GpuError when there is no room for the blocks
  void sort(Executor& run, const Places& places, const std::vector<SetView>& sets);
  const std::uint32_t* order() const { return order_.data(); }
  /// Number of each particle's nearest node, by the new order.
  const std::uint32_t* node_of_particles() const { return node_.data(); }
  /// The table; nodal fields are not in it.
  NodeView view() const;
  long blocks() const { return blocks_; }
  /// Number of nodes for which there is room.
  long room() const { return room_ * per_block_; }
  std::size_t bytes() const;

 private:
  /// Keys in the order of ids, so that a stable sort leaves those of a cell in it.
  void find_keys(Executor& run, const Places& places, const std::vector<SetView>& sets);
  /// Sorts the keys and returns how many blocks hold particles, those of each set for themselves.
  long find_owners(Executor& run);
  void find_blocks(Executor& run, long owners);
  void find_ranges(Executor& run, int sets);

  GridView grid_;
  int dim_, around_;
  std::uint64_t per_block_, block_keys_;
  long particles_ = 0, owners_room_ = 0, room_ = 0, blocks_ = 0;
  int sets_ = 0;
  Buffer<std::uint64_t> key_, other_key_;  ///< keys of particles, then of blocks around owners
  Buffer<std::uint32_t> order_, other_order_, flag_, node_;
  Buffer<std::uint64_t> cell_key_, owner_, block_;
  Buffer<std::uint32_t> begin_, end_;
  Buffer<std::int32_t> neighbours_;
};

}  // namespace mpm_gpu
