// The volume correction of liquids as a stage of the device (mpm/mechanics/volume_correction.hpp). When it acts is the
// solver's own count of steps, which checkpoints hold; what it takes is summed there until somebody asks.
#pragma once

#include <utility>
#include <variant>
#include <vector>

#include "mpm/material/law.hpp"
#include "mpm/mechanics/volume_correction.hpp"
#include "mpm_gpu/passes.hpp"
#include "mpm_gpu/stage.hpp"
#include "mpm_gpu/totals.hpp"

namespace mpm_gpu {

template <class T>
class LiquidVolume final : public Stage<T> {
 public:
  /// `correction`: that of the simulation, which outlives this; null without one. `laws`: of each set. `cell`: volume
  /// of a cell [m^3]. `particles`: number of all.
  LiquidVolume(mpm::VolumeCorrection* correction, std::vector<mpm::Law> laws, int dim, double cell, long particles,
               const Passes<T>& passes)
      : correction_(correction), laws_(std::move(laws)), cell_(cell), passes_(passes) {
    for (const mpm::Law& law : laws_) relax_.push_back(relax_pass(dim, law.index(), T()));
    volume_.fit(particles);
    lost_.make_room(particles);
  }

  void make_room(Executor&, long nodes) override { fullness_.fit(nodes); }
  void begin_step(Executor&, Step<T>& step, double, long) override {
    waited_ = (correction_ == nullptr ? own_clock_ : correction_->clock()).advance(step.settings.dt);
  }
  void act(mpm::Hook hook, Executor& run, const Step<T>& step) override {
    if (hook != mpm::Hook::momentum_gathered || !(waited_ > 0.0)) return;
    double* volume = volume_.data();
    for (int s = 0; s < step.set_count; ++s) {
      const double start = std::visit([](const auto& law) { return 1.0 / law.density(); }, law(s));
      passes_.volumes(run, step, s, start, liquid(s), volume);
    }
    passes_.fullness(run, step, volume, cell_, fullness_.data());
    for (int s = 0; s < step.set_count; ++s) {
      const SetView& set = step.sets[s];
      if (!liquid(s)) continue;
      passes_.fullness_to_particles(run, step, s, fullness_.data());
      std::visit([&](const auto& law) { relax_[static_cast<std::size_t>(s)](run, step, s, &law, waited_, volume); },
                 law(s));
      lost_.add(run, "gpu: accounts", volume + set.first, set.count, 1);
    }
  }
  void tell_modules() override {
    const double lost = lost_.take().of[0];
    if (correction_ != nullptr) correction_->count(lost);
  }
  std::size_t bytes() const override { return volume_.bytes() + fullness_.bytes() + lost_.bytes(); }

 private:
  const mpm::Law& law(int set) const { return laws_[static_cast<std::size_t>(set)]; }
  bool liquid(int set) const { return traits_of(law(set)).matter == mpm::Matter::liquid; }

  mpm::VolumeCorrection* correction_;
  mpm::VolumeCorrection::Clock own_clock_;
  std::vector<mpm::Law> laws_;
  double cell_;
  const Passes<T>& passes_;
  std::vector<RelaxPass<T>> relax_;  ///< passes of each set; null where it is no liquid
  double waited_ = 0.0;              ///< time for which it acts in this step; 0 where it does not [s]
  Buffer<double> volume_;            ///< volumes over mass of particles; then the energies that they lose
  Buffer<double> fullness_;          ///< fullness of nodes
  Total lost_;                       ///< elastic energy that particles lost [J]
};

}  // namespace mpm_gpu
