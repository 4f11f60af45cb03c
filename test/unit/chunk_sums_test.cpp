// Sums over chunks of a list: every entry once, and the same bits for any number of threads.
#include "mpm/loop/chunk_sums.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace mpm {
namespace chunk_sums_test {

/// Numbers of very different size, whose sum depends on the order of addition.
double number(std::size_t i) { return std::ldexp(i % 3 == 0 ? -1.1 : 1.3, static_cast<int>(i * 7 % 60)); }

TEST(ChunkSums, VisitEveryEntryOnceAndHaveTheSameBits) {
  for (const std::size_t entries : {0, 1, 255, 256, 257, 10'000}) {
    std::vector<double> found;
    for (const int threads : {1, 2, 3, 8}) {
      ChunkSums<double> sums;
      std::vector<int> visits(entries, 0);
      found.push_back(sums.over("loop", entries, threads, [&](std::size_t i, double& sum) {
        ++visits[i];
        sum += number(i);
      }));
      EXPECT_EQ(visits, std::vector<int>(entries, 1)) << threads;
    }
    for (const double sum : found) EXPECT_EQ(sum, found.front()) << entries;
    double plain = 0.0;
    for (std::size_t i = 0; i < entries; ++i) plain += number(i);
    EXPECT_NEAR(found.front(), plain, 1e-12 * std::ldexp(1.3, 60) * static_cast<double>(entries));
  }
}

}  // namespace chunk_sums_test
}  // namespace mpm
