#include "mpm_gpu/loops.hpp"

#include <array>
#include <utility>

#include "mpm/loop/loop.hpp"

namespace mpm_gpu {

void Loops::parts(const char* name, long count, void (*run)(const void*, long, long), const void* pass) {
  if (count == 0) return;
  mpm::for_parts(name, threads_, count, [=](long first, long end, int) { run(pass, first, end); });
}

std::uint32_t Loops::exclusive_scan(const std::uint32_t* from, std::uint32_t* to, long count) {
  std::uint32_t sum = 0;
  for (long i = 0; i < count; ++i) {
    const std::uint32_t next = from[i];  // they may be one array
    to[i] = sum;
    sum += next;
  }
  return sum;
}

void Loops::stable_sort(std::uint64_t* keys, std::uint32_t* values, std::uint64_t* other_keys,
                        std::uint32_t* other_values, long count, std::uint64_t limit) {
  constexpr int kBits = 11, kDigits = 1 << kBits;
  std::uint64_t *from = keys, *to = other_keys;
  std::uint32_t *values_from = values, *values_to = other_values;
  for (int shift = 0; shift < 64 && (limit >> shift) != 0; shift += kBits) {
    std::array<long, kDigits> place{};
    for (long i = 0; i < count; ++i) ++place[(from[i] >> shift) % kDigits];
    long sum = 0;
    for (long& first : place) sum += std::exchange(first, sum);
    for (long i = 0; i < count; ++i) {
      const long at = place[(from[i] >> shift) % kDigits]++;
      to[at] = from[i];
      values_to[at] = values_from[i];
    }
    std::swap(from, to);
    std::swap(values_from, values_to);
  }
  if (from == keys) return;
  for (long i = 0; i < count; ++i) {
    keys[i] = from[i];
    values[i] = values_from[i];
  }
}

}  // namespace mpm_gpu
