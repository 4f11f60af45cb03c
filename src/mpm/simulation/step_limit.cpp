// The largest stable time step: a fraction cfl of a cell for the fastest wave riding on the fastest particle, and for
// the fastest tool. Surveyed at every sync point. Source: method reference 11.
#include <fmt/core.h>

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
double largest_speed(const RigidBody& body) {
  const Box bounds = body.surface().bounds();
  Vec3 corner = bounds.min.cwiseAbs().cwiseMax(bounds.max.cwiseAbs());
  for (int k = 0; k < 3; ++k) {
    if (!std::isfinite(corner[k])) corner[k] = 0.0;
  }
  return body.twist().linear.norm() + body.twist().angular.norm() * corner.norm();
}

}  // namespace

std::pair<double, std::string> Simulation::State::step_limit() const {
  const int dim = grid->layout.dim();
  const double reach = definition.time.cfl * grid->layout.smallest_cell();
  double limit = std::numeric_limits<double>::infinity();
  std::string limited_by = "nothing";
  for (const ParticleSet& set : sets) {
    const Survey s = survey(set, dim, threads);
    const double wave = std::max(wave_speed(set.law, s.min_j), wave_speed(set.law, s.max_j));
    const double allowed = reach / (wave + std::sqrt(s.max_speed2));
    if (!(allowed >= limit)) {
      limit = allowed;
      limited_by = fmt::format("wave speed of '{}'", set.name);
    }
  }
  for (const RigidBody& body : bodies) {
    const double allowed = reach / largest_speed(body);
    if (allowed < limit) {
      limit = allowed;
      limited_by = fmt::format("speed of '{}'", body.name());
    }
  }
  if (definition.time.step && *definition.time.step < limit) {
    limit = *definition.time.step;
    limited_by = "time.step";
  }
  return {limit, limited_by};
}

}  // namespace mpm
