// The table of kernels for a geometry, a shape function, a precision and an instruction set.
#pragma once

#include "mpm/kernel/isa.hpp"
#include "mpm/kernel/kernels.hpp"
#include "mpm/kernel/soil_cells.hpp"
#include "mpm/math/geometry_kind.hpp"
#include "mpm/shape/kind.hpp"

namespace mpm {

/// T: double or float. `isa` must be available. A shape function that the geometry has not gives a table without
/// passes (has_shape).
template <class T>
mpm_kernel::KernelTable<T> kernel_table(ShapeKind shape, GeometryKind geometry, Isa isa);

/// The sweeps of the implicit step. `isa` must be available.
template <class T>
const mpm_kernel::SweepTable<T>& sweep_table(Isa isa, GeometryKind geometry);

/// True if there are kernels of this shape function in this geometry: qCPDI has two axes, and B-splines are not made
/// for an axis of symmetry.
constexpr bool has_shape(ShapeKind shape, GeometryKind geometry) {
  if (axisymmetric(geometry)) return shape != ShapeKind::bspline2 && shape != ShapeKind::bspline3;
  return shape != ShapeKind::qcpdi || dimensions(geometry) == 2;
}

}  // namespace mpm
