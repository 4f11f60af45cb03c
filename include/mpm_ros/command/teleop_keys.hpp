// Commands of the keys of a terminal to a rigid body: a velocity for as long as a key is held.
//
// A terminal tells of keys that are pressed and repeated, not of those that are let go: a key counts as let go when it
// has not come again for a while. That while is long before the keyboard begins to repeat and short after it. Keyboards
// repeat the last key alone, so of two that are held the first ends.
#pragma once

#include <array>
#include <string>

#include "mpm/rigid/motion.hpp"

namespace mpm_ros {

class TeleopKeys {
 public:
  enum class Action {
    none,  ///< a key without a meaning
    move,  ///< along or about an axis, or at another speed
    stop,  ///< at once
    quit
  };

  /// `speed` [m/s], `rotation_rate` [rad/s]: of a key that is held. `hold` [s]: how long a key counts that was pressed
  /// once; more than the keyboard's delay before it repeats.
  TeleopKeys(double speed, double rotation_rate, double hold);

  /// A key came at `now` [s] of any clock that does not run backwards.
  Action press(char key, double now);
  /// World axes. Zero when no key counts any more.
  mpm::Twist twist(double now) const;
  /// One line: the velocity, and what a key that is pressed next is worth.
  std::string status(double now) const;
  /// The keys, for people.
  static std::string help();

  /// Time that a key counts that the keyboard repeats [s].
  static constexpr double kRepeated = 0.15;

 private:
  struct Axis {
    double sign = 0.0;
    double pressed = 0.0, until = 0.0;  // [s]
  };

  double speed_, rotation_rate_;
  const double hold_;
  std::array<Axis, 6> axes_;  // x, y, z; about x, y, z
};

}  // namespace mpm_ros
