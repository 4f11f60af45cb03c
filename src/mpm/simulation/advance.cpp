// The way from one sync point to the next: equal steps as the limit at the period's start allows. In between the
// particles are looked at again, and where they have got so fast or stiff that a wave would nearly cross a cell in a
// step, the rest of the period is divided anew. Between two such looks a wave may outrun a cell all the same; this does
// not end a run, since a few such steps do no harm that lasts. A run that they do harm makes energy, and ends by that
// (energy_watch.hpp).
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "mpm/mechanics/stress_average.hpp"
#include "mpm/simulation/rank_failure.hpp"
#include "state.hpp"

namespace mpm {
namespace {

constexpr int kStepsBetweenLooks = 16;  ///< a look at all particles costs a fiftieth of a step

/// Equal steps to the next sync point.
struct EqualSteps {
  int number;
  double dt;  ///< [s]
};

/// The longest equal steps within the limit; `now` [s] is for the message. @throws PhysicsError
EqualSteps equal_steps(double length, const StepLimit& limit, double now) {
  const double count = std::max(1.0, std::ceil(length / limit.dt - 1e-9));
  if (!(limit.dt > 0.0) || !(count <= kMostSteps)) {
    throw PhysicsError(
        fmt::format("the time step fell to {:.3g} s at t = {:.6g} s, limited by the {}: look for what "
                    "runs away, or lower time.sync when such steps are meant",
                    limit.dt, now, limit.text()));
  }
  return {static_cast<int>(count), length / count};
}

/// True if a step of dt comes nearer to the one in which a wave crosses a whole cell, dt_limit / cfl, than to dt_limit.
bool comes_too_near(double dt, double dt_limit, double cfl) { return !(dt <= dt_limit / std::sqrt(cfl)); }

/// After how many steps of dt the particles are looked at again, when the limit went from `before` to `now` in so many
/// steps: half of those in which the steps would come too near, if what allows them went on changing as it did.
int steps_until_look(double before, double now, int steps, double dt, double cfl) {
  const double growth = (1.0 / now - 1.0 / before) / steps;
  if (!(growth > 0.0)) return kStepsBetweenLooks;
  const double left = (1.0 / (dt * std::sqrt(cfl)) - 1.0 / now) / growth;
  return static_cast<int>(std::clamp(0.5 * left, 1.0, static_cast<double>(kStepsBetweenLooks)));
}

}  // namespace

void Simulation::State::see_courant(double dt, const StepLimit& found) {
  if (definition.method.update == UpdateScheme::implicit) return;  // no wave is resolved
  steps.courant = std::max(steps.courant, dt * definition.time.cfl / found.dt);
}

bool Simulation::State::step(double start, double dt, bool more) {
  for (auto& robot : robots) robot->begin_step(start, dt);
  for (RigidBody& body : bodies) body.begin_step(start, dt);
  StepContext context{fields, dt, start};
  constexpr std::array kSchedules = {&step_usf, &step_usl, &step_usavg,
                                     &step_implicit};  // in the order of UpdateScheme
  if (device) {
    fetched = Device::Numbers::none;
    context.strain_at_start = strain_at_start(definition.method.update);
    if (host_contact) host_contact->begin_step(context);
    if (rest_on_host) rest_on_host->begin_step(context);
    device->step(start, dt);
  } else {
    kSchedules[static_cast<int>(definition.method.update)](*mechanics, modules, context);
  }
  gravity.add(definition.gravity * (total_mass * dt));
  for (auto& robot : robots) robot->end_step();
  for (RigidBody& body : bodies) body.end_step(dt);
  timed("modules: end of a step", [&] {
    for (Module* module : modules.list()) module->step_ended();
  });
  ++steps.steps;
  steps.dt_last = dt;
  steps.dt_min = steps.steps == 1 ? dt : std::min(steps.dt_min, dt);
  steps.dt_max = std::max(steps.dt_max, dt);
  const auto asks = [](const Module* module) { return module->needs_sort(); };
  const std::vector<Module*>& list = modules.list();
  StepFlags now{mechanics->failed().has_value(), std::any_of(list.begin(), list.end(), asks),
                more && asked_to_stop && asked_to_stop(), false};
  if (over) {
    now = over->shared(now, *mechanics);
  } else if (device) {
    now.sorts = now.sorts || (rest_on_host && rest_on_host->has_left());
  } else {
    now.sorts = now.sorts || mechanics->needs_sort();
  }
  if (now.failed) {
    check_together([&] {
      const auto particle = mechanics->failed();
      if (!particle) return;
      fail("the volume ratio J is not positive", *particle, start + dt,
           "lower time.cfl, use a finer grid.cell or slower tools, or stiffen what is crushed");
    });
  }
  if (now.sorts) {
    timed("sorting of particles", [&] { sort(start + dt); });
  } else if (now.meets) {
    meet_again();
  }
  return now.stops;
}

void Simulation::State::fetch(Device::Numbers which) {
  if (fetched >= which) return;
  ask_device([&] { device->fetch(sets, which); });
  fetched = which;
  moved_by_device = true;
  tell_modules();
}

void Simulation::State::begin_modules() {
  for (Module* module : modules.list()) {
    if (auto* average = dynamic_cast<StressAverage*>(module)) average->begin();
  }
}

void Simulation::State::hand_to_device(const DeviceMaker& maker) {
  begin_modules();
  device = maker.make(definition, sets, {*mechanics, modules, host_contact.get(), rest_on_host.get()});
  for (const Module* module : modules.list()) module->teach(*device);
}

void Simulation::State::tell_modules() {
  ask_device([&] {
    device->tell_modules();
    for (Module* module : modules.list()) module->count(*device);
  });
}

void Simulation::State::run_period() {
  const TimeProfile::Use use(profile);
  if (device) device->make_room();
  // Implicit steps resolve motion, whose limit is its own.
  const double cfl = definition.method.update == UpdateScheme::implicit ? 1.0 : definition.time.cfl;
  const double begin = seconds_of(time);
  const double period = seconds_of(definition.time.sync), end = begin + period;
  limit = step_limit(previous_limit, material_limit);
  EqualSteps steps_ahead = equal_steps(period, limit, begin);
  StepLimit seen = material_limit;
  int until_look = steps_until_look(previous_limit.dt, seen.dt, steps_ahead.number, steps_ahead.dt, cfl);
  int since_look = 0;
  const auto timed_survey = [this] { return timed("limit of the time step", [this] { return survey_material(); }); };
  double part_begin = begin;  // start of those steps
  bool divided = false;
  for (int k = 0; k < steps_ahead.number; ++k) {
    const bool more = k + 1 < steps_ahead.number;
    const bool stops = step(part_begin + k * steps_ahead.dt, steps_ahead.dt, more);
    if (!more) break;
    if (stops) {
      throw StoppedError(fmt::format("stopped within a sync period, {} of {} steps after t = {:.6g} s", k + 1,
                                     steps_ahead.number, part_begin));
    }
    if (++since_look < until_look) continue;
    const StepLimit now = timed_survey();
    see_courant(steps_ahead.dt, now);
    const double reached = part_begin + (k + 1) * steps_ahead.dt;
    const bool too_near = comes_too_near(steps_ahead.dt, now.dt, cfl);
    if (too_near || energy_watch.due(steps.steps)) watch_energy(reached, now);
    if (too_near) {
      part_begin = reached;
      limit = step_limit(seen, now);
      steps_ahead = equal_steps(end - part_begin, limit, part_begin);
      divided = true;
      k = -1;
    }
    until_look = steps_until_look(seen.dt, now.dt, since_look, steps_ahead.dt, cfl);
    since_look = 0;
    seen = now;
  }
  if (device) tell_modules();  // before the clock goes on, since this may find that a step has failed
  time += definition.time.sync;
  timed("modules: sync point", [&] {
    for (Module* module : modules.list()) module->at_sync(time);
  });
  if (services.bed != nullptr) timed("ground: made and put away", [this] { follow_bed(); });
  previous_limit = material_limit;
  material_limit = timed_survey();
  equal_steps(period, material_limit, end);  // ends the run for what is not finite, before it is told of
  see_courant(steps_ahead.dt, material_limit);
  if (divided) ++steps.divided;
  if (energy_watch.due(steps.steps)) watch_energy(end, material_limit);
}

// Ends the run for a fault in the particles or nodes of one rank, which the others do not know of; nothing is
// written.
void Simulation::State::end_run(const std::string& reason) const {
  if (over) throw RankFailure(reason);
  throw PhysicsError(reason);
}

void Simulation::advance(std::chrono::steady_clock::duration late) {
  State& s = *state_;
  if (s.failed) throw PhysicsError("the run has failed and cannot go on; start it again");
  const auto started = std::chrono::steady_clock::now();
  s.failed = true;  // until the period is done
  SweepBudget* budget = s.services.budget.get();
  if (budget != nullptr) budget->begin_period(s.steps.steps, seconds_of(s.time + s.definition.time.sync), late);
  try {
    s.run_period();
  } catch (const ModuleError& error) {
    s.end_run(error.what());
  } catch (const RigidError& error) {
    s.end_run(fmt::format("{} (in the sync period from t = {:.6g} s)", error.what(), seconds_of(s.time)));
  } catch (const FunctionError& error) {
    s.end_run(fmt::format("motion of a rigid body, or a law of contact, at t = {:.6g} s: {}", seconds_of(s.time),
                          error.what()));
  }
  s.failed = false;
  if (budget != nullptr) budget->end_period();
  s.wall += std::chrono::steady_clock::now() - started;
  sample_metrics();
}

}  // namespace mpm
