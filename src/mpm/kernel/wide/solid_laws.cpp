#include "mpm/kernel/law_table.hpp"

namespace mpm {

const mpm_kernel::LawFamily& solid_laws() {
  static constexpr mpm_kernel::LawFamily kFamily = {LawTable<Solid, double>::kKernels,
                                                    LawTable<Solid, float>::kKernels};
  return kFamily;
}

}  // namespace mpm
