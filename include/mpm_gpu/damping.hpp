// Damping of the grid and of the particles, also by feedback of the kinetic energy, as mechanics/damping.hpp has it:
// rates of a step are the solver's own; as a force on the nodes they act in ForceKernel, in the update of particles in
// the solver's own advance of a particle. Functions of place do not act here.
#pragma once

#include <memory>
#include <vector>

#include "mpm/mechanics/damping.hpp"
#include "mpm/step/mechanics.hpp"
#include "mpm_gpu/stage.hpp"
#include "mpm_gpu/totals.hpp"

namespace mpm_gpu {

template <class T>
class Damping final : public Stage<T> {
 public:
  /// `control`: that of the simulation, whose mechanics these are; both outlive this.
  Damping(mpm::DampingControl& control, mpm::Mechanics* mechanics, const mpm::GridLayout& layout)
      : control_(control), mechanics_(mechanics), layout_(layout) {}
  /// With a control of its own, of these particles, for a transfer with this fraction of FLIP.
  Damping(const mpm::DampingDefinition& definition, double flip, const std::vector<mpm::ParticleSet>& sets,
          const mpm::GridLayout& layout)
      : own_(std::make_unique<mpm::DampingControl>(definition, flip, no_fields_, sets, 1)),
        control_(*own_),
        layout_(layout) {}

  void make_room(Executor&, long nodes) override { impulse_.make_room(nodes); }
  void begin_step(Executor&, Step<T>& step, double start, long) override {
    control_.begin_step(start, step.settings.dt);
    const mpm::DampingRates rates = control_.rates(0);
    step.settings.node_damping = control_.force_rate();
    step.settings.driven = step.settings.driven || control_.force_rate() != 0.0;
    step.settings.damped = control_.in_update() || control_.needs_energy();
    step.settings.grid_damping = rates.grid;
    step.settings.particle_damping = rates.particle;
    if (control_.has_part_of_pic()) step.settings.flip = control_.flip();
  }
  void act(mpm::Hook hook, Executor& run, const Step<T>& step) override {
    const double rate = step.settings.node_damping;
    if (hook != mpm::Hook::forces_gathered || rate == 0.0) return;
    impulse_.add(run, "gpu: accounts", step.nodes.momentum, step.nodes.nodes, layout_.dim(), -rate * step.settings.dt);
  }
  void end_step(Executor&, const Step<T>& step, double start, const Taken& taken) override {
    if (!step.settings.damped) return;
    drag_ += taken.drag_energy;
    mpm::Damped sum;
    for (int k = 0; k < layout_.dim(); ++k) sum.momentum[layout_.axis(k)] = taken.drag[k];
    sum.grid_energy = taken.grid_kinetic;
    sum.particle_energy = taken.particle_kinetic;
    control_.end_step(start, step.settings.dt, sum);
  }
  void tell_modules() override {
    const Total::Sum given = impulse_.take();
    mpm::ImpulseAccount account;
    for (int k = 0; k < layout_.dim(); ++k) account.impulse[layout_.axis(k)] = given.of[static_cast<std::size_t>(k)];
    account.exchanged = given.exchanged;
    control_.count(account);
    if (mechanics_ != nullptr) mechanics_->count(0.0, drag_);
    drag_ = 0.0;
  }
  std::size_t bytes() const override { return impulse_.bytes(); }

 private:
  mpm::Fields no_fields_;
  std::unique_ptr<mpm::DampingControl> own_;
  mpm::DampingControl& control_;
  mpm::Mechanics* mechanics_ = nullptr;
  mpm::GridLayout layout_;
  Total impulse_;      ///< impulse of the force on the nodes
  double drag_ = 0.0;  ///< kinetic energy that damping of the particles took and nobody was told of [J]
};

}  // namespace mpm_gpu
