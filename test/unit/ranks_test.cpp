// Ranks as threads: what their interface, the division of the grid, particles that are handed over and shared nodes
// promise; and the curve along which the grid is divided. test/mpi checks the same promises over MPI.
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <stdexcept>

#include "mpm/ranks/hilbert.hpp"
#include "rank_counts.hpp"
#include "ranks_promises.hpp"
#include "thread_communicator.hpp"

namespace mpm {
namespace ranks_test {

class ThreadRanks : public testing::TestWithParam<RanksPromise> {};

TEST_P(ThreadRanks, KeepWhatTheyPromise) {
  for (const int count : test::rank_counts({1, 2, 3, 5, 8}, 3)) {
    SCOPED_TRACE(count);
    run_ranks(count, GetParam().check);
  }
}

INSTANTIATE_TEST_SUITE_P(Of, ThreadRanks, testing::ValuesIn(ranks_promises()),
                         [](const auto& promise) { return std::string(promise.param.name); });

TEST(ThreadRanks, ThrowWhatTheLowestRankHasThrownAndWaitForNobodyElse) {
  const auto fail = [](Communicator& ranks) {
    ranks.sum(1.0);
    if (ranks.rank() > 0) throw std::runtime_error("rank " + std::to_string(ranks.rank()));
    ranks.sum(1.0);
  };
  try {
    run_ranks(3, fail);
    FAIL() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "rank 1");
  }
}

TEST(ThreadRanks, FindRanksThatDoNotCallTheSame) {
  EXPECT_THROW(run_ranks(2, [](Communicator& ranks) { ranks.first() ? void(ranks.sum(1.0)) : void(ranks.gather({})); }),
               RanksError);
  EXPECT_THROW(run_ranks(3,
                         [](Communicator& ranks) {
                           if (!ranks.first()) ranks.sum(1.0);
                         }),
               RanksError);
}

/// Every place of a cube once, each beside the one before.
void expect_curve(int dim, int bits) {
  const std::uint32_t edge = 1U << bits;
  std::vector<std::array<std::uint32_t, 3>> along(std::size_t{1} << (dim * bits));
  std::vector<int> visits(along.size(), 0);
  std::array<std::uint32_t, 3> place{};
  for (place[0] = 0; place[0] < edge; ++place[0]) {
    for (place[1] = 0; place[1] < (dim > 1 ? edge : 1); ++place[1]) {
      for (place[2] = 0; place[2] < (dim > 2 ? edge : 1); ++place[2]) {
        const std::uint64_t index = hilbert_index(place, dim, bits);
        ASSERT_LT(index, along.size());
        ++visits[index];
        along[index] = place;
      }
    }
  }
  EXPECT_EQ(visits, std::vector<int>(along.size(), 1)) << dim << " axes, " << bits << " bits";
  int apart = 0;
  for (std::size_t i = 1; i < along.size(); ++i) {
    int distance = 0;
    for (int k = 0; k < 3; ++k) distance += std::abs(static_cast<int>(along[i][k]) - static_cast<int>(along[i - 1][k]));
    apart += distance != 1;
  }
  EXPECT_EQ(apart, 0) << dim << " axes, " << bits << " bits";
}

TEST(HilbertCurve, PassesThroughEachPlaceOnceAndFromNeighbourToNeighbour) {
  for (int bits = 1; bits <= 5; ++bits) {
    for (int dim = 1; dim <= 3; ++dim) expect_curve(dim, bits);
  }
}

TEST(HilbertCurve, ReachesAsFarAsSixtyThreeBits) {
  const std::uint32_t last = (1U << 21) - 1;
  const std::uint64_t end = std::uint64_t{1} << 63;
  std::set<std::uint64_t> indices;
  for (const std::uint32_t x : {0U, last}) {
    for (const std::uint32_t y : {0U, last}) {
      for (const std::uint32_t z : {0U, last}) indices.insert(hilbert_index({x, y, z}, 3, 21));
    }
  }
  EXPECT_EQ(indices.size(), 8U);
  EXPECT_EQ(*indices.begin(), 0U);        // it begins in a corner
  EXPECT_EQ(*indices.rbegin(), end - 1);  // and ends in another
}

}  // namespace ranks_test
}  // namespace mpm
