// The kernels and launches of lane/laws.cpp, for a card.
#include "mpm_gpu/device/host_headers.hpp"

#pragma clang force_cuda_host_device begin
#include "mpm_gpu/views.hpp"
#pragma clang force_cuda_host_device end
#include "mpm_gpu/passes.hpp"
#pragma clang force_cuda_host_device begin
#include "mpm/material/norsand_energy.hpp"
#include "mpm_gpu/law_passes.hpp"
#pragma clang force_cuda_host_device end
#include "mpm_gpu/device/law_functions.hpp"

#include "../lane/laws.cpp"
