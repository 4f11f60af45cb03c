// The graphics processor that this build can use: an NVIDIA card (mpm_gpu), or none in a build without MPM_GPU. Sources
// that are compiled are all the difference.
#pragma once

#include "mpm/simulation/device_choice.hpp"

namespace mpm {

/// Looks for one on this machine, and opens it: for DeviceRequest::find of a program.
FoundDevice find_card();

}  // namespace mpm
