// Momentum of the sweeps of an implicit step, and how stiff it makes what they resolve.
//
// A sweep passes on to a cell what its neighbours have got, so that stress spreads as heat does: n sweeps resolve the
// loads that an elastic soil of modulus n rho (h / dt)^2 would bear, h the cell. Before each two sweeps, to and fro,
// all unknowns therefore go on by kMomentum of what they have changed over the last two: the slow part of the change,
// which is alike from one to the next, becomes up to 1 / (1 - kMomentum) times as large. Stresses, impulses and
// velocities go on together, so that momentum stays exact; the sweeps that follow return stresses to the law. Where
// changes grow, which a linear problem never does, one pair begins without.
//
// Source: B. T. Polyak (1964), Some methods of speeding up the convergence of iteration methods, USSR Comput. Math.
// Math. Phys. 4(5) 1; restarts after B. O'Donoghue, E. Candes (2015), Adaptive restart for accelerated gradient
// schemes, Found. Comput. Math. 15, 715. That a sweep to and fro is what may be extrapolated, and the number 0.9, were
// found by trial: with 0.95, or after each sweep, the force on strips on dilating soil grew without bound.
#pragma once

#include <algorithm>

namespace mpm {

inline constexpr double kMomentum = 0.9;
inline constexpr int kMostSweeps = 200;  ///< without a number in the scene

/// Largest pressure, over the modulus that sweeps resolve, under which soil answers as it should: with 1/20 to 1/40 a
/// blade's force is a few percent too small.
inline constexpr double kMostSweepLoad = 1.0 / 30.0;

/// Modulus that sweeps resolve, over rho (h / dt)^2.
inline double modulus_of(int sweeps) {
  double sum = 0.0, change = 0.0;
  for (int left = sweeps; left > 0; left -= 2) {
    change = kMomentum * change + std::min(left, 2);
    sum += change;
  }
  return sum;
}

/// Number of sweeps whose modulus_of() is at least `modulus`; `most` where no fewer do.
inline int sweeps_for(double modulus, int most) {
  int sweeps = 0;
  while (sweeps < most && !(modulus_of(sweeps) >= modulus)) ++sweeps;
  return sweeps;
}

/// Rule by which a pair of sweeps begins without momentum.
class MomentumRestart {
 public:
  void begin() { least_ = -1.0; }
  /// Factor of the pair to begin, after one that has changed the stresses by `change` (SweepChange::change).
  double factor(double change) {
    if (least_ < 0.0) {
      least_ = 0.0;  // value of the first pair
      return 0.0;
    }
    const bool grows = least_ > 0.0 && change > kGrowth * least_;
    least_ = least_ > 0.0 && !grows ? std::min(least_, change) : change;
    return grows ? 0.0 : kMomentum;
  }

 private:
  static constexpr double kGrowth = 4.0;  ///< growth of the square of changes over the least one since the last restart
  double least_ = -1.0;
};

}  // namespace mpm
