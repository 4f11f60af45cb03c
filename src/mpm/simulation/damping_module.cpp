// Damping of a definition, and what sharpens its part of PIC, as modules; the mechanics ask damping for their rates.
#include "mpm/mechanics/damping.hpp"
#include "mpm/mechanics/sharpened_pic.hpp"
#include "shipped_modules.hpp"

namespace mpm {

void add_damping(RunParts& parts) {
  const MethodDefinition& method = parts.definition.method;
  if (!method.damping.any()) return;
  parts.damping = &parts.modules.add(std::make_unique<DampingControl>(
      method.damping, method.transfer.flip, parts.fields, parts.sets, parts.threads, parts.ranks));
}

void add_sharpened_pic(RunParts& parts) {
  const MethodDefinition& method = parts.definition.method;
  const double pic = 1.0 - method.transfer.flip;
  if (method.transfer.kind != TransferKind::flip || method.transfer.pic_order != 2 || pic == 0.0) return;
  const double smoothing = smoothing_of(method.shape, method.particles_per_direction);
  parts.modules.add(std::make_unique<SharpenedPic>(pic * smoothing, parts.fields, parts.threads, parts.halo));
}

}  // namespace mpm
