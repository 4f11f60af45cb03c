// Choice of a method: the rule that chooses among measured methods, by suites that look like the task.
//
// For an error: a method's number on a suite is its cost of coming below the error there, over the least cost that any
// candidate has. On a suite where no candidate comes below it, the number is the method's smallest error over the
// smallest of all. Of the methods that come below the error wherever one does, that is taken whose largest number is
// least. Where there is none of these, numbers are smallest errors over the smallest of all or, where that is more,
// over the error asked for; what is below that counts as 1.
//
// For a cost: numbers are errors over the least one, at so many times the cost at which uGIMP/USF/FLIP reaches 1 % on
// the suite (or of its dearest run, where it does not).
//
// Differences under 10 % count as none, for the study's timing is no finer: then the simpler method is taken, that has
// fewer parts other than uGIMP, USAVG and FLIP; of as many, one with another transfer before one with another update
// and that before one with another shape.
//
// Weak: the worst suite decides, though a scene may be little like it. Source: own; a minimax choice.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mpm/choice/method_costs.hpp"

namespace mpm::choice {

/// Limit to be kept: exactly one of the two.
struct Budget {
  std::optional<double> error;  ///< relative
  std::optional<double> cost;   ///< over that of uGIMP/USF/FLIP for 1 %
};

/// Meaning of the numbers of a suite.
enum class Judged {
  cost,            ///< cost of reaching the error
  smallest_error,  ///< that was measured; the error is not reached
  error_at_cost,
};

struct Standing {
  std::string method;            ///< label
  std::vector<double> by_suite;  ///< numbers as above, in the order of Preference::suites
  double worst = 0.0;            ///< largest of them
};

struct JudgedSuite {
  std::string name;
  Judged by = Judged::cost;
  double least = 0.0;  ///< reference that numbers are relative to: a cost, or an error
};

struct Preference {
  std::vector<JudgedSuite> suites;  ///< that decided
  Standing chosen;
  std::vector<Standing> others;  ///< that could have been, best first
};

/// @param suites names; those where no candidate has a run are left out, and so is then a candidate that has none on
/// one of the rest
/// @param candidates labels
/// @returns nothing when no candidate is left, or none can be had for the cost
std::optional<Preference> prefer(const MethodCosts& costs, const std::vector<std::string>& suites,
                                 const std::vector<std::string>& candidates, const Budget& budget);

}  // namespace mpm::choice
