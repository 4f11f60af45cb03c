#include "mpm/step/schedule.hpp"

namespace mpm {
namespace {

using Joint = void (Stage::*)(StepContext&);

void join(Stages& stages, Joint joint, StepContext& context) {
  for (auto& stage : stages) (stage.get()->*joint)(context);
}

// The part that both schedules share: from particles to v^{n+1} and the acceleration on the grid.
void advance_grid(Mechanics& mechanics, Stages& stages, StepContext& context, double strain_dt) {
  mechanics.scatter_momentum(context);
  join(stages, &Stage::momentum_gathered, context);
  join(stages, &Stage::before_strain, context);
  mechanics.strain_and_force(context, strain_dt);
  join(stages, &Stage::forces_gathered, context);
  mechanics.update_momentum(context);
  join(stages, &Stage::momentum_updated, context);
}

}  // namespace

void step_usf(Mechanics& mechanics, Stages& stages, StepContext& context) {
  advance_grid(mechanics, stages, context, context.dt);
  mechanics.move_particles(context);
}

void step_usavg(Mechanics& mechanics, Stages& stages, StepContext& context) {
  advance_grid(mechanics, stages, context, 0.5 * context.dt);
  mechanics.move_and_regather(context);
  join(stages, &Stage::before_strain, context);
  mechanics.strain_and_place(context, 0.5 * context.dt);
}

}  // namespace mpm
