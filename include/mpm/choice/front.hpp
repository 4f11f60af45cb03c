// Error against cost of one method on one suite, read between its runs.
//
// A front is the runs that no cheaper run of the method matches. Between two of them error and cost are taken as a
// power of each other (straight in log-log). A method whose cheapest run is already below an error is counted with that
// run's cost; one that never comes below it is not counted.
#pragma once

#include <optional>
#include <vector>

namespace mpm::choice {

struct FrontPoint {
  double cost = 0.0;
  double error = 0.0;
};

/// Points that no cheaper one matches, by rising cost. Points that are not finite, or not positive, are left out.
std::vector<FrontPoint> front(std::vector<FrontPoint> points);
/// Cost at which the front reaches `error`; nothing when it never does.
std::optional<double> cost_at(const std::vector<FrontPoint>& front, double error);

/// Error that the front has reached for `cost`, read between its runs as cost_at() does; nothing below its first.
std::optional<double> error_at(const std::vector<FrontPoint>& front, double cost);

}  // namespace mpm::choice
