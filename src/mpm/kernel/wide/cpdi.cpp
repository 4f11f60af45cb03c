#include "mpm/shape/cpdi.hpp"

#include "mpm/kernel/point_passes.hpp"

namespace mpm {

const mpm_kernel::PassFamily& cpdi_passes() {
  static constexpr mpm_kernel::PassFamily kFamily = passes_of<Cpdi>();
  return kFamily;
}

}  // namespace mpm
