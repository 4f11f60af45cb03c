// What a scene amounts to, for --explain: what was chosen and why, and the numbers that follow from it.
#pragma once

#include <string>

#include "mpm/scene/scene.hpp"

namespace mpm {

/// Several lines of text. `built` is build(scene).
std::string explain(const Scene& scene, const SimulationDefinition& built);

}  // namespace mpm
