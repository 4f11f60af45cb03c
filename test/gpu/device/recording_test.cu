// The tests of recordings on a card: they have kernels of their own.
#include "mpm_gpu/device/host_headers.hpp"

#pragma clang force_cuda_host_device begin
#include "mpm_gpu/views.hpp"
#pragma clang force_cuda_host_device end

#include "../gpu_recording_test.cpp"
