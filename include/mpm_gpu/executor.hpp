// Executor of the kernels of a step. A kernel is a function of an index, kernel(i), that holds views of plain arrays by
// value and writes places of its own; how indices are handed out must not matter to it. That is what a graphics
// processor asks for, with a thread an index. This executor runs them in loops on the processor, so that the logic, the
// order of sums and the agreement with the solver are checked without a card: forwards, backwards, shuffled, on several
// threads. One for CUDA has the same functions, over a launch, CUB's scan and radix sort, and a reduction in blocks.
//
// Sums have one order, that of the numbers: in groups of kGroup, then over the groups, whatever the order of visits.
// The scan and the sort give whole numbers and a stable order, which have one result.
#pragma once

#include <cstdint>
#include <type_traits>

#include "mpm_gpu/buffer.hpp"

namespace mpm_gpu {

/// Order in which indices are visited.
enum class Visits { forwards, backwards, shuffled };

class Executor {
 public:
  static constexpr long kGroup = 256;  ///< numbers that are added one after another

  explicit Executor(Visits visits = Visits::forwards, int threads = 1) : visits_(visits), threads_(threads) {}

  /// kernel(i) for i from 0 to count - 1. `name`: of its row in a profile (loop/profile.hpp).
  template <class Kernel>
  void for_each(const char* name, long count, const Kernel& kernel) {
    static_assert(std::is_trivially_copyable_v<Kernel>, "a kernel goes to a device as bytes");
    const Pass<Kernel> pass{&kernel, visits_, count, stride(count)};
    parts(name, count, &Pass<Kernel>::run, &pass);
  }

  /// Sum of number(i) over all i, in one fixed order. `partial`: room for a sum of each group, groups_of(count).
  template <class Sum, class Number>
  Sum reduce(const char* name, long count, const Number& number, Buffer<Sum>& partial) {
    const long groups = groups_of(count);
    Sum* sums = partial.data();
    for_each(name, groups, [=](long g) {
      Sum sum{};
      for (long i = g * kGroup, end = i + kGroup < count ? i + kGroup : count; i < end; ++i) sum += number(i);
      sums[g] = sum;
    });
    Sum all{};
    for (long g = 0; g < groups; ++g) all += sums[g];
    return all;
  }
  static long groups_of(long count) { return (count + kGroup - 1) / kGroup; }

  /// to[i] = sum of from[0 … i - 1]; returns the sum of all.
  std::uint32_t exclusive_scan(const std::uint32_t* from, std::uint32_t* to, long count);

  /// Sorts keys below `limit`, and the values with them; of equal keys the order stays. Uses the other arrays as room.
  void stable_sort(std::uint64_t* keys, std::uint32_t* values, std::uint64_t* other_keys, std::uint32_t* other_values,
                   long count, std::uint64_t limit);

 private:
  template <class Kernel>
  struct Pass {
    const Kernel* kernel;
    Visits visits;
    long count, stride;
    static void run(const void* pass, long first, long end) {
      const Pass self = *static_cast<const Pass*>(pass);
      const Kernel kernel = *self.kernel;
      if (self.visits == Visits::forwards) {
        for (long i = first; i < end; ++i) kernel(i);
      } else if (self.visits == Visits::backwards) {
        for (long i = first; i < end; ++i) kernel(self.count - 1 - i);
      } else {
        for (long i = first; i < end; ++i) kernel(i * self.stride % self.count);
      }
    }
  };
  /// A stride that reaches every index once.
  static long stride(long count);
  /// run(pass, first, end) for a part of the indices on each thread.
  void parts(const char* name, long count, void (*run)(const void*, long, long), const void* pass);

  Visits visits_;
  int threads_;
};

}  // namespace mpm_gpu
