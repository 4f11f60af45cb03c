// The formulas of the volume correction of fluids (mechanics/volume_correction.hpp), of one node and one particle: the
// same for the processor and for a device.
#pragma once

#include <cmath>

namespace mpm {

struct VolumeRule {
  static constexpr double kRate = 0.3;  ///< per strain
  static constexpr double kFull = 0.7;
  static constexpr double kAlmostAll = 1.0 - 1e-6;  ///< part of weights: above what rounding leaves of all in single
  static constexpr double kLeastShare = 1e-3;       ///< part of a cell: less is a node beyond the domain

  /// Part of the domain about a node along an axis, in cells. `from_face`: so many nodes within the nearer face, which
  /// is a wall that folds shape functions or not. `beyond`: part of a node's function beyond the next node.
  static constexpr double share(int from_face, bool folds, double beyond) {
    if (from_face > 1) return 1.0;
    if (from_face == 1) return folds ? 1.0 - 2.0 * beyond : 1.0 - beyond;
    if (from_face == 0) return folds ? 0.5 + 2.0 * beyond : 0.5;
    return from_face == -1 && !folds ? beyond : 0.0;
  }
  /// Fullness of a node that has a volume in its share of the domain, in cells of this volume.
  static constexpr double fullness(double volume, double share, double cell) {
    return share > kLeastShare ? volume / (share * cell) : 1.0;
  }
  static constexpr double full(double fullness) { return fullness < kFull ? 0.0 : 1.0; }

  /// Relaxes J of a particle of this fullness, of which the part `full` of its weights is on full nodes, over the time
  /// `waited` [s]. `squares`: |grad v|^2 [1/s^2]. False where J stays as it is.
  static bool relax(double fullness, double full, double squares, double waited, double& j) {
    const double excess = std::log(j * fullness);
    if (!(std::isfinite(excess)) || (excess < 0.0 && full < kAlmostAll)) return false;
    j *= std::exp(excess * std::expm1(-kRate * waited * std::sqrt(squares)));
    return true;
  }
};

}  // namespace mpm
