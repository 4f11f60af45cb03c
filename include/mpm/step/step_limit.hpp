// The largest time step that something allows, and who and where that is. Put into words only when asked for.
#pragma once

#include <limits>
#include <string>

#include "mpm/math/geometry.hpp"

namespace mpm {

class Module;

struct StepLimit {
  double dt = std::numeric_limits<double>::infinity();  ///< [s]
  const Module* by = nullptr;                           ///< null: nothing, but the sync period that a step is a part of
  int part = 0;                                         ///< which of its parts, as `by` counts them
  double speed = 0.0;                                   ///< [m/s]
  Vec3 place = Vec3::Zero();                            ///< [m]
  bool foreseen = false;                                ///< shortened for what stiffens

  /// "speed of 'blade' (2 m/s)", "time.step", …
  std::string text() const;

  /// Becomes the other one where that allows less. What is not a number must not pass unnoticed, so not "other < this".
  void tighten(const StepLimit& other) {
    if (!(other.dt >= dt)) *this = other;
  }
};

/// The sync period that begins.
struct PeriodAhead {
  double start, length;  ///< [s]
  double cfl;            ///< part of a cell that anything may cross in a step
  double cell;           ///< smallest edge of a cell [m]

  /// The farthest that anything may move in a step [m].
  double reach() const { return cfl * cell; }
};

}  // namespace mpm
