// Sums and others of all ranks, in a process that is alone: what it gives itself. Several ranks are in ranks_test.
#include "mpm/ranks/of_all.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace mpm {
namespace {

TEST(OfAll, IsAProcessItselfWhereItIsAlone) {
  EXPECT_TRUE(is_first(nullptr));
  EXPECT_TRUE(any_of_all(nullptr, true));
  EXPECT_FALSE(any_of_all(nullptr, false));
  EXPECT_EQ(sum_of_all(nullptr, 0.1), 0.1);
  EXPECT_EQ(largest_of_all(nullptr, -3.0), -3.0);
  EXPECT_EQ(least_of_all(nullptr, std::numeric_limits<double>::infinity()), std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(largest_of_all(nullptr, std::nan(""))));
  EXPECT_EQ(text_of_all(nullptr, "full"), "full");
  EXPECT_EQ(list_of_all(nullptr, std::vector<int>{3, 1}), (std::vector<int>{3, 1}));
  double numbers[] = {1.0, 2.0};
  add_up(nullptr, numbers, 2);
  find_largest(nullptr, numbers, 2);
  EXPECT_EQ(numbers[0], 1.0);
  EXPECT_EQ(numbers[1], 2.0);
  NodalField field(1, 4);
  add_of_others(nullptr, 0, field);
}

}  // namespace
}  // namespace mpm
