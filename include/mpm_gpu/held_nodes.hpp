// Nodes that walls held in the last step, between the lists of the host's walls (step/coulomb.hpp) and the bits of a
// run here. Both number blocks by their place in a box of all, each in its own.
#pragma once

#include "mpm/grid/grid_layout.hpp"
#include "mpm/step/coulomb.hpp"
#include "mpm_gpu/holds.hpp"

namespace mpm_gpu {

/// Nodes that the wall at a face held. `layout`: of the grid of which `grid` is the view.
mpm::HeldNodes held_nodes(const WallHolds& holds, const GridView& grid, const mpm::GridLayout& layout, int face);
/// Lets the wall at a face have held these, beside what is kept of others.
void hold_nodes(WallHolds& holds, const GridView& grid, const mpm::GridLayout& layout, int face,
                const mpm::HeldNodes& nodes);

}  // namespace mpm_gpu
