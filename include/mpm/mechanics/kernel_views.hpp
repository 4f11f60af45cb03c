// Arguments of the kernels (kernel/kernels.hpp): views of the grid, of the sets of particles and of the block at
// work. In every pass a thread has the same part of space (grid/block_shares.hpp), whose nodes and particles stay in
// its core's cache: handed out one by one, two threads took as long as one in a plane.
#pragma once

#include <cstdint>
#include <vector>

#include "mpm/grid/each_share.hpp"
#include "mpm/grid/nodal_fields.hpp"
#include "mpm/kernel/kernels.hpp"
#include "mpm/material/law.hpp"
#include "mpm/particles/particle_set.hpp"

namespace mpm {

static_assert(mpm_kernel::kTileEdge == kBlockEdge + 2 * mpm_kernel::kTileMargin);

mpm_kernel::GridView view_of(Grid& grid);

/// For passes that ask for no law. T is the precision of the set; `kernels`: those at work; `first_owner`: of the field
/// at work (Grid::first_owner).
template <class T>
mpm_kernel::SetView<T> view_of(ParticleSet& set, const mpm_kernel::KernelTable<T>& kernels, int first_owner = 0);
/// `law` outlives the view.
template <class T>
mpm_kernel::SetView<T> view_of(ParticleSet& set, const Law& law, const mpm_kernel::KernelTable<T>& kernels,
                               int first_owner = 0);

inline mpm_kernel::BlockView view_of(const Grid& grid, int owner) {
  const BlockTable& blocks = grid.blocks;
  mpm_kernel::BlockView block{owner, blocks.neighbours(owner), {}, grid.loose[owner] != 0};
  for (int k = 0; k < grid.layout.dim(); ++k) {
    block.corner[k] = blocks.block(blocks.owner_block(owner))[k] * kBlockEdge - mpm_kernel::kTileMargin;
  }
  return block;
}

/// `owners`: of each, whether its particles may give to a block that is marked (one mark a block).
void find_givers(const Grid& grid, const std::vector<std::uint8_t>& marked, std::vector<std::uint8_t>& owners);

/// pass(block) for every block that holds particles: for what writes to no node.
template <class Pass>
void each_owner_at_once(const char* name, const Grid& grid, int threads, Pass&& pass) {
  grid.shares.at_once(name, threads, [&](int owner) { pass(view_of(grid, owner)); });
}

/// pass(block) for every block that holds particles, at a node a colour after the other.
template <class Pass>
void each_owner(const char* name, const Grid& grid, int threads, Pass&& pass) {
  grid.shares.by_colour(name, threads, [&](int owner) { pass(view_of(grid, owner)); });
}

}  // namespace mpm
