// Which method is cheapest for a given error: each method's own front, read between its runs.
//
// A front is the runs of one method on one suite that no cheaper run of it matches. Between two of them error and cost
// are taken as a power of each other (straight in log-log). A method whose cheapest run is already below the error is
// counted with that run's cost; one that never comes below it is not counted.
#pragma once

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "mpm/study/row.hpp"

namespace mpm::study {

struct FrontPoint {
  double cost = 0.0;
  double error = 0.0;
};

/// Points that no cheaper one matches, by rising cost. Points that are not finite, or not positive, are left out.
std::vector<FrontPoint> front(std::vector<FrontPoint> points);
/// Cost at which the front reaches `error`; nothing when it never does.
std::optional<double> cost_at(const std::vector<FrontPoint>& front, double error);

/// One line of the summary.
struct Cheapest {
  std::string suite;
  double target = 0.0;                  ///< error
  std::string by;                       ///< "work" or "cost", a column of the runs
  std::string method, second;           ///< the cheapest and the next, empty when there is none
  double value = kUnknown;              ///< of the cheapest
  double second_value = kUnknown;       ///< of the next
  double reference = kUnknown;          ///< of uGIMP/USF/FLIP
  std::vector<std::string> reached_by;  ///< all methods that reach it, the cheapest first
};

/// 10, 3, 1 and 0.3 % for every suite, by work and by cost.
std::vector<Cheapest> summarise(const std::vector<Row>& rows);
void write_summary(std::ostream& out, const std::vector<Cheapest>& lines);

}  // namespace mpm::study
