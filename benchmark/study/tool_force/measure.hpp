// Measure of a problem of the suite in a run, sync point by sync point.
#pragma once

#include "mpm/simulation/simulation.hpp"
#include "study/tool_force/row.hpp"

namespace mpm::study::tool_force {

class Measure {
 public:
  virtual ~Measure() = default;
  /// At the start and at each sync point. @throws PhysicsError for a run that has blown up
  virtual void look(Simulation& simulation) = 0;
  /// True if the run has shown all that is measured.
  virtual bool done() const = 0;
  /// Fills in what was measured.
  virtual void report(ForceRow& row) const = 0;
};

/// Fills in `force` and how it compares with the row's answer.
void compare(double value, ForceRow& row);
/// @throws PhysicsError if a particle is faster than a fifth of an elastic wave, which nothing here drives. `values` is
/// memory that it may use
void check_speed(const Simulation& simulation, double wave_speed, std::vector<double>& values);

}  // namespace mpm::study::tool_force
