// Sums over the entries of a list that several threads visit. Entries are taken in chunks of one size, and the chunks'
// sums are added in order, so the sum is the same for any number of threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "mpm/loop/loop.hpp"

namespace mpm {

/// `Sum` begins as {} and has +=.
template <class Sum>
class ChunkSums {
 public:
  /// `visit(i, sum)` visits entry i and adds to `sum`; no two entries may write the same. `name`: of the loop.
  template <class Visit>
  Sum over(const char* name, std::size_t entries, int threads, Visit&& visit) {
    const int chunks = static_cast<int>((entries + kChunk - 1) / kChunk);
    sums_.assign(chunks, Sum{});
    for_all(name, std::clamp(chunks / kChunksPerThread, 1, threads), chunks, [&](int c) {
      const std::size_t end = std::min(entries, (c + std::size_t{1}) * kChunk);
      for (std::size_t i = c * kChunk; i < end; ++i) visit(i, sums_[c]);
    });
    Sum all{};
    for (const Sum& sum : sums_) all += sum;
    return all;
  }
  /// Makes room for so many entries, so that over() does not allocate.
  void reserve(std::size_t entries) { sums_.reserve(entries / kChunk + 1); }

 private:
  static constexpr std::size_t kChunk = 256;
  static constexpr int kChunksPerThread = 2;  ///< fewer do not pay for the start of a thread

  std::vector<Sum> sums_;
};

}  // namespace mpm
