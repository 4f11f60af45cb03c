// The largest time step that a module or the material allows, with its cause and place. The text is made only when
// asked for.
#pragma once

#include <limits>
#include <string>

#include "mpm/math/geometry.hpp"

namespace mpm {

class Module;

struct StepLimit {
  double dt = std::numeric_limits<double>::infinity();  ///< [s]
  const Module* by = nullptr;                           ///< null: limited by the sync period alone
  int part = 0;                                         ///< part of `by` that sets the limit, as `by` numbers them
  double speed = 0.0;                                   ///< [m/s]
  Vec3 place = Vec3::Zero();                            ///< [m]
  bool foreseen = false;                                ///< shortened because material is stiffening

  /// "speed of 'blade' (2 m/s)", "time.step", …
  std::string text() const;

  /// Takes over the other limit if that is smaller, or NaN (hence not "other < this").
  void tighten(const StepLimit& other) {
    if (!(other.dt >= dt)) *this = other;
  }
};

/// The sync period that is about to begin.
struct PeriodAhead {
  double start, length;  ///< [s]
  double cfl;            ///< largest part of a cell that may be crossed in a step
  double cell;           ///< smallest edge of a cell [m]

  /// The largest distance that may be crossed in a step [m].
  double reach() const { return cfl * cell; }
};

}  // namespace mpm
