// In place of cards in a build without them.
#include "mpm_devices/find_card.hpp"

namespace mpm {

FoundDevice find_card() {
  return {{},
          "this build has no steps for a graphics processor: make one that has with scripts/build --gpu, and run its "
          "programs, in build_gpu/"};
}

}  // namespace mpm
