// What a run over several ranks cannot do: each refused by name.
#include <string>

#include "mpm/simulation/definition.hpp"
#include "over_ranks.hpp"

namespace mpm {

std::string ranks_fault(const SimulationDefinition& definition) {
  const bool cracks = !definition.cracks.list.empty();
  if (!cracks && !definition.sleep) return {};
  return std::string(cracks ? "a crack ('cracks')" : "'sleep'") +
         " does not work over several ranks yet; start the run as one process (it takes as many threads as are of "
         "use), or leave that out";
}

}  // namespace mpm
