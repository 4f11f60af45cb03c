// Tables of kernels by the number of axes, or by the type of a geometry.
#pragma once

#include <type_traits>

#include "mpm/kernel/select.hpp"
#include "mpm/math/dimension.hpp"

namespace mpm::test {

/// The kernels of uGIMP in plane strain (`dim` 2) or three dimensions (3).
template <class T>
mpm_kernel::KernelTable<T> ugimp_kernels(int dim, Isa isa) {
  return kernel_table<T>(ShapeKind::ugimp, dim == 3 ? GeometryKind::solid : GeometryKind::plane_strain, isa);
}

template <class Geometry>
constexpr GeometryKind kGeometryKind = std::is_same_v<Geometry, Line>           ? GeometryKind::line
                                       : std::is_same_v<Geometry, PlaneStrain>  ? GeometryKind::plane_strain
                                       : std::is_same_v<Geometry, PlaneStress>  ? GeometryKind::plane_stress
                                       : std::is_same_v<Geometry, Axisymmetric> ? GeometryKind::axisymmetric
                                                                                : GeometryKind::solid;
template <class Geometry, class T>
mpm_kernel::KernelTable<T> kernels_of(ShapeKind shape, Isa isa) {
  return kernel_table<T>(shape, kGeometryKind<Geometry>, isa);
}

}  // namespace mpm::test
