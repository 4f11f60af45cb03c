// Definition of the sleep of material at rest in a scene.
#pragma once

#include <optional>

namespace mpm {

struct SleepDefinition {
  double speed = 0.0;    ///< a block may fall asleep while no particle in it moves faster [m/s]
  double wake = 0.0;     ///< force without balance, as the speed of a wave that brings it, that wakes a block [m/s]
  double after = 0.0;    ///< time for which a block has to be at rest before it falls asleep [s]
  double balance = 0.1;  ///< part of a force at rest, lost in the mean over `after`, that wakes a block
  double damping = 0.0;  ///< part of the force without balance that slow nodes lose, in [0, 1)
  /// Changes of what is transported that wake a block: of the temperature [K], concentration [1] and pressure of water
  /// [Pa]; without one, a thousandth of the range of the values that the scene gives.
  std::optional<double> temperature{}, concentration{}, pore_pressure{};
  bool from_start = false;  ///< all material that is at rest when the run begins is asleep after its first step
};

}  // namespace mpm
