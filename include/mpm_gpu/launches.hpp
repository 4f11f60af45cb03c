// Backend of the executor on a card: a kernel is a launch with a thread an index, scans and sorts are CUB's. For builds
// with MPM_CUDA; files that hand it kernels are compiled as CUDA by clang (src/mpm_gpu/device), others may include it.
#pragma once

#include <cstdint>
#include <type_traits>

#include "mpm_gpu/buffer.hpp"
#include "mpm_gpu/visits.hpp"

#ifdef __CUDA__
// Entry point of CUDA's runtime that clang's code of a launch calls, so that its headers are not needed.
extern "C" {
struct dim3 {
  unsigned x, y, z;
};
struct CUstream_st;
int cudaLaunchKernel(const void* function, dim3 grid, dim3 block, void** arguments, std::size_t shared,
                     CUstream_st* stream);
}

namespace mpm_gpu {

template <class Kernel>
__attribute__((global)) void one_index(Kernel kernel, Visits visits, long count, long stride) {
  const long i =
      static_cast<long>(__nvvm_read_ptx_sreg_ctaid_x()) * __nvvm_read_ptx_sreg_ntid_x() + __nvvm_read_ptx_sreg_tid_x();
  if (i >= count) return;
  kernel(visited(visits, i, count, stride));
}

/// Members of a team are neighbours in a warp, which waits for them after each turn.
template <int Members, class Kernel>
__attribute__((global)) void one_member(Kernel kernel, Visits visits, long teams, long stride, int turns) {
  static_assert(Members == 4 || Members == 8 || Members == 16, "a warp of 32 has whole teams");
  const unsigned thread = __nvvm_read_ptx_sreg_tid_x();
  const long i = static_cast<long>(__nvvm_read_ptx_sreg_ctaid_x()) * __nvvm_read_ptx_sreg_ntid_x() + thread;
  const long of = i / Members;
  if (of >= teams) return;
  const long team = visited(visits, of, teams, stride);
  const unsigned own = ((1U << Members) - 1U) << (thread % 32U / Members * Members);
  for (int turn = 0; turn < turns; ++turn) {
    kernel(team, turn, static_cast<int>(i % Members));
    __nvvm_bar_warp_sync(own);
  }
}

}  // namespace mpm_gpu
#endif

namespace mpm_gpu {

class Launches {
 public:
  /// The card has threads of its own: the number is for the processor.
  explicit Launches(Visits visits = Visits::forwards, int /*threads*/ = 1) : visits_(visits) {}
  /// A copy has room of its own, since recordings of another run keep the address of theirs.
  Launches(const Launches& other) : visits_(other.visits_) {}
  Launches& operator=(const Launches&) = delete;
  ~Launches() = default;

  /// kernel(i) for i from 0 to count - 1. `name`: of its row in card::profiled().
  template <class Kernel>
  void for_each(const char* name, long count, const Kernel& kernel) {
    static_assert(std::is_trivially_copyable_v<Kernel>, "a kernel goes to a device as bytes");
    static_assert(sizeof(Kernel) <= 4000, "arguments of a kernel take 4 kB at most");
#ifdef __CUDA__
    Kernel copy = kernel;
    long stride = stride_of(count);
    void* arguments[] = {&copy, &visits_, &count, &stride};
    card::launch(name, reinterpret_cast<const void*>(&one_index<Kernel>), count, arguments);
#else
    static_assert(sizeof(Kernel) == 0, "this file has a kernel: it is to be compiled as CUDA");
    static_cast<void>(name), static_cast<void>(count), static_cast<void>(kernel);
#endif
  }

  /// kernel(team, turn, member) for teams of so many members: all members of a turn at once, whatever their order, and
  /// the turns of a team one after another. Teams do not wait for each other.
  template <int Members, class Kernel>
  void in_turns(const char* name, long teams, int turns, const Kernel& kernel) {
    static_assert(std::is_trivially_copyable_v<Kernel>, "a kernel goes to a device as bytes");
    static_assert(sizeof(Kernel) <= 4000, "arguments of a kernel take 4 kB at most");
#ifdef __CUDA__
    Kernel copy = kernel;
    long stride = stride_of(teams);
    void* arguments[] = {&copy, &visits_, &teams, &stride, &turns};
    card::launch(name, reinterpret_cast<const void*>(&one_member<Members, Kernel>), teams * Members, arguments);
#else
    static_assert(sizeof(Kernel) == 0, "this file has a kernel: it is to be compiled as CUDA");
    static_cast<void>(name), static_cast<void>(teams), static_cast<void>(turns), static_cast<void>(kernel);
#endif
  }

  /// to[i] = sum of from[0 … i - 1]. The two may be one array.
  void exclusive_scan(const std::uint32_t* from, std::uint32_t* to, long count) {
    card::exclusive_scan(room_.data(), room_.bytes(), from, to, count);
  }
  /// Sorts keys below `limit`, and the values with them; of equal keys the order stays. Uses the other arrays as room.
  void stable_sort(std::uint64_t* keys, std::uint32_t* values, std::uint64_t* other_keys, std::uint32_t* other_values,
                   long count, std::uint64_t limit) {
    card::stable_sort(room_.data(), room_.bytes(), keys, values, other_keys, other_values, count, limit);
  }
  /// Makes room for scans and sorts of so many numbers; between steps only.
  void reserve(long count) {
    const std::size_t scan = card::scan_room(count), sort = card::sort_room(count);
    room_.fit(static_cast<long>(scan < sort ? sort : scan));
  }
  /// @throws GpuError saying how many would fit, where so many particles of so many bytes do not
  static void require(long particles, std::size_t bytes_of_each) { card::require(particles, bytes_of_each); }

 private:
  Visits visits_;
  Buffer<std::uint8_t> room_;
};

}  // namespace mpm_gpu
