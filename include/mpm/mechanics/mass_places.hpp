// Place where the mass of a node comes from: Grid::place = sum of m S x over particles [kg m], mass centre times mass,
// on the blocks near something that asks for it (thin tools, tools in bodies that cracks divide).
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "mpm/grid/fields.hpp"
#include "mpm/particles/particle_set.hpp"
#include "mpm/step/scalar_transfer.hpp"
#include "mpm/step/stage.hpp"

namespace mpm {

/// True if a ball around a world point is near enough to be looked at: centre and radius [m].
using NearBall = std::function<bool(const Vec3&, double)>;

/// A stage that fills Grid::place of every field when momentum is gathered. `transfer`: of these fields and sets, which
/// outlive the stage.
std::unique_ptr<Stage> make_mass_places(std::unique_ptr<ScalarTransfer> transfer, Fields& fields,
                                        std::vector<ParticleSet>& sets, NearBall near);

}  // namespace mpm
