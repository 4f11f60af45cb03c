#include "mpm/kernel/point_passes.hpp"
#include "mpm/shape/axisymmetric_points.hpp"

namespace mpm {

const mpm_kernel::PassFamily& axisymmetric_qcpdi_passes() {
  static constexpr mpm_kernel::PassFamily kFamily = axisymmetric_passes_of<AxisymmetricQcpdi>();
  return kFamily;
}

}  // namespace mpm
