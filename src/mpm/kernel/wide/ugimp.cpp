#include "mpm/shape/ugimp.hpp"

#include "mpm/kernel/passes.hpp"

namespace mpm {

const mpm_kernel::PassFamily& ugimp_passes() {
  static constexpr mpm_kernel::PassFamily kFamily = passes_of<Ugimp>();
  return kFamily;
}

}  // namespace mpm
