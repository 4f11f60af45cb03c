// The text of --explain: what was chosen for a scene and why, and the numbers that follow from it.
#pragma once

#include <string>

#include "mpm/scene/scene.hpp"

namespace mpm {

/// Several lines of text. `built` is build(scene).
std::string explain(const Scene& scene, const SimulationDefinition& built);

}  // namespace mpm
