#include "mpm/kernel/law_table.hpp"

namespace mpm {

const mpm_kernel::LawFamily& plane_stress_laws() {
  static constexpr mpm_kernel::LawFamily kFamily = {LawTable<PlaneStress, double>::kKernels,
                                                    LawTable<PlaneStress, float>::kKernels};
  return kFamily;
}

}  // namespace mpm
