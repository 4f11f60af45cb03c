// Single steps of a simulation, of any size: the solver itself refuses steps above the limit set by waves, and the
// atlas examines what happens there. Only the checks inside a step are made.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "../../src/mpm/simulation/state.hpp"

namespace mpm {

class SimulationProbe {
 public:
  explicit SimulationProbe(const SimulationDefinition& definition, int threads = 1)
      : simulation_(definition, {threads}), state_(*simulation_.state_) {}

  /// Makes one step of `dt` [s]. @throws PhysicsError
  void step(double dt) {
    state_.step(time_, dt, false);
    time_ += dt;
  }
  /// Advances to the next sync point, in steps that the solver chooses. @throws PhysicsError
  void advance() {
    simulation_.advance();
    time_ = 1e-9 * static_cast<double>(simulation_.time());
  }
  double time() const { return time_; }  ///< [s]
  /// Modules of the run, for a device.
  RunModules modules() { return {*state_.mechanics, state_.modules, nullptr}; }
  const Simulation& simulation() const { return simulation_; }
  /// Particles of the first body, in an order that a step may change; set.id identifies them.
  ParticleSet& set() { return state_.sets[0]; }
  /// The same of all bodies.
  std::vector<ParticleSet>& sets() { return state_.sets; }
  /// Sorts the particles after they were moved from outside.
  void sort() { state_.sort(time_); }
  /// Pose and motion of a rigid body.
  const RigidBody& body(int index) const { return state_.bodies[index]; }

  /// Sum of v^2 over the first body's particles; not finite when any is not [m^2/s^2].
  double motion() const {
    double sum = 0.0;
    for (const ParticleScalar& v : state_.sets[0].v) {
      for (std::size_t p = 0; p < v.size(); ++p) sum += v[p] * v[p];
    }
    return sum;
  }

 private:
  Simulation simulation_;
  Simulation::State& state_;
  double time_ = 0.0;
};

}  // namespace mpm

namespace stability {
using Probe = mpm::SimulationProbe;
}
