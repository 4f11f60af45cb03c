// Runs problems of the suite on grids and in variants, and measures what came of each: with explicit steps, unless a
// variant has "method={update: implicit}".
//
// Processor time is that of stepping, on one thread, as the clock of the process counts it: for a comparison close
// everything else. The geostatic start is not in it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "study/tool_force/row.hpp"

namespace mpm::study::tool_force {

/// Changes to a scene, as `run_scene --set` takes them: "contact.method=nodes". Three more change the
/// problem: "law=mohr_coulomb" the law of the soil, "speed=0.5" the tool's speed by a factor, and "beside=0,0.5" lays
/// tool and ground that part of a cell beside rows of nodes along x and above them along z.
using Overrides = std::vector<std::string>;

struct ForceOptions {
  std::vector<std::string> problems;  ///< names; those of the short suite when empty
  std::vector<double> cells;          ///< those of the short or the long suite when empty
  std::vector<std::string> vary;      ///< "key=value|value|…": all combinations are run
  Overrides set;                      ///< on all
  bool places = false;                ///< each row is that of five places within a cell
  bool full = false;
  bool only_write = false;  ///< writes the scenes to `folder` and runs none
  std::string folder;       ///< for tool_force.json and scenes
};

/// Every combination of the values of `vary`. @throws StudyError for text that is no "key=value|value"
std::vector<Overrides> variants_of(const std::vector<std::string>& vary);

/// Never throws for what a run does: that is the row's status and message.
ForceRow run_row(const Problem& problem, double cells, const Overrides& variant, const Overrides& set = {});

/// The same at five places within a cell: mean_of() their rows.
ForceRow run_places(const Problem& problem, double cells, const Overrides& variant, const Overrides& set = {});

/// @param progress is given one line a run
/// @throws StudyError for an unknown problem, or a folder that cannot be written
void run_tool_force(const ForceOptions& options, const std::function<void(const std::string&)>& progress);

}  // namespace mpm::study::tool_force
