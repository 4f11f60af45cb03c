// The tables that bag_report prints.
#pragma once

#include <string>
#include <vector>

#include "mpm_ros/report/report_bag.hpp"
#include "mpm_ros/report/report_check.hpp"
#include "mpm_ros/report/report_statistics.hpp"

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

/// All tables: run, contact forces, motion, energies, audit, commands, gaps.
std::string tables(const RunBag& bag, const RunStatistics& statistics, const std::vector<std::string>& gaps);

/// "ok    audit      residual at most …", a line each.
std::string check_lines(const std::vector<CheckResult>& results);

}  // namespace mpm_ros
