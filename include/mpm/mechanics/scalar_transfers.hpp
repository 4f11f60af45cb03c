// Transfers of step/scalar_transfer.hpp by the kernels of the mechanics, in the run's shape function and precision.
#pragma once

#include <memory>
#include <vector>

#include "mpm/grid/fields.hpp"
#include "mpm/grid/node_choice.hpp"
#include "mpm/kernel/kernels.hpp"
#include "mpm/particles/particle_set.hpp"
#include "mpm/ranks/halo.hpp"
#include "mpm/step/scalar_transfer.hpp"

namespace mpm {

/// `kernels`: of the sets' precision, T double or float. `fields`, `sets`, `choice` (of particles that choose a field
/// at every node, or null) and `halo` (where other ranks give to the same nodes, or null) outlive the result.
template <class T>
std::unique_ptr<ScalarTransfer> make_scalar_transfer(const mpm_kernel::KernelTable<T>& kernels, Fields& fields,
                                                     std::vector<ParticleSet>& sets, int threads,
                                                     NodeChoice* choice = nullptr, Halo* halo = nullptr);

}  // namespace mpm
