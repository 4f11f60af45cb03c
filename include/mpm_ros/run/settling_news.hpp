// Tells, every few seconds, how far a geostatic start is from rest: it may take minutes before a run begins.
#pragma once

#include <functional>
#include <string>

#include "mpm/simulation/simulation.hpp"

namespace mpm_ros {

/// For mpm::SimulationOptions::settling. `say` gets a line each kNewsPeriod seconds of wall time; none of a short
/// start.
std::function<void(const mpm::Settling&)> settling_news(std::function<void(const std::string&)> say);

inline constexpr int kNewsPeriod = 3;

}  // namespace mpm_ros
