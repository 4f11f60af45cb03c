// One run of the suite of forces on tools, and its tables: text for a terminal, JSON for charts.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <utility>
#include <vector>

#include "study/row.hpp"
#include "study/tool_force/problem.hpp"

namespace mpm::study::tool_force {

struct ForceRow {
  std::string problem;
  double cells = 0.0;
  std::string variant;                                ///< settings beside the scene, "contact.method=nodes"; or empty
  std::string contact, shape, update, transfer, law;  ///< methods that the run used
  bool average_dilatation = false;
  std::uint64_t particles = 0, steps = 0;

  Bounds answer;  ///< [N]
  Known known = Known::exact;
  double force = kUnknown;       ///< mean over the problem's travel, along the push [N]
  double over_exact = kUnknown;  ///< force over what is exact, or over the upper bound
  int places = 1;                ///< within a cell, of which the row is the mean
  double spread = kUnknown;      ///< standard deviation of `over_exact` over them
  double error = kUnknown;  ///< distance of the force from what is exact, or from the interval of the bounds, over it
  double lift = kUnknown;   ///< mean force along `free` over that along the push
  double ripple =
      kUnknown;  ///< half the range of the force over one cell's travel, a straight line taken out, over its mean
  double scatter = kUnknown;      ///< standard deviation of pressure inside a cell, over its mean, in Problem::pressed
  double unloaded = kUnknown;     ///< part of the particles there with less than 1 % of the mean pressure
  double imbalance = kUnknown;    ///< energy stored and dissipated beyond the work done, over the tool's work
  double cpu_seconds = kUnknown;  ///< time of the steps, on one thread [s]
  double real_time_factor = kUnknown;  ///< simulated time over that processor time
  std::string status;                  ///< "ok"; "failed", the run blew up or ended in an error; "refused" at load
  std::string message;
  std::vector<std::pair<double, double>> curve;  ///< travel over length, force over `over_exact`'s denominator
};

/// A line of headings, and one line a row.
std::string table_header();
std::string table_line(const ForceRow& row);
/// All rows, with what problems are, as JSON.
void write_json(std::ostream& out, const std::vector<ForceRow>& rows);

}  // namespace mpm::study::tool_force
