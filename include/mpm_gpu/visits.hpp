// Order in which indices are visited: none may matter to a kernel, and tests try them all.
#pragma once

#include <numeric>

namespace mpm_gpu {

enum class Visits : int { forwards, backwards, shuffled };

/// A stride that reaches every index once, about the golden section of the count: neighbours are visited far from each
/// other.
inline long stride_of(long count) {
  if (count < 3) return 1;
  long stride = static_cast<long>(0.618 * static_cast<double>(count)) + 1;
  while (std::gcd(stride, count) != 1) ++stride;
  return stride;
}

/// The index that is visited as number i of `count`.
constexpr long visited(Visits visits, long i, long count, long stride) {
  return visits == Visits::forwards ? i : visits == Visits::backwards ? count - 1 - i : i * stride % count;
}

}  // namespace mpm_gpu
