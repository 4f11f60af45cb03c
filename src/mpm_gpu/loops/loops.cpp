#include "mpm_gpu/loops.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace mpm_gpu {

namespace {

struct Scan {
  const std::uint32_t* from;
  std::uint32_t* to;
  long count;

  static void run(const void* scan, long, long) {
    const Scan& own = *static_cast<const Scan*>(scan);
    std::uint32_t sum = 0;
    for (long i = 0; i < own.count; ++i) {
      const std::uint32_t next = own.from[i];  // they may be one array
      own.to[i] = sum;
      sum += next;
    }
  }
};

struct Sort {
  std::uint64_t *keys, *other_keys;
  std::uint32_t *values, *other_values;
  long count;
  std::uint64_t limit;

  static void run(const void* sort, long, long) {
    const Sort& own = *static_cast<const Sort*>(sort);
    constexpr int kBits = 11, kDigits = 1 << kBits;
    std::uint64_t *from = own.keys, *to = own.other_keys;
    std::uint32_t *values_from = own.values, *values_to = own.other_values;
    for (int shift = 0; shift < 64 && (own.limit >> shift) != 0; shift += kBits) {
      std::array<long, kDigits> place{};
      for (long i = 0; i < own.count; ++i) ++place[(from[i] >> shift) % kDigits];
      long sum = 0;
      for (long& first : place) sum += std::exchange(first, sum);
      for (long i = 0; i < own.count; ++i) {
        const long at = place[(from[i] >> shift) % kDigits]++;
        to[at] = from[i];
        values_to[at] = values_from[i];
      }
      std::swap(from, to);
      std::swap(values_from, values_to);
    }
    if (from == own.keys) return;
    for (long i = 0; i < own.count; ++i) {
      own.keys[i] = from[i];
      own.values[i] = values_from[i];
    }
  }
};

}  // namespace

void Loops::exclusive_scan(const std::uint32_t* from, std::uint32_t* to, long count) {
  const Scan scan{from, to, count};
  card::launch("gpu: scan", 1, std::min(count, 1L), &Scan::run, &scan, sizeof(scan));
}

void Loops::stable_sort(std::uint64_t* keys, std::uint32_t* values, std::uint64_t* other_keys,
                        std::uint32_t* other_values, long count, std::uint64_t limit) {
  const Sort sort{keys, other_keys, values, other_values, count, limit};
  card::launch("gpu: radix sort", 1, std::min(count, 1L), &Sort::run, &sort, sizeof(sort));
}

}  // namespace mpm_gpu
