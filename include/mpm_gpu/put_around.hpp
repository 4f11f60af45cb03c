// Particles on periodic axes: those that have left the domain are put back by a whole length of it, at the end of the
// step in which they have left, as mpm/boundary/periodic.hpp does before sorts.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "mpm_gpu/executor.hpp"
#include "mpm_gpu/views.hpp"

namespace mpm_gpu {

class PutAround {
 public:
  PutAround(const GridView& grid, int dim) : grid_(grid), dim_(dim) {}

  bool any() const { return grid_.period[0] + grid_.period[1] + grid_.period[2] > 0; }
  void fit(long particles);
  /// Puts back what is out. `x`: places along each axis [m]; `mass`: as in ParticleView.
  template <class T>
  void put(Executor& run, const std::array<double*, 3>& x, const T* mass, const std::vector<SetView>& sets);
  /// Sum of mass times the way that it was put, along the grid's axes, since the last call [kg m].
  std::array<double, 3> take_carried() { return std::exchange(carried_, {}); }
  /// Lengths of the domain by which each particle was put along an axis since clear_turns(). Empty of other axes.
  Buffer<std::int16_t>& turns(int k) { return turns_[static_cast<std::size_t>(k)]; }
  Buffer<std::int16_t>& room() { return room_; }
  void clear_turns(Executor& run);
  std::size_t bytes() const;

 private:
  struct Count {
    double lengths[3] = {};  ///< lengths of each axis, times the mass [kg]
    constexpr Count& operator+=(const Count& other) {
      for (int k = 0; k < 3; ++k) lengths[k] += other.lengths[k];
      return *this;
    }
  };
  GridView grid_;
  int dim_;
  std::array<double, 3> carried_{};
  std::array<Buffer<std::int16_t>, 3> turns_;
  Buffer<std::int16_t> room_;  ///< for what sorts the particles
  Buffer<Count> sums_;
};

}  // namespace mpm_gpu
