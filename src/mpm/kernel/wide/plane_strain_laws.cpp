#include "mpm/kernel/law_table.hpp"

namespace mpm {

const mpm_kernel::LawFamily& plane_strain_laws() {
  static constexpr mpm_kernel::LawFamily kFamily = {LawTable<PlaneStrain, double>::kKernels,
                                                    LawTable<PlaneStrain, float>::kKernels};
  return kFamily;
}

}  // namespace mpm
