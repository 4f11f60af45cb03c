// Backend of the executor on the processor: kernels in loops, so that the logic, the order of sums and the agreement
// with the solver are checked without a card: forwards, backwards, shuffled, on several threads. Memory and the stream
// are those of the card that the processor stands in for (card.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "mpm_gpu/card.hpp"
#include "mpm_gpu/visits.hpp"

namespace mpm_gpu {

class Loops {
 public:
  explicit Loops(Visits visits = Visits::forwards, int threads = 1) : visits_(visits), threads_(threads) {}

  /// kernel(i) for i from 0 to count - 1. `name`: of its row in a profile (loop/profile.hpp).
  template <class Kernel>
  void for_each(const char* name, long count, const Kernel& kernel) {
    static_assert(std::is_trivially_copyable_v<Kernel>, "a kernel goes to a device as bytes");
    Pass<Kernel> pass{kernel, visits_, count, stride_of(count)};
    __builtin_clear_padding(&pass);  // bytes that were anything may look like an address
    card::launch(name, threads_, count, &Pass<Kernel>::run, &pass, sizeof(pass));
  }

  /// kernel(team, turn, member) for teams of so many members: all members of a turn at once, whatever their order, and
  /// the turns of a team one after another. Teams do not wait for each other.
  template <int Members, class Kernel>
  void in_turns(const char* name, long teams, int turns, const Kernel& kernel) {
    const Visits visits = visits_;
    const long stride = stride_of(Members);
    for_each(name, teams, [=](long team) {
      for (int turn = 0; turn < turns; ++turn) {
        for (int m = 0; m < Members; ++m) kernel(team, turn, static_cast<int>(visited(visits, m, Members, stride)));
      }
    });
  }

  /// to[i] = sum of from[0 … i - 1]. The two may be one array.
  void exclusive_scan(const std::uint32_t* from, std::uint32_t* to, long count);

  /// Sorts keys below `limit`, and the values with them; of equal keys the order stays. Uses the other arrays as room.
  void stable_sort(std::uint64_t* keys, std::uint32_t* values, std::uint64_t* other_keys, std::uint32_t* other_values,
                   long count, std::uint64_t limit);

  /// Makes room for scans and sorts of so many numbers; between steps only. Loops need none.
  void reserve(long /*count*/) {}
  /// @throws GpuError saying how many would fit, where so many particles of so many bytes do not; a processor's memory
  /// is not asked
  static void require(long /*particles*/, std::size_t /*bytes_of_each*/) {}

 private:
  template <class Kernel>
  struct Pass {
    Kernel kernel;
    Visits visits;
    long count, stride;
    static void run(const void* pass, long first, long end) {
      const Pass self = *static_cast<const Pass*>(pass);
      const Kernel& kernel = self.kernel;
      if (self.visits == Visits::forwards) {
        for (long i = first; i < end; ++i) kernel(i);
      } else if (self.visits == Visits::backwards) {
        for (long i = first; i < end; ++i) kernel(self.count - 1 - i);
      } else {
        for (long i = first; i < end; ++i) kernel(i * self.stride % self.count);
      }
    }
  };
  Visits visits_;
  int threads_;
};

}  // namespace mpm_gpu
