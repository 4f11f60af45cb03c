#include "mpm/kernel/law_table.hpp"

namespace mpm {

const mpm_kernel::LawFamily& line_laws() {
  static constexpr mpm_kernel::LawFamily kFamily = {LawTable<Line, double>::kKernels, LawTable<Line, float>::kKernels};
  return kFamily;
}

}  // namespace mpm
