// The kernel that sets the condition of a part of a graph, by CUDA's own compiler, which alone knows how.
#include <cuda_runtime_api.h>

#include "mpm_gpu/device/card_calls.hpp"

namespace mpm_gpu::card {
#if CUDART_VERSION >= 12040
namespace {

__global__ void set_condition_there(cudaGraphConditionalHandle handle, const std::uint32_t* number) {
  cudaGraphSetConditional(handle, *number);
}

}  // namespace

void set_condition(unsigned long long handle, const std::uint32_t* number) {
  set_condition_there<<<1, 1, 0, static_cast<cudaStream_t>(stream())>>>(handle, number);
  succeed(cudaGetLastError(), "record a condition");
}
#endif
}  // namespace mpm_gpu::card
