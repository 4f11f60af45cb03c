// FLIP of which a fraction is PIC's, or XPIC's of a higher order, in all steps or in one of several; and the account of
// what that takes, as mechanics/continuum.cpp has it. XPIC's part goes to the nodes' velocity and acceleration
// (IncrementKernel), so that particles gain it as they gain an acceleration.
#pragma once

#include <cstdint>

#include "mpm/step/mechanics.hpp"
#include "mpm/step/transfer.hpp"
#include "mpm_gpu/stage.hpp"
#include "mpm_gpu/totals.hpp"

namespace mpm_gpu {

template <class T>
class Mixture final : public Stage<T> {
 public:
  /// `mechanics`: those of the simulation, which outlive this; null without one.
  Mixture(const mpm::Transfer& transfer, mpm::Mechanics* mechanics)
      : transfer_(transfer), mechanics_(mechanics), turn_(mechanics == nullptr ? own_turn_ : mechanics->turn()) {}

  void make_room(Executor&, long nodes) override {
    if (!transfer_.mixes()) return;
    work_.fit(nodes);
    given_back_.make_room(nodes);
  }
  void begin_step(Executor&, Step<T>& step, double, long) override {
    turn_ = (turn_ + 1) % transfer_.every;
    const bool now = turn_ == 0;
    step.settings.flip = now ? transfer_.flip : 1.0;
    if (!transfer_.mixes()) return;
    step.settings.increments = now ? transfer_.mixed - 1 : 0;
    step.settings.part = 1.0 - transfer_.flip;
    step.nodes.work = work_.data();
  }
  void act(mpm::Hook hook, Executor& run, const Step<T>& step) override {
    if (hook != mpm::Hook::grid_advanced || step.settings.increments == 0) return;
    given_back_.add(run, "gpu: accounts", work_.data(), step.nodes.nodes, 1);
  }
  bool repeats() const override { return transfer_.every == 1; }
  void count(const Taken& taken) override { slip_ += taken.slip; }
  void tell_modules() override {
    const double given_back = transfer_.mixes() ? given_back_.take().of[0] : 0.0;
    if (mechanics_ != nullptr) mechanics_->count(slip_ - given_back, 0.0);
    slip_ = 0.0;
  }
  std::size_t bytes() const override { return work_.bytes() + given_back_.bytes(); }

 private:
  mpm::Transfer transfer_;
  mpm::Mechanics* mechanics_;
  std::int32_t own_turn_ = 0;
  std::int32_t& turn_;  ///< steps since one in which the fraction held
  double slip_ = 0.0;   ///< kinetic energy that PIC took and nobody was told of [J]
  Buffer<double> work_;
  Total given_back_;  ///< work of increments [J]
};

}  // namespace mpm_gpu
