// The kernels and launches of lane/soil.cpp, for a card.
#include "mpm_gpu/device/host_headers.hpp"

#pragma clang force_cuda_host_device begin
#include "mpm/kernel/soil_cells.hpp"
#include "mpm_gpu/views.hpp"
#pragma clang force_cuda_host_device end
#include "mpm_gpu/soil_passes.hpp"
#pragma clang force_cuda_host_device begin
#include "mpm_gpu/soil_end_kernels.hpp"
#pragma clang force_cuda_host_device end
#include "mpm_gpu/device/law_functions.hpp"

#include "../lane/soil.cpp"
