// The kernels and launches of replayed_steps.cpp, for a card.
#include "mpm_gpu/device/host_headers.hpp"

#pragma clang force_cuda_host_device begin
#include "mpm_gpu/taken.hpp"
#include "mpm_gpu/views.hpp"
#pragma clang force_cuda_host_device end

#include "../replayed_steps.cpp"
