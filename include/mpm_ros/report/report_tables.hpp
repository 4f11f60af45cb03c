// The tables that bag_report prints.
#pragma once

#include <string>
#include <vector>

#include "mpm/math/geometry.hpp"
#include "mpm_ros/report/recorded_run.hpp"

namespace mpm_ros {

/// Rows of text under a header, in columns as wide as their widest cell: the first column to the left, others to the
/// right.
class TextTable {
 public:
  explicit TextTable(std::vector<std::string> header) : rows_{std::move(header)} {}
  /// As many cells as the header has.
  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  std::string text() const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

/// Four digits, as many as a table needs.
std::string number(double value);
/// Three numbers.
std::string triple(const mpm::Vec3& vector);

/// A figure of a contact over the run, as text; what it has not is empty.
struct FigureText {
  std::string heading;  ///< "peak |F| [N]"
  std::string size;
  std::string vector;  ///< x  y  z; of a force a radian r  z
  std::string time;    ///< [s]
};
/// As the lists of quantities.hpp say; last the time of contact.
std::vector<FigureText> figure_texts(const ContactStatistics& contact, bool axisymmetric);

/// All tables of one run: run, contact forces, motion, energies, audit, commands, gaps.
std::string tables(const RecordedRun& run);

/// "PASS  audit      residual at most …", a line each; "-" in place of "PASS" for a check that is not made.
std::string check_lines(const std::vector<CheckResult>& results);

}  // namespace mpm_ros
