// The largest stable time step: a fraction cfl of the time in which a wave on a moving particle, or a point of a tool,
// crosses a cell; viscosity and damping have their own rates. Every particle is looked at in its present state at
// every sync point and some times in between (kernel/survey.hpp, advance.cpp), and what got stiffer since the look
// before is expected to go on doing so until the next. A law's wave speed is that of a solid: in plane stress, where
// thickness gives way, it is an upper bound. Source: method reference 11.
#include <algorithm>
#include <cmath>

#include "shipped_modules.hpp"
#include "state.hpp"

namespace mpm {
namespace {

constexpr double kMostForeseen = 0.5;  ///< the limit is not expected to fall below this part of itself in one period

constexpr double kWorthTelling = 0.99;  ///< a trend below this is reported with the limit

class SceneStep final : public Module {
 public:
  explicit SceneStep(double dt) : dt_(dt) {}
  std::string name() const override { return "time.step"; }
  void limit_step(const PeriodAhead&, StepLimit& limit) const override {
    StepLimit own;
    own.dt = dt_;
    own.by = this;
    limit.tighten(own);
  }

 private:
  double dt_;
};

}  // namespace

void add_step_limit(RunParts& parts) {
  if (parts.definition.time.step) parts.modules.add(std::make_unique<SceneStep>(*parts.definition.time.step));
}

StepLimit Simulation::State::survey_material() const {
  const int dim = layout().dim();
  const double cell = layout().smallest_cell();
  StepLimit limit;
  for (std::size_t s = 0; s < sets.size(); ++s) {
    if (sets[s].awake() == 0) continue;
    const FastestParticle found = mechanics->fastest(static_cast<int>(s), cell);
    StepLimit material;
    material.dt = definition.time.cfl / found.rate;
    material.by = mechanics.get();
    material.part = static_cast<int>(s);
    material.speed = found.rate * cell;
    for (int k = 0; k < dim; ++k) material.place[layout().axis(k)] = sets[s].x[k][found.index];
    limit.tighten(material);
  }
  if (over) over->share(limit, modules, mechanics.get());
  return limit;
}

StepLimit Simulation::State::step_limit(const StepLimit& before, const StepLimit& now) const {
  const PeriodAhead period{1e-9 * static_cast<double>(time), 1e-9 * static_cast<double>(definition.time.sync),
                           definition.time.cfl, layout().smallest_cell()};
  StepLimit limit = now;
  const bool known = now.by != nullptr && before.by != nullptr;  // some material is awake
  const double trend = known ? std::clamp(now.dt / before.dt, kMostForeseen, 1.0) : 1.0;
  limit.dt *= trend;
  limit.foreseen = trend < kWorthTelling;
  for (const Module* module : modules.list()) module->limit_step(period, limit);
  if (over) over->share(limit, modules, mechanics.get());
  if (limit.dt > period.length) limit.by = nullptr;
  return limit;
}

}  // namespace mpm
