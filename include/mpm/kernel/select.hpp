// The table of kernels for a geometry, a precision and an instruction set.
#pragma once

#include "mpm/kernel/isa.hpp"
#include "mpm/kernel/kernels.hpp"

namespace mpm {

/// Of uGIMP in a plane (`dim` 2) or a solid (`dim` 3). T: double or float. `isa` must be available.
template <class T>
const mpm_kernel::KernelTable<T>& ugimp_kernels(int dim, Isa isa);

}  // namespace mpm
