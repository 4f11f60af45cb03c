// The card: its memory, its stream of work and its errors, as functions of plain pointers, so that no header of CUDA is
// needed elsewhere. The first use opens it. All work goes to one stream, in the order of the calls. Every failure is a
// GpuError of one sentence: no card, a driver or card too old, too little memory, a card lost.
//
// Without MPM_CUDA the processor stands in for a card (loops/card.cpp), as strictly as one: memory that the host cannot
// look at, work that is done when somebody waits for it, kernels that may hold no address of the host.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace mpm_gpu::card {

/// Memory of the card, set to zero. @throws GpuError where there is too little
void* allocate(std::size_t bytes);
void release(void* memory) noexcept;
/// Copies to the card, after the work before; the host may change its numbers at once, and waits only for many of them.
void upload(void* to, const void* from, std::size_t bytes);
/// Copies from the card, and waits for that.
void download(void* to, const void* from, std::size_t bytes);
/// The same of what is there after the next wait, whoever waits.
void download_soon(void* to, const void* from, std::size_t bytes);
/// Waits for all work.
void finish();

/// Work that is recorded once and handed to the stream again and again, as one piece: a graph of CUDA.
class Recording {
 public:
  Recording() = default;
  Recording(Recording&& other) noexcept : work_(std::exchange(other.work_, nullptr)) {}
  Recording& operator=(Recording&& other) noexcept {
    std::swap(work_, other.work_);
    return *this;
  }
  ~Recording();
  void* work() const { return work_; }
  explicit Recording(void* work) : work_(work) {}

 private:
  void* work_ = nullptr;
};
/// True if this build and the driver can record work with conditions.
bool can_record();
/// Work from here on is recorded, and not done. Nothing may be waited for or copied until the end.
void begin_recording();
Recording end_recording();
/// Drops what has been recorded since, after an error.
void drop_recording() noexcept;
bool is_recording();
/// In a recording: work from here to the end is done if the number there is not zero at that time. Conditions are not
/// nested.
void begin_when(const std::uint32_t* number);
void end_when();
/// Hands out what was recorded.
void replay(const Recording& recording);

#ifdef MPM_CUDA
/// Name, and the memory that is free [bytes].
std::string name();
std::size_t free_memory();
/// Bytes that the card reads and writes a second while it copies its own memory.
double bytes_per_second();
/// @throws GpuError saying how many would fit, where so many particles of so many bytes do not
void require(long particles, std::size_t bytes_of_each);

/// Hands `count` threads of a kernel to the stream. `kernel`: its address on the host; `arguments`: their addresses.
void launch(const char* name, const void* kernel, long count, void** arguments);

/// Room that scans and sorts of so many numbers take [bytes].
std::size_t scan_room(long count);
std::size_t sort_room(long count);
/// Bodies of exclusive_scan() and stable_sort() of Launches, by CUB.
void exclusive_scan(void* room, std::size_t room_bytes, const std::uint32_t* from, std::uint32_t* to, long count);
void stable_sort(void* room, std::size_t room_bytes, std::uint64_t* keys, std::uint32_t* values,
                 std::uint64_t* other_keys, std::uint32_t* other_values, long count, std::uint64_t limit);

/// Time of a kernel [s], summed over its launches.
struct Row {
  std::string name;
  long launches = 0;
  double seconds = 0.0;
};
/// Begins or ends a profile: each launch is waited for, so that the whole takes longer than without, and nothing can be
/// recorded.
void profile(bool on);
/// Rows of the profile since it began, by name.
std::vector<Row> profiled();
#else
/// Hands run(kernel, first, end), which does a part of the indices to `count`, to the stream; the kernel is copied.
/// @throws std::logic_error if it holds an address of the host
void launch(const char* name, int threads, long count, void (*run)(const void*, long, long), const void* kernel,
            std::size_t bytes);
#endif

}  // namespace mpm_gpu::card
