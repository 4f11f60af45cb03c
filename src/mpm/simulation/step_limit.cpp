// The largest stable time step: a fraction cfl of the time in which a wave on a moving particle, or a point of a tool,
// crosses a cell; viscosity and damping have their own rates. Every particle is looked at in its present state at
// every sync point (kernel/survey.hpp), and what got stiffer in the last period is expected to go on doing so in the
// next. A law's wave speed is that of a solid: in plane stress, where thickness gives way, it is an upper bound.
// Source: method reference 11.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "state.hpp"

namespace mpm {
namespace {

constexpr double kMostForeseen = 0.5;  ///< the limit is not expected to fall below this part of itself in one period

constexpr double kWorthTelling = 0.99;  ///< a trend below this is told with the limit

// Of the body's origin plus what its rotation adds at its farthest corner. A body without end ends with the domain,
// `domain` long, and does not count along an axis that the grid does not have. Of a ring the middle of the section is
// fastest, as the last that goes in proportion to the inner face (RigidBody::velocity_at).
// Of a body that is free, with what gravity and the applied wrench add in `ahead` [s].
double largest_speed(const RigidBody& body, double time, const Vec3& domain, double gravity, double ahead) {
  const Box bounds = body.surface().bounds();
  Vec3 corner = bounds.min.cwiseAbs().cwiseMax(bounds.max.cwiseAbs());
  for (int k = 0; k < 3; ++k) {
    if (!std::isfinite(corner[k])) corner[k] = domain[k] > 0.0 ? domain.norm() : 0.0;
  }
  const Twist twist = body.twist_at(time);
  const double inner = body.definition().inner_radius, opened = body.pose().position.x();
  const double spread = inner > 0.0 ? 0.5 * (inner + bounds.max.x() + 2.0 * opened) / (inner + opened) : 1.0;
  double gained = 0.0;
  if (const FreeMotion* free = body.free_motion()) {
    gained = ahead * (gravity + free->wrench().force.norm() / free->definition().mass);
  }
  return spread * twist.linear.norm() + twist.angular.norm() * corner.norm() + gained;
}

void tighten(StepLimit& limit, const StepLimit& other) {
  // Not "other < limit": what is not a number must not pass unnoticed.
  if (!(other.dt >= limit.dt)) limit = other;
}

}  // namespace

std::string StepLimit::text() const {
  switch (cause) {
    case Cause::nothing:
      return "nothing";
    case Cause::material:
      return fmt::format(
          "wave speed of '{}' ({:.4g} m/s with its motion and viscosity{}) at ({:.4g}, {:.4g}, {:.4g}) m", *name, speed,
          foreseen ? ", and growing" : "", place.x(), place.y(), place.z());
    case Cause::tool:
      return fmt::format("speed of '{}' ({:.4g} m/s)", *name, speed);
    case Cause::damping:
      return "method.damping";
    case Cause::scene:
      return "time.step";
    case Cause::period:
      return "sync period";
  }
  return {};
}

StepLimit Simulation::State::survey_material() const {
  const int dim = layout().dim();
  const double cell = layout().smallest_cell();
  StepLimit limit;
  for (std::size_t s = 0; s < sets.size(); ++s) {
    const FastestParticle found = mechanics->fastest(static_cast<int>(s), cell);
    StepLimit material;
    material.dt = definition.time.cfl / found.rate;
    material.cause = StepLimit::Cause::material;
    material.name = &sets[s].name;
    material.speed = found.rate * cell;
    for (int k = 0; k < dim; ++k) material.place[layout().axis(k)] = sets[s].x[k][found.index];
    tighten(limit, material);
  }
  return limit;
}

StepLimit Simulation::State::step_limit() const {
  const double reach = definition.time.cfl * layout().smallest_cell();
  const double start = 1e-9 * static_cast<double>(time), period = 1e-9 * static_cast<double>(definition.time.sync);
  StepLimit limit = material_limit;
  const double trend = std::clamp(material_limit.dt / previous_limit.dt, kMostForeseen, 1.0);
  limit.dt *= trend;
  limit.foreseen = trend < kWorthTelling;
  Vec3 domain = definition.grid.max - definition.grid.min;
  for (const int axis : axes_beside(definition.geometry)) domain[axis] = 0.0;
  for (const RigidBody& body : bodies) {
    StepLimit tool;
    for (const double part : {0.0, 0.5, 1.0}) {
      tool.speed = std::max(
          tool.speed, largest_speed(body, start + part * period, domain, definition.gravity.norm(), part * period));
    }
    tool.dt = reach / tool.speed;
    tool.cause = StepLimit::Cause::tool;
    tool.name = &body.name();
    if (tool.speed > 0.0) tighten(limit, tool);
  }
  for (const VelocityConditions* all : conditions) {
    StepLimit condition;
    for (const double part : {0.0, 0.5, 1.0}) {
      condition.speed = std::max(condition.speed, all->largest_speed(start + part * period));
    }
    condition.dt = reach / condition.speed;
    condition.cause = StepLimit::Cause::tool;
    condition.name = &kConditionsName;
    if (condition.speed > 0.0) tighten(limit, condition);
  }
  if (damping != nullptr) {
    const double energy = damping->needs_energy() ? kinetic_energy() : 0.0;
    const double rate = damping->largest_rate(start, period, energy, layout());
    StepLimit damped;
    damped.dt = definition.time.cfl / rate;
    damped.cause = StepLimit::Cause::damping;
    if (rate > 0.0) tighten(limit, damped);
  }
  if (definition.time.step) {
    StepLimit scene;
    scene.dt = *definition.time.step;
    scene.cause = StepLimit::Cause::scene;
    tighten(limit, scene);
  }
  if (limit.dt > period) limit.cause = StepLimit::Cause::period;
  return limit;
}

}  // namespace mpm
