// The card: its memory, its stream of work and its errors, as functions of plain pointers, so that no header of CUDA is
// needed elsewhere. The first use opens it. All work goes to one stream, in the order of the calls. Every failure is a
// GpuError of one sentence: no card, a driver or card too old, too little memory, a card lost. For builds with
// MPM_CUDA.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace mpm_gpu::card {

/// Memory of the card, set to zero. @throws GpuError where there is too little
void* allocate(std::size_t bytes);
void release(void* memory) noexcept;
/// Copies to the card and from it; both wait for the work before them.
void upload(void* to, const void* from, std::size_t bytes);
void download(void* to, const void* from, std::size_t bytes);

/// Name, and the memory that is free [bytes].
std::string name();
std::size_t free_memory();
/// @throws GpuError saying how many would fit, where so many particles of so many bytes do not
void require(long particles, std::size_t bytes_of_each);

/// Hands `count` threads of a kernel to the stream. `kernel`: its address on the host; `arguments`: their addresses.
void launch(const char* name, const void* kernel, long count, void** arguments);

/// Room that scans and sorts of so many numbers take [bytes].
std::size_t scan_room(long count);
std::size_t sort_room(long count);
/// Bodies of exclusive_scan() and stable_sort() of Launches, by CUB.
std::uint32_t exclusive_scan(void* room, std::size_t room_bytes, const std::uint32_t* from, std::uint32_t* to,
                             long count);
void stable_sort(void* room, std::size_t room_bytes, std::uint64_t* keys, std::uint32_t* values,
                 std::uint64_t* other_keys, std::uint32_t* other_values, long count, std::uint64_t limit);

/// Time of a kernel [s], summed over its launches.
struct Row {
  std::string name;
  long launches = 0;
  double seconds = 0.0;
};
/// Begins or ends a profile: each launch is waited for, so that the whole takes longer than without.
void profile(bool on);
/// Rows of the profile since it began, by name.
std::vector<Row> profiled();
/// Waits for all work.
void finish();

}  // namespace mpm_gpu::card
