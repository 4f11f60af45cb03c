// A block in free flight with a uniform velocity gradient L. After one step the particles inside have the deformation
// gradient exp(L dt) with any method, since the grid reproduces linear fields.
#pragma once

#include <string>

#include "mpm/simulation/simulation.hpp"

namespace mpm::test {

constexpr double kSide = 0.8, kBlockCell = 0.1, kBlockStep = 1e-6;  // [m] [m] [s]
constexpr double kBlockDensity = 1000.0;

/// A block of 16 particles along each axis with its middle at (1, 1, 1) m. `rate`: L [1/s]; `drift`: velocity of the
/// middle [m/s]. A sync period is one step.
inline SimulationDefinition observed_block(const LawDefinition& law, const Eigen::Matrix3d& rate,
                                           const Vec3& drift = Vec3::Zero()) {
  SimulationDefinition d;
  d.grid = {Vec3::Constant(kBlockCell), Vec3::Zero(), Vec3::Constant(2.0)};
  d.time.sync = 1000;
  d.time.step = kBlockStep;
  d.materials = {{"stuff", kBlockDensity, law}};
  DeformableBody body;
  body.name = "block";
  body.material = "stuff";
  const int n = 16;
  const double spacing = kSide / n;
  body.particle_volume = spacing * spacing * spacing;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      for (int k = 0; k < n; ++k) {
        const Vec3 from_middle = spacing * Vec3(i + 0.5, j + 0.5, k + 0.5) - Vec3::Constant(0.5 * kSide);
        body.positions.emplace_back(Vec3::Constant(1.0) + from_middle);
        body.velocities.emplace_back(drift + rate * from_middle);
      }
    }
  }
  d.bodies = {body};
  return d;
}

/// The value of `field` at a particle next to the middle.
inline double inside(const Simulation& simulation, const std::string& field) {
  std::vector<double> values;
  simulation.particle_field(field, values);
  return values[(7 * 16 + 7) * 16 + 7];
}

}  // namespace mpm::test
