#include "mpm/crack/divided_node.hpp"

#include <utility>

namespace mpm {

void CracksBetween::toggle(const AcrossCrack& crossed) {
  for (int k = 0; k < count; ++k) {
    if (across[k].crack != crossed.crack) continue;
    if (k == 0) across[0] = across[1];
    across[--count] = {};
    return;
  }
  if (count == 2) return;
  across[count++] = crossed;
  if (count == 2 && across[1].crack < across[0].crack) std::swap(across[0], across[1]);
}

int FieldLabels::field_of(const CracksBetween& between) const {
  if (between.count == 0) return 0;
  if (between.count == 2) return both == between.across ? 3 : -1;
  for (int f = 0; f < 2; ++f) {
    if (single[f] == between.across[0]) return 1 + f;
  }
  return -1;
}

}  // namespace mpm
