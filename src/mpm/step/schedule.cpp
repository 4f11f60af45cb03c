#include "mpm/step/schedule.hpp"

namespace mpm {
namespace {

using Joint = void (Stage::*)(StepContext&);

void join(Stages& stages, Joint joint, StepContext& context) {
  for (auto& stage : stages) (stage.get()->*joint)(context);
}

void gather_momentum(Mechanics& mechanics, Stages& stages, StepContext& context) {
  mechanics.scatter_momentum(context);
  join(stages, &Stage::momentum_gathered, context);
}

// XPIC, FMPM: what particles adopt is the grid's velocity and increments of it.
void filter(Mechanics& mechanics, Stages& stages, StepContext& context) {
  if (mechanics.increments() == 0) return;
  NodalField& increment = context.grid.increment;
  mechanics.begin_increments(context);
  for (auto& stage : stages) stage->velocity_found(context, increment);
  for (int n = 0; n < mechanics.increments(); ++n) {
    mechanics.find_increment(context);
    for (auto& stage : stages) stage->increment_found(context, increment);
    mechanics.add_increment(context);
  }
}

// From the internal force to v^{n+1} and the acceleration on the grid, and to what particles adopt of them.
void advance_grid(Mechanics& mechanics, Stages& stages, StepContext& context) {
  join(stages, &Stage::forces_gathered, context);
  mechanics.update_momentum(context);
  join(stages, &Stage::momentum_updated, context);
  filter(mechanics, stages, context);
  join(stages, &Stage::grid_advanced, context);
}

// The particles' momentum of the end of the step, and the strain that it gives.
void finish_with_strain(Mechanics& mechanics, Stages& stages, StepContext& context, double dt) {
  mechanics.move_and_regather(context);
  join(stages, &Stage::before_strain, context);
  mechanics.strain_and_place(context, dt);
}

}  // namespace

void step_usf(Mechanics& mechanics, Stages& stages, StepContext& context) {
  gather_momentum(mechanics, stages, context);
  join(stages, &Stage::before_strain, context);
  mechanics.strain_and_force(context, context.dt);
  advance_grid(mechanics, stages, context);
  mechanics.move_particles(context);
}

void step_usl(Mechanics& mechanics, Stages& stages, StepContext& context) {
  gather_momentum(mechanics, stages, context);
  mechanics.internal_force(context);
  advance_grid(mechanics, stages, context);
  finish_with_strain(mechanics, stages, context, context.dt);
}

void step_usavg(Mechanics& mechanics, Stages& stages, StepContext& context) {
  gather_momentum(mechanics, stages, context);
  join(stages, &Stage::before_strain, context);
  mechanics.strain_and_force(context, 0.5 * context.dt);
  advance_grid(mechanics, stages, context);
  finish_with_strain(mechanics, stages, context, 0.5 * context.dt);
}

}  // namespace mpm
