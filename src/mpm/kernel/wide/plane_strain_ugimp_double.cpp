#include "mpm/kernel/passes.hpp"
#include "mpm/shape/ugimp.hpp"

namespace mpm {

const mpm_kernel::KernelTable<double>& plane_strain_ugimp_double() {
  static constexpr mpm_kernel::KernelTable<double> kTable = Passes<PlaneStrain, Ugimp, double>::table();
  return kTable;
}

}  // namespace mpm
