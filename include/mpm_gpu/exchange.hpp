// From a run of the solver to one of this library, and back: the same scene runs on both. What this library does not
// have is refused by the table of features (mpm/rules/feature_rules.hpp).
#pragma once

#include <string>
#include <vector>

#include "mpm/definition/definition.hpp"
#include "mpm/grid/grid_layout.hpp"
#include "mpm/material/law.hpp"
#include "mpm/particles/particle_set.hpp"
#include "mpm/step/device.hpp"
#include "mpm_gpu/solver.hpp"

namespace mpm_gpu {

/// The sentence of the table that refuses a scene's steps there; empty where they run.
std::string refused(const mpm::SimulationDefinition& definition);

/// A run of this library that begins with the particles of a simulation, and its laws.
template <class T>
class DeviceRun {
 public:
  /// `sets`: of an assembled Simulation of this definition, of precision T; every set has the name of its body. The run
  /// has the particles that are awake.
  /// `modules`: those of a simulation whose steps this takes, which outlive it. @throws GpuError for what is refused
  DeviceRun(const mpm::SimulationDefinition& definition, const std::vector<mpm::ParticleSet>& sets,
            Executor executor = Executor(), const mpm::RunModules* modules = nullptr);

  Solver<T>& solver() { return solver_; }
  /// Writes the particles' numbers back, each to where its id lies. They have moved: the simulation has to sort them.
  /// Their places at the start go around periodic axes as they have done since places were last asked for.
  void write_to(std::vector<mpm::ParticleSet>& sets, mpm::Device::Numbers which = mpm::Device::Numbers::all);

 private:
  mpm::GridLayout layout_;
  std::vector<mpm::Law> laws_;  ///< laws of the sets, to which the solver points
  Solver<T> solver_;
};

}  // namespace mpm_gpu
