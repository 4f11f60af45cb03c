// What a run over several ranks cannot do: each refused by name.
#include <fmt/core.h>

#include <algorithm>

#include "mpm/simulation/definition.hpp"
#include "over_ranks.hpp"

namespace mpm {

std::string ranks_fault(const SimulationDefinition& definition) {
  const auto refused = [](const std::string& what) {
    return fmt::format(
        "{} does not work over several ranks yet; start the run as one process (it takes as many threads "
        "as are of use), or leave that out",
        what);
  };
  if (!definition.cracks.list.empty()) return refused("a crack ('cracks')");
  if (definition.sleep) return refused("'sleep'");
  for (const RigidBodyDefinition& body : definition.rigid_bodies) {
    if (body.particles) return refused(fmt::format("rigid body '{}', which is made of particles,", body.name));
  }
  return {};
}

}  // namespace mpm
