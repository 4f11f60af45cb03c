// Gains that change a transported quantity at a particle by itself, with nothing flowing to it: heat of plastic work,
// of compression, pressure of water in a skeleton that is squeezed. Increments since the last look are kept by the law
// and taken here when the quantity is updated, after the step's strain: in every step with USF that of the step, with
// USL that of the step before, with USAVG the second half of the one and the first half of the other. That is the
// buffering of GIMP notes (6.27)-(6.30).
#pragma once

#include <string>

#include "mpm/math/state_archive.hpp"

namespace mpm {

/// Particles that are visited in one go, so that sums over them do not depend on the number of threads.
inline constexpr int kGainGroup = 1024;

class LocalGain {
 public:
  virtual ~LocalGain() = default;
  /// Name of its account: "plastic work", ...
  virtual std::string name() const = 0;
  /// True if particles of a set gain anything so.
  virtual bool acts_on(int set) const = 0;
  /// Adds to `gain[i]` what the quantity of particle first + i, `value[first + i]` now, has gained since the last call.
  virtual void take(int set, int first, int last, const double* value, double* gain) = 0;
  /// The quantity of these particles is new. Returns the energy that their laws store with it [J].
  virtual double written(int /*set*/, int /*first*/, int /*last*/, const double* /*value*/) { return 0.0; }
  /// True if written() may give energy.
  virtual bool gives_energy() const { return false; }
};

}  // namespace mpm
