// Comparison of two recordings for being of the same run: to the bit, or to a tolerance. Read side by side, topic by
// topic and message by message, in the memory of one message of each.
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

/// Compares two recordings. Without a `tolerance` they have to be equal to the bit, and the first difference is
/// reported with its topic, time and field. With one, numbers may differ by `tolerance` times the largest magnitude of
/// the quantity in either run (a vector's components count together), the worst difference of each topic is reported,
/// and words are not compared. Returns whether the recordings are the same. @throws BagError
bool same_runs(RunBag& a, RunBag& b, std::optional<double> tolerance, std::ostream& out);

}  // namespace mpm_ros
