// The stages that a scene needs beside the plain step, made for a solver of this library.
#pragma once

#include <vector>

#include "mpm/definition/definition.hpp"
#include "mpm/material/law.hpp"
#include "mpm/particles/particle_set.hpp"
#include "mpm/step/device.hpp"
#include "mpm_gpu/solver.hpp"

namespace mpm_gpu {

/// Adds them. `sets`: of an assembled Simulation of this definition, `laws` those of each. `modules`: those of the
/// simulation whose steps the solver takes, which outlive it; null without one.
template <class T>
void add_stages(Solver<T>& solver, const mpm::SimulationDefinition& definition,
                const std::vector<mpm::ParticleSet>& sets, const std::vector<mpm::Law>& laws,
                const mpm::RunModules* modules);

/// Returns which of the energies that PIC and damping take are asked for.
Counting counting_of(const mpm::MethodDefinition& method);

}  // namespace mpm_gpu
