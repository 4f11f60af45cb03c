// The choices that set how fast and how exact a run is: cell, particles a cell, precision, update and time step.
#pragma once

#include <string>
#include <vector>

#include "mpm/definition/definition.hpp"

namespace mpm::pace {

struct Discretisation {
  Vec3 cell = Vec3::Zero();  ///< along each axis [m]
  int along = 2;             ///< particles along a cell's edge
  Precision precision = Precision::float64;
  UpdateScheme update = UpdateScheme::usavg;
  double cfl = 0.5;    ///< part of a cell that the fastest wave may travel in an explicit step
  double step = 0.0;   ///< length of implicit steps [s]; 0: they are explicit
  double falls = 0.0;  ///< that length over sqrt(cell / gravity), in which the force of soil on a tool depends on it

  bool implicit() const { return step > 0.0; }
};

/// Discretisation::falls of a length of implicit steps [s] in cells of this size.
double falls_of(double step, const Vec3& cell, const SimulationDefinition& definition);
/// That of a run.
Discretisation discretisation_of(const SimulationDefinition& definition);

/// Keys of a scene that a discretisation stands for: "grid.cell", "method.particles_per_cell", "method.precision",
/// "method.update", "time.cfl", "time.step".
const std::vector<std::string>& discretisation_keys();

/// Differences from `before`, a text "key=value" for each key, as `run_scene --set` takes it, whatever the scene's
/// units are.
std::vector<std::string> set_lines(const Discretisation& chosen, const Discretisation& before, GeometryKind geometry);
/// All of it in a line: "cell 0.035 m, 8 particles a cell, single, usf, cfl 0.9", of implicit steps their length.
std::string discretisation_text(const Discretisation& one, GeometryKind geometry);

/// The largest time.cfl that is chosen with a transfer: a tenth below the largest that is known to be stable
/// (stable_cfl()), for waves that become faster while material is compressed.
double safe_cfl(const Transfer& transfer);

}  // namespace mpm::pace
