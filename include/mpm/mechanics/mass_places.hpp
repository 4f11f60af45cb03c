// Where the mass of a node comes from: Grid::place = sum of m S x over particles [kg m], mass centre times mass. A
// particle pass of its own beside the kernels, over the blocks near something that asks for it (thin tools).
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "mpm/grid/fields.hpp"
#include "mpm/kernel/kernels.hpp"
#include "mpm/material/law.hpp"
#include "mpm/particles/particle_set.hpp"
#include "mpm/step/stage.hpp"

namespace mpm {

/// Whether a ball around a world point is near enough to be looked at: centre and radius [m].
using NearBall = std::function<bool(const Vec3&, double)>;

/// A stage that fills Grid::place of every field when momentum is gathered. Fields, sets and laws outlive it. T: double
/// or float, the sets' precision.
template <class T>
std::unique_ptr<Stage> make_mass_places(const mpm_kernel::KernelTable<T>& kernels, Fields& fields,
                                        std::vector<ParticleSet>& sets, const std::vector<Law>& laws, NearBall near,
                                        int threads);

}  // namespace mpm
