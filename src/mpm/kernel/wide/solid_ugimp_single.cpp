#include "mpm/kernel/passes.hpp"
#include "mpm/shape/ugimp.hpp"

namespace mpm {

const mpm_kernel::KernelTable<float>& solid_ugimp_single() {
  static constexpr mpm_kernel::KernelTable<float> kTable = Passes<Solid, Ugimp, float>::table();
  return kTable;
}

}  // namespace mpm
