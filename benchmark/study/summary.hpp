// Choice of the cheapest method for a given error: each method's own front, read between its runs
// (choice/front.hpp).
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "study/row.hpp"

namespace mpm::study {

/// One line of the summary.
struct Cheapest {
  std::string suite;
  double target = 0.0;                  ///< error
  std::string by;                       ///< "work" or "cost", a column of the runs
  std::string method, second;           ///< the cheapest and the next, empty when there is none
  double value = kUnknown;              ///< value of the cheapest
  double second_value = kUnknown;       ///< value of the next
  double reference = kUnknown;          ///< value of uGIMP/USF/FLIP
  std::vector<std::string> reached_by;  ///< all methods that reach it, the cheapest first
};

/// 10, 3, 1 and 0.3 % for every suite, by work and by cost.
std::vector<Cheapest> summarise(const std::vector<Row>& rows);
void write_summary(std::ostream& out, const std::vector<Cheapest>& lines);

}  // namespace mpm::study
