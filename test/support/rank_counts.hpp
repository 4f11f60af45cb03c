// Over how many ranks a test repeats its case.
#pragma once

#include <cstdlib>
#include <vector>

namespace mpm::test {

/// `quick` alone, or with MPM_FULL in the environment `all`: the same code runs for each of them, and threads that wait
/// for each other take long where they are more than the processors.
inline std::vector<int> rank_counts(const std::vector<int>& all, int quick) {
  return std::getenv("MPM_FULL") == nullptr ? std::vector<int>{quick} : all;
}

}  // namespace mpm::test
