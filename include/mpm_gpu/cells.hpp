// The order of particles and the table of blocks, found anew when a particle has left its cell: the cell of a particle
// is that around its nearest node. Sorted keys are the table: a block's number is its place among them, and its
// neighbours are looked up once. Everything is made of loops over indices, scans and stable sorts.
//
// How many blocks there are only the device knows. The host waits for the number and hands out no more work than is
// needed; or it does not wait, and the table has all the blocks for which there is room, of which some are empty.
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
  /// Ways in which the number of blocks gets to the host.
  enum class Counts { waits_for, room_for_all };
  /// Finds the order in which the particles are to lie, by cells and in a cell by ids, whatever it was before: particle
  /// i is to be the one that lies at order()[i] now. Sets stay where they are. Then the table of blocks. @throws
  /// GpuError when there is no room for the blocks, if it waits for their number
  void sort(Executor& run, const Places& places, const std::vector<SetView>& sets, Counts counts);
  /// Numbers of the blocks that hold particles, those of each set for themselves, and of all; where it does not wait.
  const std::uint32_t* counts() const { return counts_.data(); }
  /// Largest numbers for which there is room.
  long owners_room() const { return owners_room_; }
  long blocks_room() const { return room_; }
  /// @throws GpuError when there is no room for so many
  void require_room(long owners, long blocks) const;
  const std::uint32_t* order() const { return order_.data(); }
  /// Number of each particle's nearest node, by the new order.
  const std::uint32_t* node_of_particles() const { return node_.data(); }
  /// The table; nodal fields are not in it.
  NodeView view() const;
  long blocks() const { return blocks_; }
  /// Number of nodes for which there is room.
  long room() const { return room_ * static_cast<long>(per_block_); }
  /// Grows whenever the room does, and with it all addresses of the table.
  long generation() const { return generation_; }
  std::size_t bytes() const;

 private:
  /// Keys in the order of ids, so that a stable sort leaves those of a cell in it.
  void find_keys(Executor& run, const Places& places, const std::vector<SetView>& sets);
  /// Sorts the keys, and numbers the blocks that hold particles, those of each set for themselves.
  void find_owners(Executor& run);
  void find_blocks(Executor& run, long owners, Counts counts);
  void find_ranges(Executor& run, int sets);

  GridView grid_;
  int dim_, around_;
  std::uint64_t per_block_, block_keys_;
  long particles_ = 0, owners_room_ = 0, room_ = 0, blocks_ = 0, generation_ = 0;
  int sets_ = 0;
  Buffer<std::uint64_t> key_, other_key_;  ///< keys of particles, then of blocks around owners
  Buffer<std::uint32_t> order_, other_order_, flag_, node_;
  Buffer<std::uint64_t> cell_key_, owner_, block_;
  Buffer<std::uint32_t> begin_, end_;
  Buffer<std::int32_t> neighbours_;
  Buffer<std::uint32_t> counts_;  ///< number of owners, and of blocks
};

}  // namespace mpm_gpu
