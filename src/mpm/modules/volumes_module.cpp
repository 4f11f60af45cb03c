// Volumes of a definition as a module.
#include "mpm/modules/shipped_modules.hpp"
#include "mpm/volumes/volumes.hpp"

namespace mpm {

void add_volumes(RunParts& parts) {
  if (parts.definition.volumes.empty()) return;
  VolumeParts needed{parts.sets, parts.bodies,  parts.layout(), parts.definition.geometry,
                     {},         parts.threads, parts.ranks};
  for (const DeformableBody& body : parts.definition.bodies)
    needed.densities.push_back(find_material(parts.definition, body).density);
  parts.modules.add(std::make_unique<Volumes>(parts.definition.volumes, std::move(needed)));
}

}  // namespace mpm
