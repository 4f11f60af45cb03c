// Making of the weights of the shape functions that are products along the axes.
#include "mpm/kernel/weights.hpp"
#include "mpm/shape/bspline.hpp"
#include "mpm/shape/dirac.hpp"
#include "mpm/shape/ugimp.hpp"
#include "mpm/shape/ugimp_stretch.hpp"

namespace mpm {

const mpm_kernel::ShapeFamily& dirac_shape() {
  static constexpr mpm_kernel::ShapeFamily kFamily = shape_of<Dirac>();
  return kFamily;
}

const mpm_kernel::ShapeFamily& ugimp_shape() {
  static constexpr mpm_kernel::ShapeFamily kFamily = shape_of<Ugimp>();
  return kFamily;
}

const mpm_kernel::ShapeFamily& ugimp_stretch_shape() {
  static constexpr mpm_kernel::ShapeFamily kFamily = shape_of<UgimpStretch>();
  return kFamily;
}

const mpm_kernel::ShapeFamily& bspline2_shape() {
  static constexpr mpm_kernel::ShapeFamily kFamily = shape_of<QuadraticSpline>();
  return kFamily;
}

const mpm_kernel::ShapeFamily& bspline3_shape() {
  static constexpr mpm_kernel::ShapeFamily kFamily = shape_of<CubicSpline>();
  return kFamily;
}

}  // namespace mpm
