// Scan and radix sort of CUB, by CUDA's own compiler, which alone reads CUB's headers. Sizes of a temporary storage are
// CUB's own answers for the largest count, and no smaller count takes more: Launches::reserve() is called with that.
#include <cuda_runtime_api.h>

#include <cub/device/device_radix_sort.cuh>
#include <cub/device/device_scan.cuh>

#include "mpm_gpu/card.hpp"
#include "mpm_gpu/device/card_calls.hpp"
#include "mpm_gpu/error.hpp"

namespace mpm_gpu::card {
namespace {

cudaStream_t cuda_stream() { return static_cast<cudaStream_t>(stream()); }

/// Bits that a number below `limit` may have.
int bits_below(std::uint64_t limit) {
  int bits = 0;
  while (bits < 64 && (limit - 1) >> bits != 0) ++bits;
  return bits > 0 ? bits : 1;
}

/// CUB takes no room for a question of its size, and would do nothing.
void require_room(const void* room) {
  if (room == nullptr) throw GpuError("gpu: a scan or sort has no room: reserve() is called first");
}

}  // namespace

std::size_t scan_room(long count) {
  std::size_t bytes = 0;
  succeed(cub::DeviceScan::ExclusiveSum(nullptr, bytes, static_cast<const std::uint32_t*>(nullptr),
                                        static_cast<std::uint32_t*>(nullptr), count, cuda_stream()),
          "ask for the room of a scan");
  return bytes;
}

std::size_t sort_room(long count) {
  std::size_t bytes = 0;
  cub::DoubleBuffer<std::uint64_t> keys(nullptr, nullptr);
  cub::DoubleBuffer<std::uint32_t> values(nullptr, nullptr);
  succeed(cub::DeviceRadixSort::SortPairs(nullptr, bytes, keys, values, count, 0, 64, cuda_stream()),
          "ask for the room of a sort");
  return bytes;
}

void exclusive_scan(void* room, std::size_t room_bytes, const std::uint32_t* from, std::uint32_t* to, long count) {
  if (count == 0) return;
  require_room(room);
  const Timed timed("gpu: scan");
  succeed(cub::DeviceScan::ExclusiveSum(room, room_bytes, from, to, count, cuda_stream()), "scan");
}

void stable_sort(void* room, std::size_t room_bytes, std::uint64_t* keys, std::uint32_t* values,
                 std::uint64_t* other_keys, std::uint32_t* other_values, long count, std::uint64_t limit) {
  if (count == 0) return;
  require_room(room);
  const Timed timed("gpu: radix sort");
  cub::DoubleBuffer<std::uint64_t> two_keys(keys, other_keys);
  cub::DoubleBuffer<std::uint32_t> two_values(values, other_values);
  succeed(cub::DeviceRadixSort::SortPairs(room, room_bytes, two_keys, two_values, count, 0, bits_below(limit),
                                          cuda_stream()),
          "sort");
  const auto copy = [&](void* to, const void* from, std::size_t bytes) {
    if (to == from) return;
    succeed(cudaMemcpyAsync(to, from, bytes, cudaMemcpyDeviceToDevice, cuda_stream()), "copy what was sorted");
  };
  copy(keys, two_keys.Current(), static_cast<std::size_t>(count) * sizeof(std::uint64_t));
  copy(values, two_values.Current(), static_cast<std::size_t>(count) * sizeof(std::uint32_t));
}

}  // namespace mpm_gpu::card
