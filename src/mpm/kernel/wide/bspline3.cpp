#include "mpm/kernel/passes.hpp"
#include "mpm/shape/bspline.hpp"

namespace mpm {

const mpm_kernel::PassFamily& bspline3_passes() {
  static constexpr mpm_kernel::PassFamily kFamily = passes_of<CubicSpline>();
  return kFamily;
}

}  // namespace mpm
