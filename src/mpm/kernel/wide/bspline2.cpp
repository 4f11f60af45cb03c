#include "mpm/kernel/passes.hpp"
#include "mpm/shape/bspline.hpp"

namespace mpm {

const mpm_kernel::PassFamily& bspline2_passes() {
  static constexpr mpm_kernel::PassFamily kFamily = passes_of<QuadraticSpline>();
  return kFamily;
}

}  // namespace mpm
