// The pace that a run is expected to have on this machine: by a cost of its steps that was kept, or by timing a copy of
// it for a part of a second. The run itself is not touched, so its bits are the same. A run that ends leaves its own
// cost, which knows what the first steps do not: tools that reach the material later, and soil that flows.
#pragma once

#include <optional>
#include <string>

#include "mpm/pace/changes.hpp"
#include "mpm/scene/scene.hpp"
#include "mpm_ros/run/run.hpp"

namespace mpm_ros {

struct ExpectedPace {
  mpm::pace::Forecast forecast;
  std::string origin;    ///< "70 steps timed 2 h ago"
  mpm::pace::Plan plan;  ///< changes that would bring it to the wanted pace
};

/// Steps are timed for so long at most, the time to build a copy left out [s].
inline constexpr double kTimingBudget = 0.4;

/// Foresees a run to be made. `may_time`: where no cost is kept, a copy is timed, which takes a second at most, and
/// rehearsed, which takes as long; not of scenes with more than a million particles. Returns nothing where the cost is
/// not known, or the scene cannot be simulated.
/// @throws mpm::StoppedError
std::optional<ExpectedPace> expected_pace(const mpm::Scene& scene, const RunOptions& options, double wanted,
                                          bool may_time);
/// "0.13 of real time expected on 2 threads; 1.5 s will take 11 s of wall time (2100 steps of 5.4 ms); 70 steps timed"
std::string expected_text(const ExpectedPace& pace);
/// "real time is not in reach: ...", and what would reach it; empty where it is in reach.
std::string pace_warning(const ExpectedPace& pace);

/// Keeps what a step of a run has cost, unless more steps were timed before. Sums over the particles once.
void keep_reached_pace(const mpm::Scene& scene, int threads_asked, const mpm::Simulation& simulation);

/// For --explain: times the simulation's own steps and keeps their cost, unless that of a run is kept, and times copies
/// with what could be changed where it is slower than real time. Several lines. @throws mpm::StoppedError
std::string explain_pace(const mpm::Scene& scene, mpm::Simulation& simulation, mpm::pace::StepTimer& timer,
                         int threads);

}  // namespace mpm_ros
