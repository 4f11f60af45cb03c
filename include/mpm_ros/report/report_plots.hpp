// Pictures of a run: calls scripts/plot_report.py, which lies beside the program (in the devel and the install space
// alike), on the CSV files of report_csv.hpp.
#pragma once

#include <stdexcept>
#include <string>

namespace mpm_ros {

/// The pictures could not be made; what() says why, in one line.
class PlotError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What the plotting script is asked for.
struct PlotOptions {
  std::string csv;    ///< folder with the tables
  std::string plots;  ///< folder for the pictures; made if need be
  std::string title;  ///< stands above each picture
  std::string field;  ///< colours the particles; empty: the script chooses
};

/// @throws PlotError when the script is not found or fails
void make_plots(const PlotOptions& options);

/// A folder under the system's temporary one, removed with its content at the end.
class TemporaryFolder {
 public:
  /// @throws PlotError
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::string& path() const { return path_; }
  /// Path of a file of that name in it.
  std::string file(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

}  // namespace mpm_ros
