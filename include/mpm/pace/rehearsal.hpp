// A rehearsal of a run finds what is still to come when its first steps are timed: material that falls asleep or wakes,
// tools that touch later, soil that stiffens. It is the same scene on a grid so coarse that all of it, or a good part,
// can be run first. How many particles are awake, when a tool touches and how steps shorten hardly depend on the cell;
// what a step costs does, and that is timed on the run's own grid.
//
// Weak: blocks of a coarse grid are larger, so more of the material round a tool is awake in them, for which two
// rehearsals are needed to allow; a tool much smaller
// than the coarse cell may touch little; what lies beyond the budget is taken to go on as the last quarter before.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "mpm/pace/step_cost.hpp"
#include "mpm/pace/tool_use.hpp"

namespace mpm::pace {

struct Rehearsal {
  double coarser = 1.0;           ///< times as wide are the cells
  double reached = 0.0;           ///< part of the run
  double wall = 0.0;              ///< time that it took [s]
  double awake = 1.0;             ///< part of the particles, mean over the steps of the run
  double touched = 0.0;           ///< part of the steps in which a tool touched
  double contact = 1.0;           ///< cost of an awake particle's step while a tool touches over that while none does
  double steps = 1.0;             ///< steps a second in the whole run over those at its start
  double particle_step = 0.0;     ///< cost of the step of an awake particle [s]
  std::vector<ToolAtWork> tools;  ///< in the ground, now or later, if they were asked for
};

/// Runs `coarse` for a budget of wall time [s] at most, settling included. `coarser`: how many times its cells are as
/// wide as those of the run. `with_tools`: tools are looked at, which takes a part of the budget. Returns nothing where
/// it could not be run or not one sync period was made.
/// @throws StoppedError when `stop` was true, std::bad_alloc
std::optional<Rehearsal> rehearse(SimulationDefinition coarse, double coarser, int threads, std::optional<Isa> isa,
                                  double budget, const std::function<bool()>& stop = {},
                                  const WallClock& clock = steady_seconds, bool with_tools = false);

/// The mean cost of the run's steps, and their number a second, from those that were timed at its start.
StepCost of_whole_run(const StepCost& start, const Rehearsal& rehearsal, std::uint64_t particles);

/// Part of the particles that is awake on the run's own grid, by rehearsals on two coarser ones, of `axes` axes: what
/// sleeps does so by blocks, so the part falls as a power of the cell, between 0 (all that moves fills many blocks) and
/// the number of axes (it lies in a few).
double awake_by(const Rehearsal& coarse, const Rehearsal& fine, int axes);

/// By how much cells have to be wider, so that what takes `seconds` takes `budget` [s]: cost goes as the cell to the
/// power of the axes, and of one more for time. Below 1 where they can be smaller.
double cell_factor(double seconds, double budget, int axes);

}  // namespace mpm::pace
