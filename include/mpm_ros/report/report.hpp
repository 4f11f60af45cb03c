// bag_report: from recorded bags to tables, CSV files, JSON, pictures, an animation and checks.
#pragma once

#include <cstddef>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace mpm_ros {

struct ReportOptions {
  std::vector<std::string> bags;  ///< one, or several to compare
  std::string name_space;         ///< namespace of the run, when a bag holds several
  std::string csv;                ///< folder for the tables; empty: none. Several bags: a folder each in it
  std::string json;               ///< file for the figures of the tables; "-": to `out`, and nothing else; empty: none
  std::string plots;              ///< folder for the pictures; empty: none
  std::string animate;            ///< file for the animation, .mp4 or .gif; empty: none
  std::string field;              ///< that colours the particles of the pictures; empty: chosen
  std::size_t snapshots = 10;     ///< snapshots of particles, written at most
  std::size_t frames = 150;       ///< frames of the animation, at most
  bool check = false;
  bool same = false;                     ///< compare the two bags, and nothing else
  std::optional<double> tolerance;       ///< tolerance of that, relative; none: to the bit
  std::function<bool()> stop_requested;  ///< asked between messages; empty: never
};

/// The program's exit codes. If it is stopped by a signal it ends by that signal.
enum class ReportResult { done = 0, bad_input = 2, check_failed = 3, stopped };

/// Reads the bags and writes what is asked for; tables and checks to `out`. A progress bar to `err` when `bar`.
/// False when a check that was asked for failed. @throws BagError, CsvError, ReportError
bool report(const ReportOptions& options, std::ostream& out, std::ostream& err, bool bar);

/// The same; an error is one line on `err`.
ReportResult run_report(const ReportOptions& options, std::ostream& out, std::ostream& err, bool bar);

}  // namespace mpm_ros
