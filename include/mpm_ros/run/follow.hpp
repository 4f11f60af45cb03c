// Ranks behind the first one, in a run that it leads (led_run.hpp): they wait for its orders, and follow them.
#pragma once

#include <exception>
#include <memory>

#include "mpm_ros/lead/order.hpp"
#include "mpm_ros/run/run.hpp"

namespace mpm_ros {

/// On every rank but the first: follows until it is told to end. Returns the exit code that the first one ends with.
/// @throws what this rank alone has failed at; the program then has to end all (mpm::end_all(), exit_code_of())
int follow(const std::shared_ptr<mpm::Communicator>& ranks);
/// On the first rank: the others return that code from follow().
void end_following(mpm::Communicator& ranks, int code);

/// Order with which others make the run that the first one makes. `number`: by which later orders name it.
Order order_to_make(const mpm::Scene& scene, const RunOptions& options, const Stamps& stamps, int number);

/// Exit code of a program that ends by this: 1 the machine failed, 2 bad input, 3 the physics failed.
int exit_code_of(const std::exception& error);

}  // namespace mpm_ros
