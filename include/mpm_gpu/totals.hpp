// A sum over the steps of a run, kept where kernels run, so that no step waits for it.
#pragma once

#include <array>
#include <cstddef>

#include "mpm_gpu/executor.hpp"

namespace mpm_gpu {

class Total {
 public:
  struct Sum {
    std::array<double, 3> of{};
    double exchanged = 0.0;  ///< sum over steps of the size of a step's
  };

  Total();
  /// Makes room for sums of so many numbers, between steps only.
  void make_room(long count) { partial_.fit(Executor::groups_of(count)); }
  /// Adds what a step gives: `factor` times the sum of each of `components`, of `count` numbers each that follow each
  /// other at `numbers`.
  void add(Executor& run, const char* name, const double* numbers, long count, int components, double factor = 1.0);
  /// Returns what has come together since the last call. Waits for it.
  Sum take();
  std::size_t bytes() const { return partial_.bytes() + sum_.bytes(); }

 private:
  struct Part {
    double of[3] = {};
    constexpr Part& operator+=(const Part& other) {
      for (int k = 0; k < 3; ++k) of[k] += other.of[k];
      return *this;
    }
  };
  Buffer<Part> partial_;
  Buffer<double> sum_;  ///< three components, and what was exchanged
};

}  // namespace mpm_gpu
