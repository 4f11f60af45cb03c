// Executor of the kernels of a step. A kernel is a function of an index, kernel(i), that holds views of plain arrays by
// value and writes places of its own; how indices are handed out must not matter to it. That is what a graphics
// processor asks for, with a thread an index. Its backend, for_each(), exclusive_scan(), stable_sort() and reserve(),
// is loops on the processor, or launches on a card where MPM_CUDA is defined.
//
// Sums have one order, that of the numbers: in groups of kGroup, then over groups of groups, whatever the order of
// visits. The scan and the sort give whole numbers and a stable order, which have one result.
#pragma once

#include "mpm_gpu/buffer.hpp"
#ifdef MPM_CUDA
#include "mpm_gpu/launches.hpp"
#else
#include "mpm_gpu/loops.hpp"
#endif

namespace mpm_gpu {

#ifdef MPM_CUDA
using Backend = Launches;
#else
using Backend = Loops;
#endif

class Executor : public Backend {
 public:
  static constexpr long kGroup = 32;  ///< numbers that are added one after another

  using Backend::Backend;

  /// Sum of number(i) over all i, in one fixed order. `partial`: room for a sum of each group, groups_of(count).
  template <class Sum, class Number>
  Sum reduce(const char* name, long count, const Number& number, Buffer<Sum>& partial) {
    if (count == 0) return Sum{};
    reduce_there(name, count, number, partial);
    return partial.get(0);
  }
  /// The same of at least one number; the sum stays there, at partial's first place, and nobody waits for it.
  template <class Sum, class Number>
  void reduce_there(const char* name, long count, const Number& number, Buffer<Sum>& partial) {
    const long groups = groups_of(count);
    Sum* sums = partial.data();
    for_each(name, groups, [=](long g) {
      Sum sum{};
      for (long i = g * kGroup, end = i + kGroup < count ? i + kGroup : count; i < end; ++i) sum += number(i);
      sums[g] = sum;
    });
    // A group's sum takes the place of its first number, which no other group reads.
    for (long apart = 1; apart < groups; apart *= kGroup) {
      for_each(name, groups_of((groups + apart - 1) / apart), [=](long g) {
        Sum sum{};
        const long first = g * kGroup * apart, end = first + kGroup * apart < groups ? first + kGroup * apart : groups;
        for (long i = first; i < end; i += apart) sum += sums[i];
        sums[first] = sum;
      });
    }
  }
  /// Records the work that `work()` hands out, which does nothing now; replay() hands it out as it was then.
  template <class Work>
  card::Recording record(const Work& work) {
    card::begin_recording();
    try {
      work();
    } catch (...) {
      card::drop_recording();
      throw;
    }
    return card::end_recording();
  }
  void replay(const card::Recording& recording) { card::replay(recording); }
  /// In a recording: work that is done, whenever it is replayed, if the number there is not zero at that time.
  template <class Work>
  void when(const Buffer<std::uint32_t>& number, long at, const Work& work) {
    card::begin_when(number.data() + at);
    work();
    card::end_when();
  }
  /// Gives `values` the first so many of `others`, which has as much room: by a swap or, where addresses have to stay
  /// as they are, by a copy.
  template <class T>
  void replace(const char* name, Buffer<T>& values, Buffer<T>& others, long count, bool stay) {
    if (!stay) {
      values.swap(others);
      return;
    }
    const T* from = others.data();
    T* to = values.data();
    for_each(name, count, [=](long i) { to[i] = from[i]; });
  }
  static long groups_of(long count) { return (count + kGroup - 1) / kGroup; }
};

}  // namespace mpm_gpu
