// Energy that a surface takes from the material at a node (surface_loss.hpp), in vectors of the world.
#pragma once

#include "mpm/math/geometry.hpp"
#include "mpm/step/surface_loss.hpp"

namespace mpm {

using NodeLoss = LossAtNode<Vec3>;

}  // namespace mpm
