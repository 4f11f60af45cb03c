#include "mpm/kernel/passes.hpp"
#include "mpm/kernel/product_interpolator.hpp"

namespace mpm {
namespace {

template <class T, int Dim>
using Interpolator = ProductInterpolator<T, Dim, 3, true>;

}  // namespace

/// Passes of every axisymmetric shape function that is a product.
const mpm_kernel::PassFamily& axisymmetric_stencil3_passes() {
  static constexpr mpm_kernel::PassFamily kFamily = planar_passes_of<Interpolator>();
  return kFamily;
}

}  // namespace mpm
