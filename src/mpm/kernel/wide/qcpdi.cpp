#include "mpm/shape/qcpdi.hpp"

#include "mpm/kernel/point_passes.hpp"

namespace mpm {

const mpm_kernel::PassFamily& qcpdi_passes() {
  static constexpr mpm_kernel::PassFamily kFamily = {{{}, PointPasses<2, Qcpdi, double>::table(), {}},
                                                     {{}, PointPasses<2, Qcpdi, float>::table(), {}}};
  return kFamily;
}

}  // namespace mpm
