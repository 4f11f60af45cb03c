#include "mpm/pace/target_keys.hpp"

namespace mpm::pace {

const KeyTable<Target>& target_keys() {
  static const char* const kRecord =
      "written by the solver: what was chosen, what those keys were before, for which target, and what is expected of "
      "it";
  static const auto keys = KeyTable<Target>("target").rows(
      {number(
           "real_time", &Target::real_time, kPlain, kPositive,
           {"this or `force_error`",
            "pace asked for, simulated over wall time; a choice is expected to be a tenth faster, and to err by 40 % "
            "of the force at most, where that is known",
            "1"}),
       number("force_error", &Target::force_error, kPlain, mpm::between(0.0, 1.0),
              {"this or `real_time`", "error of the force on the tool asked for", "5 %"}),
       other<Target>("keep", "list of keys",
                     {"none",
                      "what stays as the scene has it, of `grid.cell`, `method.particles_per_cell`, "
                      "`method.precision`, `method.update`, `time.cfl`, `time.step`",
                      "[grid.cell]"}),
       word("tool", &Target::use, words_of(kToolUseNames),
            {"found in a rehearsal",
             "what tools do to the ground: dig across it, are pressed in along gravity, or roll. Write it where "
             "commands will move the tool: without it nothing is promised of such a tool",
             "blade"}),
       number(
           "length", &Target::length, kLength, kPositive,
           {"found in a rehearsal: the depth to which a blade or a wheel reaches, the width of a plate across gravity",
            "cells across it set the error", "0.14"}),
       other<Target>(
           "symmetric", "axis",
           {"none",
            "the scene is its own mirror image across the middle of its grid along that axis: the half above "
            "is modelled, and **forces are those of the half** "
            "([boundaries.md](../boundaries.md#symmetry-planes)). On every machine, so that forces mean the "
            "same; for boxes of material without `jitter` or `cut_out`, tools with prescribed motion in the "
            "plane, no loads. Boundaries, initial state, `transport` (start, values, fluxes and sources alike "
            "on both sides, each by itself; no heat capacity of tools), and pose, motion and bounds of tools "
            "are checked; **what a tool's shape looks like between its bounds, and commands that move it "
            "across the plane, are not**",
            "y"}),
       other<Target>("chosen", "list", {"none", kRecord}), other<Target>("before", "map", {"none", "see `chosen`"}),
       other<Target>("asked", "map", {"none", "see `chosen`"}),
       other<Target>("expected", "map", {"none", "see `chosen`"})});
  return keys;
}

}  // namespace mpm::pace
