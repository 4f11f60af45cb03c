// Which method to take: the rule that chooses among measured methods, by suites that look like the task.
//
// For an error: of the methods that come below it on every suite, the one whose cost is least in its worst suite, as a
// factor over the least cost there. Where none does on every suite: the one whose smallest error, in its worst suite,
// is smallest. For a cost: the same with errors in the place of costs, at so many times the cost at which
// uGIMP/USF/FLIP reaches 1 % on the suite (or of its dearest run, where it does not). Differences under 10 % count as
// none, for the study's timing is no finer: then the simpler method is taken, that has fewer parts other than uGIMP,
// USAVG and FLIP, in this order of weight. Weak: the worst suite decides, though a scene may be little like it. Source:
// own; a minimax choice.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mpm/study/method_costs.hpp"

namespace mpm::study {

/// What is to be kept: exactly one of the two.
struct Budget {
  std::optional<double> error;  ///< relative
  std::optional<double> cost;   ///< over that of uGIMP/USF/FLIP for 1 %
};

/// What the numbers of a standing are.
enum class Judged {
  cost,            ///< of reaching the error, over the least of the suite
  smallest_error,  ///< none reaches the error everywhere: the smallest that was measured
  error_at_cost,   ///< over the least of the suite
};

struct Standing {
  std::string method;            ///< label
  std::vector<double> by_suite;  ///< in the order of Preference::suites
  double worst = 0.0;            ///< largest of them
};

struct Preference {
  Judged judged = Judged::cost;
  std::vector<std::string> suites;  ///< that decided
  Standing chosen;
  std::vector<Standing> others;  ///< that could have been, best first
};

/// @param suites names; those where no candidate has a run are left out, and so is then a candidate that has none on
/// one of the rest
/// @param candidates labels
/// @returns nothing when no candidate is left, or none can be had for the cost
std::optional<Preference> prefer(const MethodCosts& costs, const std::vector<std::string>& suites,
                                 const std::vector<std::string>& candidates, const Budget& budget);

/// Error that a front has reached for `cost`, read between its runs as cost_at() does; nothing below its first.
std::optional<double> error_at(const std::vector<FrontPoint>& front, double cost);

}  // namespace mpm::study
