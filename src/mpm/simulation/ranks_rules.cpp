// What a run over several ranks cannot do: each refused by name.
#include "mpm/simulation/definition.hpp"
#include "over_ranks.hpp"

namespace mpm {

std::string ranks_fault(const SimulationDefinition& definition) {
  if (!definition.sleep) return {};
  return "'sleep' does not work over several ranks yet; write sleep: off (--set sleep=off), or start the run as one "
         "process, which takes as many threads as are of use";
}

}  // namespace mpm
