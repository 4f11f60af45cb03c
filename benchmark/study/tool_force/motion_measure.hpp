// Measures of problems that are not about the force on a slow tool: a number over time, and the load that ends a stand.
#pragma once

#include <functional>
#include <vector>

#include "study/tool_force/measure.hpp"
#include "study/tool_force/problem.hpp"

namespace mpm::study::tool_force {

/// Velocity of the material along x, the mean of its particles, which are equal [m/s].
double mean_velocity(const Simulation& simulation, std::vector<double>& values);

/// A number of the run between the times Problem::from and Problem::to [s]: its mean, or its growth in a second, the
/// slope of the line of least squares.
class SeriesMeasure final : public Measure {
 public:
  enum class Kind { mean, growth };
  using Read = std::function<double(Simulation&)>;
  SeriesMeasure(const Problem& problem, Kind kind, Read read)
      : problem_(problem), kind_(kind), read_(std::move(read)) {}

  void look(Simulation& simulation) override;
  bool done() const override { return !time_.empty() && time_.back() > problem_.to - 1e-9; }
  void report(ForceRow& row) const override;

 private:
  const Problem& problem_;
  Kind kind_;
  Read read_;
  std::vector<double> time_, value_;
  std::vector<double> scratch_;
};

/// The load at which what stood falls, of a load that grows with time by `rate` [1/s]: when the fastest three particles
/// of a hundred pass a speed. Weak: what falls under a load beyond the limit by rate t accelerates by as much, so the
/// load is read too high by that of the time in which it reaches the speed.
class CollapseMeasure final : public Measure {
 public:
  /// `speed` [m/s]
  CollapseMeasure(const Problem& problem, double rate, double speed) : problem_(problem), rate_(rate), speed_(speed) {}

  void look(Simulation& simulation) override;
  bool done() const override { return last_speed_ >= speed_; }
  void report(ForceRow& row) const override;

 private:
  const Problem& problem_;
  double rate_, speed_;
  double last_time_ = 0.0, last_speed_ = 0.0;
  std::vector<std::pair<double, double>> curve_;  ///< load over the answer, speed
  std::vector<double> scratch_;
};

}  // namespace mpm::study::tool_force
