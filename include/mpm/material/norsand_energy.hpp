// The one definition of NorSand::volume_energy(). The source that defines the law has it, and once more that of laws
// for a device, which is compiled with the namespace mpm under another name (kernel/lane.hpp).
#pragma once

#include <cmath>

#include "mpm/material/norsand.hpp"

namespace mpm {

double NorSand::volume_energy(double raised) const {
  const auto integral = [&](double power) { return (std::pow(raised, power) - std::pow(least_, power)) / power; };
  return (integral(2.0 - exponent_) - least_ * integral(1.0 - exponent_)) / stiffness_;
}

}  // namespace mpm
