#include "mpm/kernel/passes.hpp"
#include "mpm/shape/axisymmetric.hpp"

namespace mpm {

const mpm_kernel::PassFamily& axisymmetric_ugimp_passes() {
  static constexpr mpm_kernel::PassFamily kFamily = axisymmetric_passes_of<AxisymmetricUgimp>();
  return kFamily;
}

}  // namespace mpm
