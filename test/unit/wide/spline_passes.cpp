// Kernels of quadratic splines, as those of uGIMP are made (src/mpm/kernel/wide).
#include "mpm/kernel/passes.hpp"
#include "mpm/shape/bspline.hpp"

namespace mpm {

const mpm_kernel::KernelTable<double>& solid_spline_double() {
  static constexpr mpm_kernel::KernelTable<double> kTable = Passes<Solid, QuadraticSpline, double>::table();
  return kTable;
}

}  // namespace mpm
