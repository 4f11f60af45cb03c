// The choices that set how fast and how exact a run is: cell, particles a cell, precision, update and time step.
#pragma once

#include <string>
#include <vector>

#include "mpm/simulation/definition.hpp"

namespace mpm::pace {

struct Discretisation {
  Vec3 cell = Vec3::Zero();  ///< along each axis [m]
  int along = 2;             ///< particles along a cell's edge
  Precision precision = Precision::float64;
  UpdateScheme update = UpdateScheme::usavg;
  double cfl = 0.5;  ///< part of a cell that the fastest wave may travel in a step
};

/// That of a run.
Discretisation discretisation_of(const SimulationDefinition& definition);

/// Keys of a scene that a discretisation stands for: "grid.cell", "method.particles_per_cell", "method.precision",
/// "method.update", "time.cfl".
const std::vector<std::string>& discretisation_keys();

/// What differs from `before`, a text "key=value" for each key, as `run_scene --set` takes it, whatever the scene's
/// units are.
std::vector<std::string> set_lines(const Discretisation& chosen, const Discretisation& before, GeometryKind geometry);
/// All of it in a line: "cell 0.035 m, 8 particles a cell, single, usf, cfl 0.9".
std::string discretisation_text(const Discretisation& one, GeometryKind geometry);

/// The largest time.cfl that is chosen with a transfer: a tenth below the largest that is known to be stable
/// (stable_cfl()), for waves that become faster while material is compressed.
double safe_cfl(const Transfer& transfer);

}  // namespace mpm::pace
