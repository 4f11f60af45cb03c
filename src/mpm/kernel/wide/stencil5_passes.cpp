#include "mpm/kernel/passes.hpp"
#include "mpm/kernel/product_interpolator.hpp"

namespace mpm {
namespace {

template <class T, int Dim>
using Interpolator = ProductInterpolator<T, Dim, 5, false>;

}  // namespace

/// Passes of every shape function of five values along an axis.
const mpm_kernel::PassFamily& stencil5_passes() {
  static constexpr mpm_kernel::PassFamily kFamily = passes_of<Interpolator>();
  return kFamily;
}

}  // namespace mpm
