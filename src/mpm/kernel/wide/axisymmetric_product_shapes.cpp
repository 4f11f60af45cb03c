// Making of the weights of the shape functions that are products along the axes, about an axis of symmetry.
#include "mpm/kernel/weights.hpp"
#include "mpm/shape/axisymmetric.hpp"

namespace mpm {

const mpm_kernel::ShapeFamily& axisymmetric_dirac_shape() {
  static constexpr mpm_kernel::ShapeFamily kFamily = axisymmetric_shape_of<AxisymmetricDirac>();
  return kFamily;
}

const mpm_kernel::ShapeFamily& axisymmetric_ugimp_shape() {
  static constexpr mpm_kernel::ShapeFamily kFamily = axisymmetric_shape_of<AxisymmetricUgimp>();
  return kFamily;
}

const mpm_kernel::ShapeFamily& axisymmetric_ugimp_stretch_shape() {
  static constexpr mpm_kernel::ShapeFamily kFamily = axisymmetric_shape_of<AxisymmetricUgimpStretch>();
  return kFamily;
}

}  // namespace mpm
