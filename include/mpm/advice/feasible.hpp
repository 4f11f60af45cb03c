// Refuses scenes that are right in every key and still cannot be run: more particles than can be numbered or held in
// memory, or steps so short that no run of them can be meant.
#pragma once

#include <string>
#include <vector>

#include "mpm/scene/scene.hpp"

namespace mpm {

/// The time step that the stiffest material of the scene's bodies asks for before it is strained.
struct WaveStep {
  double dt = 0.0;       ///< in which the wave crosses time.cfl of the smallest cell [s]
  double speed = 0.0;    ///< speed of the wave [m/s]
  std::string material;  ///< its name
};
WaveStep wave_step(const Scene& scene);
/// Number of particles that a scene will have, about.
double expected_particles(const Scene& scene);

/// Refuses too many particles, before any is made. `part`: of the particles, what this machine has, where several share
/// them. @throws SceneError with their number and memory
void check_particles(const Scene& scene, double part = 1.0);
/// Refuses more steps in a sync period than Simulation takes. @throws SceneError
void check_steps(const Scene& scene);
/// Refuses transport whose steps would not come to an end (rules/transport_work.hpp). @throws SceneError
void check_transport(const Scene& scene);
/// Message for refused memory: the number of particles, and the least memory that they need.
std::string lack_of_memory(const Scene& scene);

}  // namespace mpm
