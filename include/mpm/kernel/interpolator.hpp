// An interpolator is a shape function as passes use it, as weights on nodes. passes.hpp and transfer_passes.hpp are
// written over it.
//
// An interpolator (product_interpolator.hpp, point_interpolator.hpp) belongs to one set in one block, and has
//
//   Source<n>         a tile to gather n components from
//   Sink              a tile to scatter up to four components into
//   reach             how much of the tiles is in use
//   note_domains      keeps the deformation that weights are made of through the step
//   each_chunk        visits the set's particles of the block; what follows is about the chunk that is visited
//   fill              makes its weights, and what stands beside them
//   gather            S, from a source to the chunk's buffers; returns how often groups of particles were gathered
//   gradient          G, and of rings T, in the same way
//   spread            S, from the chunk's buffers to a sink
//   spread_gradient   G, and of rings T, in the same way
//   gather_affine     B of APIC
//   spread_affine     S (v + B D^-1 (x_i - x_p)), with weights that it makes itself
//   gather_at_place   of rings, the hat functions at the particle
//   cells             where particles are in the tile
#pragma once

#include "mpm/kernel/chunks.hpp"

namespace mpm {

/// visit(interpolator, set, its number) for the sets that have particles in the block. The view of a
/// set is copied first, since numbers to which nothing points stay in registers.
template <class Interpolator, class T, class Visit>
void each_set(const mpm_kernel::GridView& grid, const mpm_kernel::BlockView& block, const mpm_kernel::SetView<T>* sets,
              int count, Visit&& visit) {
  for (int s = 0; s < count; ++s) {
    if (absent(sets[s], block)) continue;
    const mpm_kernel::SetView<T> set = sets[s];
    Interpolator in(grid, block, set);
    visit(in, set, s);
  }
}

}  // namespace mpm
