#include <string>

#include "mpm_devices/find_card.hpp"
#include "mpm_gpu/card.hpp"
#include "mpm_gpu/device.hpp"
#include "mpm_gpu/error.hpp"

namespace mpm {

FoundDevice find_card() {
  try {
    FoundDevice found{mpm_gpu::device_by(), {}};
    found.maker.name = mpm_gpu::card::name();
    return found;
  } catch (const mpm_gpu::GpuError& error) {
    const std::string why = error.what(), begin = "gpu: ";  // a prefix that the option has in its place
    return {{}, why.rfind(begin, 0) == 0 ? why.substr(begin.size()) : why};
  }
}

}  // namespace mpm
