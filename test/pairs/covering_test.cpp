// The rows of the suite of pairs: every two choices that nothing refuses are in one of them, and what refuses two
// choices says what to do. Cost: 9 s.
#include <array>
#include <set>

#include "twins.hpp"

namespace mpm::pairs {
namespace covering_test {

TEST(PairsCovering, HasEveryPairOfThreeFactors) {
  const Covering all({2, 3, 4}, [](const Row&) { return true; });
  EXPECT_EQ(all.together(), 2 * 3 + 2 * 4 + 3 * 4);
  EXPECT_GE(all.rows().size(), 12U);  // every two choices of the larger factors need a row
  EXPECT_LE(all.rows().size(), 14U);
  std::set<std::array<int, 4>> seen;
  for (const Row& row : all.rows()) {
    for (int a = 0; a < 3; ++a) {
      for (int b = a + 1; b < 3; ++b) seen.insert({a, row[a], b, row[b]});
    }
  }
  EXPECT_EQ(static_cast<int>(seen.size()), all.together());
}

TEST(PairsCovering, HasThePairsOfOneFactorAlone) {
  const Covering one(
      {2, 3, 4}, [](const Row&) { return true; }, 0);
  EXPECT_EQ(one.together(), 3 + 4);
  EXPECT_EQ(one.rows().size(), 4U);
  for (const Row& row : one.rows()) EXPECT_EQ(row[0], 1);
}

TEST(PairsCovering, KeepsOutWhatIsRefused) {
  const Covering some({2, 2, 2}, [](const Row& row) { return row[0] == 0 || row[1] == 0; });
  EXPECT_EQ(some.refused(), 1);
  for (const Row& row : some.rows()) EXPECT_TRUE(row[0] == 0 || row[1] == 0);
}

// Counts: all but 104 of 2,817 pairs go together; the others are refused by the table of doc/features.md, or are a
// word that a shape, a law or implicit steps do not have.
TEST(PairsCovering, LeavesNoPairOfFeaturesOut) {
  const std::vector<Covering> all = coverings();
  int together = 0, refused = 0;
  for (const Covering& covering : all) {
    covering.each_left([](int a, int i, int b, int j) {
      ADD_FAILURE() << factors()[a].choices[i] << " and " << factors()[b].choices[j] << " are in no row";
    });
    together += covering.together();
    refused += covering.refused();
  }
  EXPECT_GT(together, 2650);
  EXPECT_LT(refused, 115);
  EXPECT_LT(rows_of(all).size(), 150U);
}

TEST(PairsCovering, AreRefusedWithARemedy) {
  const std::size_t factor_count = factors().size();
  for (std::size_t a = 0; a < factor_count; ++a) {
    for (std::size_t b = a + 1; b < factor_count; ++b) {
      for (std::size_t i = 1; i < factors()[a].choices.size(); ++i) {
        for (std::size_t j = 1; j < factors()[b].choices.size(); ++j) {
          Row row(factor_count, 0);
          row[a] = static_cast<int>(i);
          row[b] = static_cast<int>(j);
          const std::string fault = fault_of(row);
          if (fault.empty()) continue;
          // A sentence after the fault says what to write instead.
          EXPECT_TRUE(fault.find("; ") != std::string::npos || fault.find(": use ") != std::string::npos) << fault;
        }
      }
    }
  }
}

}  // namespace covering_test
}  // namespace mpm::pairs
