// Device of a run of the solver (step/device.hpp) whose steps are the kernels of this library.
#pragma once

#include "mpm/simulation/simulation.hpp"
#include "mpm_gpu/executor.hpp"

namespace mpm_gpu {

/// Maker of the device, for SimulationOptions::device.
mpm::DeviceMaker device_by(Executor executor = Executor());

}  // namespace mpm_gpu
