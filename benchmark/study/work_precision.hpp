// The study: every method on every suite, written to a folder as it goes.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "study/suite.hpp"

namespace mpm::study {

struct StudyOptions {
  std::vector<std::string> suites;   ///< names; all when empty
  std::vector<std::string> methods;  ///< labels; those of each suite when empty
  bool full = false;                 ///< finer grids, every method on every suite, longer timing
  std::string folder;                ///< for work_precision.csv, summary.csv and suites.csv; made if need be
};

/// @param progress is given one line a run
/// @throws StudyError for an unknown suite or method, or a folder that cannot be written
void run_study(const StudyOptions& options, const std::function<void(const std::string&)>& progress);

}  // namespace mpm::study
