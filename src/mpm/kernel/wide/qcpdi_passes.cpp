#include "mpm/kernel/passes.hpp"
#include "mpm/kernel/point_interpolator.hpp"
#include "mpm/shape/qcpdi.hpp"

namespace mpm {
namespace {

template <class T, int Dim>
using Interpolator = PointInterpolator<T, Dim, Qcpdi>;

}  // namespace

const mpm_kernel::PassFamily& qcpdi_passes() {
  static constexpr mpm_kernel::PassFamily kFamily = planar_passes_of<Interpolator>();
  return kFamily;
}

}  // namespace mpm
