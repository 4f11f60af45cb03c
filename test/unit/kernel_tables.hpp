// The kernels that tests ask for by the number of axes.
#pragma once

#include "mpm/kernel/select.hpp"

namespace mpm::test {

/// Of uGIMP in plane strain (`dim` 2) or a solid (3).
template <class T>
mpm_kernel::KernelTable<T> ugimp_kernels(int dim, Isa isa) {
  return kernel_table<T>(ShapeKind::ugimp, dim == 3 ? GeometryKind::solid : GeometryKind::plane_strain, isa);
}

}  // namespace mpm::test
