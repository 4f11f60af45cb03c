#include "mpm/step/schedule.hpp"

namespace mpm {
namespace {

void gather_momentum(Mechanics& mechanics, const Modules& modules, StepContext& context) {
  modules.act(Hook::step_begun, context);
  mechanics.scatter_momentum(context);
  modules.act(Hook::momentum_gathered, context);
}

// XPIC, FMPM: what particles adopt is the grid's velocity and increments of it.
void filter(Mechanics& mechanics, const Modules& modules, StepContext& context) {
  if (mechanics.increments() == 0) return;
  mechanics.begin_increments(context);
  modules.act(Hook::velocity_found, context);
  for (int n = 0; n < mechanics.increments(); ++n) {
    mechanics.find_increment(context);
    modules.act(Hook::increment_found, context);
    mechanics.add_increment(context);
  }
}

// From the internal force to v^{n+1} and the acceleration on the grid, and to what particles adopt of them.
void advance_grid(Mechanics& mechanics, const Modules& modules, StepContext& context) {
  modules.act(Hook::forces_gathered, context);
  mechanics.update_momentum(context);
  modules.act(Hook::momentum_updated, context);
  filter(mechanics, modules, context);
  modules.act(Hook::grid_advanced, context);
}

// The particles' momentum of the end of the step, and the strain that it gives.
void finish_with_strain(Mechanics& mechanics, const Modules& modules, StepContext& context, double dt) {
  mechanics.move_and_regather(context);
  modules.act(Hook::before_strain, context);
  mechanics.strain_and_place(context, dt);
}

}  // namespace

void step_usf(Mechanics& mechanics, const Modules& modules, StepContext& context) {
  context.strain_at_start = strain_at_start(UpdateScheme::usf);
  gather_momentum(mechanics, modules, context);
  modules.act(Hook::before_strain, context);
  mechanics.strain_and_force(context, context.dt);
  advance_grid(mechanics, modules, context);
  mechanics.move_particles(context);
}

void step_usl(Mechanics& mechanics, const Modules& modules, StepContext& context) {
  context.strain_at_start = strain_at_start(UpdateScheme::usl);
  gather_momentum(mechanics, modules, context);
  mechanics.internal_force(context);
  advance_grid(mechanics, modules, context);
  finish_with_strain(mechanics, modules, context, context.dt);
}

void step_usavg(Mechanics& mechanics, const Modules& modules, StepContext& context) {
  context.strain_at_start = strain_at_start(UpdateScheme::usavg);
  gather_momentum(mechanics, modules, context);
  modules.act(Hook::before_strain, context);
  mechanics.strain_and_force(context, 0.5 * context.dt);
  advance_grid(mechanics, modules, context);
  finish_with_strain(mechanics, modules, context, 0.5 * context.dt);
}

void step_implicit(Mechanics& mechanics, const Modules& modules, StepContext& context) {
  context.strain_at_start = 0.0;
  context.works_at_end = true;
  gather_momentum(mechanics, modules, context);
  mechanics.clear_forces(context);
  advance_grid(mechanics, modules, context);
  mechanics.move_particles(context);
}

}  // namespace mpm
