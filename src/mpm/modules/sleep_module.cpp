// Sleep of a definition as a module.
#include "mpm/modules/shipped_modules.hpp"
#include "mpm/sleep/sleep.hpp"

namespace mpm {

void add_sleep(RunParts& parts) {
  if (!parts.definition.sleep) return;
  const bool averaged = parts.definition.method.average_dilatation;
  if (averaged && parts.ranks != nullptr) {
    throw DefinitionError(
        "sleep: beside averaged dilatation it runs in one process; start one, or leave out method.average_dilatation");
  }
  if (averaged && parts.definition.transport.find(Transported::pore_pressure) != nullptr) {
    throw DefinitionError(
        "sleep: beside water in pores dilatation is not averaged over what is asleep; leave out "
        "method.average_dilatation");
  }
  SleepParts needed{parts.fields,
                    parts.sets,
                    parts.bodies,
                    parts.make_probe(),
                    parts.definition.gravity,
                    parts.threads,
                    parts.definition.method.update == UpdateScheme::implicit,
                    averaged,
                    parts.halo,
                    parts.rest_partners};
  parts.sleep = &parts.modules.add(std::make_unique<Sleep>(*parts.definition.sleep, std::move(needed)));
}

}  // namespace mpm
