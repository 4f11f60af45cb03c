// What the kernels (kernel/kernels.hpp) are handed: views of the grid, of the sets of particles and of the block at
// work. Blocks are given out a colour after the other, so that no two at work at a time touch the same node.
#pragma once

#include <vector>

#include "mpm/grid/nodal_fields.hpp"
#include "mpm/kernel/kernels.hpp"
#include "mpm/material/law.hpp"
#include "mpm/particles/particle_set.hpp"

namespace mpm {

static_assert(mpm_kernel::kTileEdge == kBlockEdge + 2 * mpm_kernel::kTileMargin);

mpm_kernel::GridView view_of(Grid& grid);

/// `law` outlives the view. T is the precision of the set.
template <class T>
mpm_kernel::SetView<T> view_of(ParticleSet& set, const Law& law);

/// pass(block) for every block that holds particles, a colour after the other.
template <class Pass>
void each_owner(const Grid& grid, int threads, Pass&& pass) {
  const BlockTable& blocks = grid.blocks;
  // One team for all colours: between two of them its threads wait, and do not part and meet again.
#pragma omp parallel num_threads(threads)
  for (int colour = 0; colour < blocks.colours(); ++colour) {
    const std::vector<int>& owners = blocks.owners_of_colour(colour);
    const int count = static_cast<int>(owners.size());
#pragma omp for schedule(dynamic, 1)
    for (int i = 0; i < count; ++i) {
      const int owner = owners[i];
      mpm_kernel::BlockView block{owner, blocks.neighbours(owner), {}, grid.loose[owner] != 0};
      for (int k = 0; k < grid.layout.dim(); ++k) {
        block.corner[k] = blocks.block(blocks.owner_block(owner))[k] * kBlockEdge - mpm_kernel::kTileMargin;
      }
      pass(block);
    }
  }
}

}  // namespace mpm
