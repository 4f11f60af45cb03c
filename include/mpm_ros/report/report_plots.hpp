// Pictures of runs, sweeps and studies: calls scripts/plot_report.py on the folders that report_csv.hpp writes,
// scripts/plot_sweep.py on tables of sweeps, and scripts/plot_work_precision.py on the folders of mpm/study. They lie
// beside the program, in the devel and the install space alike.
#pragma once

#include <string>
#include <vector>

#include "mpm_ros/report/temporary_folder.hpp"

namespace mpm_ros {

/// Options of the plotting script.
struct PlotOptions {
  std::vector<std::string> csv;  ///< folders with the tables, one a run; several are drawn on one another
  std::string plots;             ///< folder for the pictures; made if need be
  std::string field;             ///< colours the particles; empty: the script chooses
};

/// @throws ReportError when the script is not found or fails
void make_plots(const PlotOptions& options);

/// Charts of a study, in its own folder.
/// @throws ReportError when the script is not found or fails
void make_work_precision_plots(const std::string& folder);

/// Metrics against parameters, from a table with so many columns of both, to a folder.
/// @throws ReportError when the script is not found or fails
void make_sweep_plots(const std::string& table, std::size_t parameters, std::size_t metrics, const std::string& folder);

/// Path of a script beside the program. @throws ReportError when it is not there
std::string plot_script(const std::string& name = "plot_report.py");

}  // namespace mpm_ros
