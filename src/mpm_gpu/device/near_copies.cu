// The kernels and launches of near_copies.cpp, for a card.
#include "mpm_gpu/device/host_headers.hpp"

#pragma clang force_cuda_host_device begin
#include "mpm_gpu/faces.hpp"
#include "mpm_gpu/walls.hpp"
#pragma clang force_cuda_host_device end

#include "../near_copies.cpp"
