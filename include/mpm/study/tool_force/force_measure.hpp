// What a run of a tool in soil shows, sync point by sync point: mean force over a stretch of the way, its part across,
// its swing over the travel of a cell, and how pressure differs between the particles of one cell.
#pragma once

#include <string>
#include <vector>

#include "mpm/simulation/simulation.hpp"
#include "mpm/study/tool_force/problem.hpp"
#include "mpm/study/tool_force/row.hpp"

namespace mpm::study::tool_force {

/// Standard deviation of pressure among the particles of a cell over their mean, averaged over the cells by their mean
/// pressure; and the part of the particles with less than 1 % of the mean of all. Cells with fewer than three particles
/// do not count. Pressure is positive in compression.
struct PressureScatter {
  double scatter = kUnknown, unloaded = kUnknown;
};
PressureScatter pressure_scatter(const std::vector<double>& x, const std::vector<double>& z,
                                 const std::vector<double>& pressure, double cell);

/// Half the range of `force` over its mean where `travel` lies from `from` on for `stretch`, after the line of least
/// squares has been taken out; samples are averaged over a tenth of the stretch first. NaN where the way is shorter.
double ripple(const std::vector<double>& travel, const std::vector<double>& force, double from, double stretch);

class ForceMeasure {
 public:
  ForceMeasure(const Problem& problem, double cells);
  /// At each sync point after the start. @throws PhysicsError for a run that has blown up: a particle faster than a
  /// fifth of an elastic wave, which no tool here drives
  void look(Simulation& simulation);
  bool done() const { return !travel_.empty() && travel_.back() >= problem_.last(cells_); }
  /// Fills in what was measured.
  void report(ForceRow& row) const;

 private:
  void look_at_particles(const Simulation& simulation);

  const Problem& problem_;
  double cells_;
  double start_ = 0.0;  ///< of the tool along the push [m]
  bool begun_ = false;
  std::vector<double> travel_, force_, lift_;  ///< over length; [N]
  double next_scatter_;                        ///< travel at which pressure is looked at again
  std::vector<PressureScatter> scatters_;
  std::vector<double> x_, z_, p_, speed_;
  std::vector<double> chosen_x_, chosen_z_, chosen_p_;
};

}  // namespace mpm::study::tool_force
