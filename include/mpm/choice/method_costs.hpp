// Costs of methods for an error: the runs of a study that a choice of method is made from, in a small table.
//
//   suite,method,error,cost
//   square_large,ugimp/usf/flip,0.0123,45678
//
// Errors are relative, costs in particle-steps of uGIMP/USF on the same grid (study/row.hpp); runs that ended well
// alone. Weak: as good as the study's suites, which are elastic and end where their grids end.
#pragma once

#include <iosfwd>
#include <map>
#include <string>
#include <vector>

#include "mpm/choice/front.hpp"
#include "mpm/choice/method_choice.hpp"

namespace mpm::choice {

/// Fronts by suite and by method label ("cpdi/usavg/flip").
using MethodCosts = std::map<std::string, std::map<std::string, std::vector<FrontPoint>>>;

/// Names of the study's problems, in its order; a unit test holds them against the study.
const std::vector<std::string>& suite_names();

/// @throws ChoiceError naming the line when the text is no such table, or has no run.
MethodCosts read_method_costs(std::istream& in);

}  // namespace mpm::choice
