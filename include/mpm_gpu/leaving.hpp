// Particles that leave the grid, up to a number of them (mpm/boundary/leaving.hpp). Weak: where any leaves, faults and
// ids of all particles are copied to the host; it is meant for a few.
#pragma once

#include <memory>
#include <vector>

#include "mpm/boundary/leaving.hpp"
#include "mpm_gpu/passes.hpp"
#include "mpm_gpu/stage.hpp"
#include "mpm_gpu/totals.hpp"

namespace mpm_gpu {

template <class T>
class PutsBack final : public Stage<T> {
 public:
  /// `leaving`: that of the simulation, which outlives this; null: it makes its own, for so many. `particles`: number
  /// of all.
  PutsBack(mpm::Leaving* leaving, std::uint64_t limit, long particles, const mpm::GridLayout& layout,
           const Passes<T>& passes);

  /// @throws mpm::ModuleError when more have left than may
  bool put_back(Executor& run, const Step<T>& step) override;
  std::size_t bytes() const override {
    return numbers_.bytes() + fault_.bytes() + id_.bytes() + total_.bytes() + taken_.bytes();
  }

 private:
  mpm::GridLayout layout_;
  std::vector<mpm::ParticleSet> no_sets_;
  std::unique_ptr<mpm::Leaving> own_;
  mpm::Leaving& leaving_;
  const Passes<T>& passes_;
  Buffer<double> numbers_;
  Buffer<std::uint8_t> fault_;  ///< copies of what is to be told
  Buffer<std::uint32_t> id_;
  std::vector<std::uint8_t> fault_here_;
  std::vector<std::uint32_t> id_here_, returned_;
  Total total_, taken_;
};

}  // namespace mpm_gpu
