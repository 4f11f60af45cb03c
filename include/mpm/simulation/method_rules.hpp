// Which parts of a method go together: the one place that knows. A scene asks when its section is read, a Simulation
// when it is put together, so that a definition made by hand is held to the same.
#pragma once

#include <optional>
#include <string>

#include "mpm/simulation/definition.hpp"

namespace mpm {

/// Why a method cannot be, and what can be used instead.
struct MethodFault {
  std::string key;   ///< of the scene's section `method` that has to change: "transfer", "damping.placement"
  std::string text;  ///< what; what to write instead
};

/// The first rule that a method breaks; nothing when it can be.
std::optional<MethodFault> method_fault(const MethodDefinition& method, GeometryKind geometry);

}  // namespace mpm
