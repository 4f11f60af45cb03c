#include "mpm/shape/ugimp_stretch.hpp"

#include "mpm/kernel/passes.hpp"

namespace mpm {

const mpm_kernel::PassFamily& ugimp_stretch_passes() {
  static constexpr mpm_kernel::PassFamily kFamily = passes_of<UgimpStretch>();
  return kFamily;
}

}  // namespace mpm
