// Loops over the blocks and the nodes of a velocity field, for what writes to no node of another block.
#pragma once

#include "mpm/grid/fields.hpp"
#include "mpm/loop/loop.hpp"

namespace mpm {

/// visit(block)
template <class Visit>
void for_blocks(const char* name, const Grid& grid, int threads, Visit&& visit) {
  for_all(name, threads, grid.blocks.size(), visit);
}

/// visit(block, node)
template <class Visit>
void for_nodes(const char* name, const Grid& grid, int threads, Visit&& visit) {
  const int nodes = grid.layout.nodes_per_block();
  for_blocks(name, grid, threads, [&](int b) {
    for (int n = 0; n < nodes; ++n) visit(b, n);
  });
}

}  // namespace mpm
