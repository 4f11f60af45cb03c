// bag_report of a sweep: its runs, what metrics came to, and which parameters they follow.
#pragma once

#include <ostream>
#include <string>
#include <vector>

#include "mpm_ros/report/report.hpp"
#include "mpm_ros/sweep/sweep_table.hpp"

namespace mpm_ros {

/// A metric over the runs that are done and have it.
struct SweepMetric {
  std::string name;
  double least = 0.0, mean = 0.0, largest = 0.0;
  std::string least_run, largest_run;
  /// By parameter: Spearman's correlation of ranks, from -1 (falls) over 0 to 1 (rises); NaN for a parameter that is no
  /// number or does not vary. Source: Spearman (1904), The proof and measurement of association between two things.
  std::vector<double> correlation;
};
std::vector<SweepMetric> metrics_of(const SweepTable& table);

/// Spearman's correlation of two lists of the same length; ties have the mean of their ranks. NaN where one of them
/// does not vary.
double rank_correlation(const std::vector<double>& a, const std::vector<double>& b);

/// Prints the sweep in the folder options.bags[0] and writes what else is asked for. False when --check was asked for
/// and not all runs are done. @throws ReportError, mpm::Error
bool report_sweep(const ReportOptions& options, std::ostream& out);

}  // namespace mpm_ros
