// Whether two recordings are of the same run: to the bit, or to a tolerance. Read side by side, topic by topic and
// message by message, in the memory of one message of each.
//
// Compared are contact forces, states of bodies and of the solver, commands, global quantities, and particles by their
// ids, at their simulated times; other topics repeat these. Left out is what the machine and the moment make:
// real_time_factor, and the stamps' origin.
#pragma once

#include <iosfwd>
#include <optional>
#include <string>

#include "mpm_ros/report/report_bag.hpp"

namespace mpm_ros {

/// To the bit when there is no `tolerance`: then the first difference is told, with its topic, time and field. Else
/// numbers may differ by `tolerance` times the largest size that the quantity has in either run (a vector's components
/// count together), and the worst of each topic is told; words are not compared.
/// True when they are the same. @throws BagError
bool same_runs(RunBag& a, RunBag& b, std::optional<double> tolerance, std::ostream& out);

}  // namespace mpm_ros
