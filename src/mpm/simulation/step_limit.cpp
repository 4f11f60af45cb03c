// The largest stable time step: a fraction cfl of a cell for the fastest wave riding on the fastest particle of each
// body, and for the fastest point of each tool; a fraction cfl of the time of grid damping. The material is surveyed at
// every sync point. Source: method reference 11.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "state.hpp"

namespace mpm {
namespace {

struct Survey {
  double min_j, max_j, max_speed2;
};

Survey survey(const ParticleSet& set, int dim, int threads) {
  double min_j = std::numeric_limits<double>::infinity(), max_j = 0.0, max_speed2 = 0.0;
#pragma omp parallel for schedule(static) num_threads(threads) reduction(min : min_j) reduction(max : max_j, max_speed2)
  for (int p = 0; p < set.size(); ++p) {
    const double j = particle_tensors(set, dim, p).j;
    double speed2 = 0.0;
    for (int k = 0; k < dim; ++k) speed2 += set.v[k][p] * set.v[k][p];
    min_j = std::min(min_j, j);
    max_j = std::max(max_j, j);
    max_speed2 = std::max(max_speed2, speed2);
  }
  return {min_j, max_j, max_speed2};
}

// Of the body's origin plus what its rotation adds at its farthest corner; endless axes do not count.
double largest_speed(const RigidBody& body, double time) {
  const Box bounds = body.surface().bounds();
  Vec3 corner = bounds.min.cwiseAbs().cwiseMax(bounds.max.cwiseAbs());
  for (int k = 0; k < 3; ++k) {
    if (!std::isfinite(corner[k])) corner[k] = 0.0;
  }
  const Twist twist = body.twist_at(time);
  return twist.linear.norm() + twist.angular.norm() * corner.norm();
}

void tighten(StepLimit& limit, double dt, std::string by) {
  // Not "dt < limit": what is not a number must not pass unnoticed.
  if (!(dt >= limit.dt)) limit = {dt, std::move(by)};
}

}  // namespace

StepLimit Simulation::State::survey_material() const {
  const int dim = grid->layout.dim();
  const double reach = definition.time.cfl * grid->layout.smallest_cell();
  StepLimit limit;
  for (std::size_t s = 0; s < sets.size(); ++s) {
    const Survey found = survey(sets[s], dim, threads);
    const double wave = std::max(wave_speed(laws[s], found.min_j), wave_speed(laws[s], found.max_j));
    tighten(limit, reach / (wave + std::sqrt(found.max_speed2)), fmt::format("wave speed of '{}'", sets[s].name));
  }
  return limit;
}

StepLimit Simulation::State::step_limit() const {
  const double reach = definition.time.cfl * grid->layout.smallest_cell();
  const double start = 1e-9 * static_cast<double>(time), period = 1e-9 * static_cast<double>(definition.time.sync);
  StepLimit limit = material_limit;
  for (const RigidBody& body : bodies) {
    double speed = 0.0;
    for (const double part : {0.0, 0.5, 1.0}) speed = std::max(speed, largest_speed(body, start + part * period));
    if (speed > 0.0) tighten(limit, reach / speed, fmt::format("speed of '{}'", body.name()));
  }
  if (definition.method.damping > 0.0) {
    tighten(limit, definition.time.cfl / definition.method.damping, "method.damping");
  }
  if (definition.time.step) tighten(limit, *definition.time.step, "time.step");
  return limit;
}

}  // namespace mpm
