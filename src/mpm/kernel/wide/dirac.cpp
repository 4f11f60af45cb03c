#include "mpm/shape/dirac.hpp"

#include "mpm/kernel/passes.hpp"

namespace mpm {

const mpm_kernel::PassFamily& dirac_passes() {
  static constexpr mpm_kernel::PassFamily kFamily = passes_of<Dirac>();
  return kFamily;
}

}  // namespace mpm
