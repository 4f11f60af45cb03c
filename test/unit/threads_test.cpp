// Number of threads of processes that run side by side on one machine.
#include "mpm/simulation/threads.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace mpm {
namespace threads_test {

ProcessorSet processors(int first, int count) {
  ProcessorSet set;
  for (int i = first; i < first + count; ++i) set[i] = true;
  return set;
}

// Threads of a machine with as many processors as this one may use, and no more than a control group grants.
TEST(Threads, OfAProcessAloneAreThoseOfTheMachine) {
  EXPECT_TRUE(own_processors().any());
  EXPECT_EQ(threads_beside({own_processors()}, 0), machine_threads());
}

TEST(Threads, OfProcessesThatShareProcessorsAreAShare) {
  const int most = machine_threads();
  const std::vector<ProcessorSet> two(2, own_processors());
  EXPECT_EQ(threads_beside(two, 0), std::max(1, most / 2));
  // As many as there are processors, and more of them.
  for (const int count : {most, 3 * most}) {
    const std::vector<ProcessorSet> many(count, own_processors());
    for (int own = 0; own < count; ++own) EXPECT_EQ(threads_beside(many, own), 1);
  }
}

// The share of a processor counts, not the number of processes: neighbours with processors of their own take none.
TEST(Threads, OfAProcessThatIsBoundAreThoseOfItsProcessors) {
  if (machine_threads() < 2) GTEST_SKIP() << "a process has one thread here in any case";
  // Process that has two to itself: the control group's time is shared, so it is asked beside none.
  EXPECT_EQ(threads_beside({processors(4, 2)}, 0), 2);
  EXPECT_EQ(threads_beside({processors(4, 1)}, 0), 1);
  EXPECT_EQ(threads_beside({processors(0, 2), processors(2, 2), processors(2, 2)}, 1), 1);
}

}  // namespace threads_test
}  // namespace mpm
