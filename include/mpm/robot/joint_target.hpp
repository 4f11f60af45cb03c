// The target of a joint's drive: a function of time, a command, or a trajectory.
#pragma once

#include <vector>

#include "mpm/math/state_archive.hpp"
#include "mpm/robot/definition.hpp"

namespace mpm {

/// A point of a trajectory.
struct JointKnot {
  double time = 0.0;      ///< [s]
  double position = 0.0;  ///< [m], [rad]
  double velocity = 0.0;  ///< [m/s], [rad/s]; not a number: straight lines meet there
};

class JointTarget {
 public:
  explicit JointTarget(const JointDefinition& definition);

  /// A constant value of the drive's kind from now on.
  void hold(double value);
  /// Positions by time, joined by cubic polynomials that have the knots' velocities, or by straight lines where a knot
  /// has none; after the last one it stays there.
  void follow(std::vector<JointKnot> knots) { knots_ = std::move(knots); }
  /// The drive's own quantity at a time. @throws FunctionError when a function is not finite there
  double at(double time) const;
  /// Rate of a position target at a time [m/s], [rad/s]; of a function that of the step before it.
  double rate(double time, double dt) const;
  void serialise(StateArchive& archive);

 private:
  JointKnot knot_at(double time) const;

  JointDrive drive_;
  Function function_;
  bool held_ = false;
  double value_ = 0.0;
  std::vector<JointKnot> knots_;
};

}  // namespace mpm
