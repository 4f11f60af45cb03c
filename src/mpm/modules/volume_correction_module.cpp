// The fluids' volume correction as a module.
#include <memory>

#include "mpm/definition/definition.hpp"
#include "mpm/mechanics/volume_correction.hpp"
#include "mpm/modules/shipped_modules.hpp"

namespace mpm {

void add_volume_correction(RunParts& parts) {
  const SimulationDefinition& definition = parts.definition;
  std::vector<VolumeCorrection::Body> bodies;
  bool any = false;
  for (std::size_t s = 0; s < parts.sets.size(); ++s) {
    bodies.push_back({&parts.sets[s], &parts.laws[s]});
    any = any || bodies.back().liquid();
  }
  if (!any) return;
  double cell = definition.across();
  for (int k = 0; k < parts.layout().dim(); ++k) cell *= parts.layout().cell(k);
  const ShapeKind shape = definition.method.shape;
  parts.modules.add(std::make_unique<VolumeCorrection>(std::move(bodies), definition.geometry, shape, parts.threads,
                                                       parts.make_transfer(shape), cell));
}

}  // namespace mpm
