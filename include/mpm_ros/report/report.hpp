// bag_report: from a recorded bag to tables, CSV files, pictures and checks.
#pragma once

#include <cstddef>
#include <iosfwd>
#include <string>

namespace mpm_ros {

struct ReportOptions {
  std::string bag;
  std::string name_space;      ///< of the run, when the bag holds several
  std::string csv;             ///< folder for the tables; empty: none
  std::string plots;           ///< folder for the pictures; empty: none
  std::string field;           ///< that colours the particles of the pictures; empty: chosen by the script
  std::size_t snapshots = 10;  ///< of particles, written at most
  bool check = false;
};

/// Reads the bag and writes what is asked for; tables and checks to `out`. True when all checks passed (or none were
/// asked for). @throws BagError, CsvError, PlotError
bool report(const ReportOptions& options, std::ostream& out);

}  // namespace mpm_ros
