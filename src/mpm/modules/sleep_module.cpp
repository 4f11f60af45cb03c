// Sleep of a definition as a module.
#include "mpm/modules/shipped_modules.hpp"
#include "mpm/sleep/sleep.hpp"

namespace mpm {

void add_sleep(RunParts& parts) {
  if (!parts.definition.sleep) return;
  SleepParts needed{parts.fields,
                    parts.sets,
                    parts.bodies,
                    parts.make_probe(),
                    parts.definition.gravity,
                    parts.threads,
                    parts.definition.method.update == UpdateScheme::implicit,
                    parts.halo,
                    parts.rest_partners};
  parts.sleep = &parts.modules.add(std::make_unique<Sleep>(*parts.definition.sleep, std::move(needed)));
}

}  // namespace mpm
