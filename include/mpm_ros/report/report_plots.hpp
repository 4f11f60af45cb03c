// Pictures of runs: calls scripts/plot_report.py, which lies beside the program (in the devel and the install space
// alike), on the folders that report_csv.hpp writes.
#pragma once

#include <string>
#include <vector>

#include "mpm_ros/report/temporary_folder.hpp"

namespace mpm_ros {

/// What the plotting script is asked for.
struct PlotOptions {
  std::vector<std::string> csv;  ///< folders with the tables, one a run; several are drawn on one another
  std::string plots;             ///< folder for the pictures; made if need be
  std::string field;             ///< colours the particles; empty: the script chooses
};

/// @throws ReportError when the script is not found or fails
void make_plots(const PlotOptions& options);

/// Path of plot_report.py. @throws ReportError when it is not there
std::string plot_script();

}  // namespace mpm_ros
