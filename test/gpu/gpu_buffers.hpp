// Memory of a device for the tests of the executor.
#pragma once

#include <vector>

#include "mpm_gpu/buffer.hpp"

namespace gpu_buffers {

/// Copies numbers to the device.
template <class T>
mpm_gpu::Buffer<T> there(const std::vector<T>& here) {
  mpm_gpu::Buffer<T> buffer;
  buffer.fit(static_cast<long>(here.size()));
  buffer.upload(here);
  return buffer;
}

}  // namespace gpu_buffers
