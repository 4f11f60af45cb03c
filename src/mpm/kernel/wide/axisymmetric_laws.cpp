#include "mpm/kernel/law_table.hpp"

namespace mpm {

const mpm_kernel::LawFamily& axisymmetric_laws() {
  static constexpr mpm_kernel::LawFamily kFamily = {LawTable<Axisymmetric, double>::kKernels,
                                                    LawTable<Axisymmetric, float>::kKernels};
  return kFamily;
}

}  // namespace mpm
