#include "mpm/kernel/passes.hpp"
#include "mpm/shape/ugimp.hpp"

namespace mpm {

const mpm_kernel::KernelTable<double>& solid_ugimp_double() {
  static constexpr mpm_kernel::KernelTable<double> kTable = Passes<Solid, Ugimp, double>::table();
  return kTable;
}

}  // namespace mpm
