#include "mpm/kernel/passes.hpp"
#include "mpm/kernel/point_interpolator.hpp"
#include "mpm/shape/axisymmetric_points.hpp"

namespace mpm {
namespace {

template <class T, int Dim>
using Interpolator = PointInterpolator<T, Dim, AxisymmetricQcpdi>;

}  // namespace

const mpm_kernel::PassFamily& axisymmetric_qcpdi_passes() {
  static constexpr mpm_kernel::PassFamily kFamily = planar_passes_of<Interpolator>();
  return kFamily;
}

}  // namespace mpm
