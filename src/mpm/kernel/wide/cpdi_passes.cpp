#include "mpm/kernel/passes.hpp"
#include "mpm/kernel/point_interpolator.hpp"
#include "mpm/shape/cpdi.hpp"

namespace mpm {
namespace {

template <class T, int Dim>
using Interpolator = PointInterpolator<T, Dim, Cpdi>;

}  // namespace

const mpm_kernel::PassFamily& cpdi_passes() {
  static constexpr mpm_kernel::PassFamily kFamily = passes_of<Interpolator>();
  return kFamily;
}

}  // namespace mpm
