// One run of the study as a row of its table, and the table as comma-separated text. Numbers are written in the
// shortest form that reads back to the same bits; what is not known is an empty cell.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <limits>
#include <string>
#include <vector>

#include "study/suite.hpp"

namespace mpm::study {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

struct Row {
  std::string suite, method;                                 ///< names
  std::string shape, update, transfer, precision, geometry;  ///< description of the method
  int cells = 0;
  int particles_per_cell = 0;
  double cfl = 0.0;
  std::uint64_t steps = 0, particles = 0;
  double error = kUnknown;
  std::string error_measure;
  double cpu_seconds = kUnknown;    ///< time of the steps, without the body force of manufactured problems [s]
  double relative_cost = kUnknown;  ///< processor time of a step over that of uGIMP/USF on the same grid
  double cost = kUnknown;           ///< relative_cost times particles times steps: in particle-steps of uGIMP/USF
  double work = kUnknown;           ///< counted: particles times steps times counted_work()
  std::string status;               ///< "ok"; "failed", the physics ended the run; "refused" by the simulation
  std::string message;              ///< reason why it failed or was refused
};

void write_header(std::ostream& out);
void write_row(std::ostream& out, const Row& row);
/// @throws StudyError naming the line when the text is no such table
std::vector<Row> read_rows(std::istream& in);
/// One cell, quoted when it holds a comma, a quote or a line break.
std::string quoted(const std::string& text);

}  // namespace mpm::study
