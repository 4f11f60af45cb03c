// Measures of a run of a tool in soil, sync point by sync point: mean force over a stretch of the way, its part across,
// its swing over the travel of a cell, and how pressure differs between the particles of one cell.
#pragma once

#include <string>
#include <vector>

#include "study/tool_force/measure.hpp"
#include "study/tool_force/problem.hpp"

namespace mpm::study::tool_force {

/// Differences of pressure, positive in compression, between particles of one cell, over all looks.
class PressureScatter {
 public:
  /// Particles at `places` [m] of a grid of cells of size `cell` [m].
  void add(const std::vector<Vec3>& places, const std::vector<double>& pressure, double cell);
  /// Standard deviation inside a cell over the mean pressure, both averaged over the cells with at least three
  /// particles; NaN without pressure.
  double scatter() const { return means_ > 0.0 ? deviations_ / means_ : kUnknown; }
  /// Part of the particles with less than 1 % of the mean pressure of all.
  double unloaded() const { return particles_ > 0.0 ? unloaded_ / particles_ : kUnknown; }

 private:
  double deviations_ = 0.0, means_ = 0.0;  ///< sums over cells [Pa]
  double unloaded_ = 0.0, particles_ = 0.0;
};

/// Half the range of `force` over its mean where `travel` lies from `from` on for `stretch`, after the line of least
/// squares has been taken out; samples are averaged over a tenth of the stretch first. NaN where the way is shorter.
double ripple(const std::vector<double>& travel, const std::vector<double>& force, double from, double stretch);

class ForceMeasure final : public Measure {
 public:
  ForceMeasure(const Problem& problem, double cells);
  void look(Simulation& simulation) override;
  bool done() const override { return !travel_.empty() && travel_.back() >= problem_.last(cells_); }
  void report(ForceRow& row) const override;

 private:
  void look_at_particles(const Simulation& simulation);

  const Problem& problem_;
  double cells_;
  double start_ = 0.0;  ///< place of the tool along the push [m]
  bool begun_ = false;
  std::vector<double> travel_, force_, lift_;  ///< over length; [N]
  double next_scatter_;                        ///< travel at which pressure is looked at again
  PressureScatter scatter_;
  std::vector<Vec3> places_;
  std::vector<double> values_;
};

}  // namespace mpm::study::tool_force
