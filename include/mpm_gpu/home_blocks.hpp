// Blocks that particles were sorted into on the host, where something sleeps: the host has to sort again when one has
// left the reach of its block, as on the processor (mpm/kernel/advance.hpp).
#pragma once

#include <cstdint>
#include <vector>

#include "mpm_gpu/executor.hpp"
#include "mpm_gpu/views.hpp"

namespace mpm_gpu {

template <class T>
class HomeBlocks {
 public:
  /// `reach`: farthest that a particle may be beyond the nodes of its block [cells].
  HomeBlocks(int dim, double reach) : dim_(dim), reach_(reach) {}

  /// `home`: number of each particle's block, by id; `first`: numbers of each block's first node, [block][axis].
  void take(const std::vector<std::uint32_t>& home, const std::vector<std::int32_t>& first);
  /// True if a particle is beyond the reach of its block at the end of the step, or of a periodic axis.
  bool any_left(Executor& run, const Step<T>& step);
  std::size_t bytes() const { return home_.bytes() + first_.bytes() + left_.bytes(); }

 private:
  struct Left {
    bool any = false;
    constexpr Left& operator+=(const Left& other) {
      any = any || other.any;
      return *this;
    }
  };

  int dim_;
  double reach_;
  Buffer<std::uint32_t> home_;
  Buffer<std::int32_t> first_;
  Buffer<Left> left_;
};

}  // namespace mpm_gpu
