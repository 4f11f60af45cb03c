// The engine of articulated bodies that this build has: DART (https://dartsim.github.io) or, in a build without it,
// none. Sources that are compiled are all the difference.
#pragma once

#include <string>

namespace mpm {

/// Gives scenes with robots their engine. Programs call it once, before they read a scene; without an engine it does
/// nothing, and such scenes are refused.
void provide_robots();
/// Name and version of the engine; empty without one.
std::string robot_engine_name();

}  // namespace mpm
