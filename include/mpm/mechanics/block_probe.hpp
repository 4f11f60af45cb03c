// Asks the kernels for what one block gives to the grid (step/block_probe.hpp): they scatter onto the 3^dim blocks
// around it, which are kept here and stand in for the grid.
#pragma once

#include <memory>
#include <vector>

#include "mpm/grid/fields.hpp"
#include "mpm/kernel/kernels.hpp"
#include "mpm/material/law.hpp"
#include "mpm/particles/particle_set.hpp"
#include "mpm/step/block_probe.hpp"

namespace mpm {

/// T is the precision of the sets. `laws`: of each set; `fields`, sets and laws outlive the result. `averaged`: volume
/// changes and pressures are averaged over the grid, on one process.
template <class T>
std::unique_ptr<BlockProbe> make_block_probe(const mpm_kernel::KernelTable<T>& kernels, Fields& fields,
                                             std::vector<ParticleSet>& sets, const std::vector<Law>& laws,
                                             bool averaged, int threads);

}  // namespace mpm
