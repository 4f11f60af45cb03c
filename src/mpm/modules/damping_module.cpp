// Damping of a definition as a module; the mechanics ask it for their rates.
#include "mpm/mechanics/damping.hpp"
#include "mpm/modules/shipped_modules.hpp"

namespace mpm {

void add_damping(RunParts& parts) {
  const MethodDefinition& method = parts.definition.method;
  if (!method.damping.any()) return;
  parts.damping = &parts.modules.add(std::make_unique<DampingControl>(
      method.damping, method.transfer.flip, parts.fields, parts.sets, parts.threads, parts.ranks));
}

}  // namespace mpm
