// Sleep of blocks in the steps of a device, which has the particles that are awake alone. What falls asleep, what wakes
// and the accounts of it are the solver's own stage on the host (mpm/step/device.hpp): the blocks of nodes that the
// border of what is asleep runs through are copied to the host's grid, and the nodes' velocities back, at each of the
// hooks at which that stage acts.
//
// Weak: a step waits for the host at these hooks while anything is asleep, and once more for the check whether a
// particle has left its block. In the first step of a run whose material sleeps from the start, in all steps where
// slow nodes are damped, and where loads are on what may fall asleep, all nodes are copied.
#pragma once

#include <cstdint>
#include <vector>

#include "mpm/step/device.hpp"
#include "mpm_gpu/home_blocks.hpp"
#include "mpm_gpu/near_copies.hpp"
#include "mpm_gpu/stage.hpp"

namespace mpm_gpu {

/// Holds nodes after contact and conditions, before the work of loads is found.
template <class T>
class NearRest final : public Stage<T> {
 public:
  /// `rest` outlives this object. `reach`: as of HomeBlocks.
  NearRest(mpm::HostRest& rest, const GridView& grid, double reach);

  void begin_step(Executor& run, Step<T>& step, double start, long sorts) override;
  void act(mpm::Hook hook, Executor& run, const Step<T>& step) override;
  void end_step(Executor& run, const Step<T>& step, double start, const Taken& taken) override;
  std::size_t bytes() const override { return home_.bytes(); }

  /// Lets the host look at the forces, before contact and conditions act.
  void find_unrest(Executor& run, const Step<T>& step);

 private:
  mpm::Grid& grid() { return *rest_.fields().front(); }
  /// Takes the blocks that particles were sorted into.
  void take_homes();
  /// Takes the blocks of nodes that are copied.
  void choose(Executor& run, const Step<T>& step);
  void get(Executor& run, const Step<T>& step, const double* from, mpm::NodalField& to);
  /// Numbers of the chosen blocks, as they lie in an upload.
  const double* packed(mpm::NodalField& from, std::vector<double>& room);

  mpm::HostRest& rest_;
  const mpm::GridLayout layout_;
  GridView grid_view_;
  NearCopies<T> copies_;
  HomeBlocks<T> home_;
  long sorts_ = -1;
  bool sorted_ = true, all_ = false;
  std::uint64_t generation_ = 0;            ///< generation of the host's blocks
  std::vector<std::uint64_t> keys_;         ///< keys of all blocks of the table
  std::vector<std::int32_t> here_, there_;  ///< numbers of the chosen blocks on the host and in the table
  std::vector<std::uint32_t> home_here_;
  std::vector<std::int32_t> first_here_;
  std::vector<double> numbers_, others_;
};

/// The part of it that acts before contact.
template <class T>
class UnrestAtBorder final : public Stage<T> {
 public:
  explicit UnrestAtBorder(NearRest<T>& rest) : rest_(rest) {}
  void act(mpm::Hook hook, Executor& run, const Step<T>& step) override {
    if (hook == mpm::Hook::momentum_updated) rest_.find_unrest(run, step);
  }

 private:
  NearRest<T>& rest_;
};

}  // namespace mpm_gpu
