// Speed of a tip from the energies of the whole run: it rises while growth releases more energy than its faces take,
// and falls otherwise. With E the energies and A the area by which cracks have grown, over the last two growths of the
// tip,
//
//   b = -(d(stored + lost to friction and the like - external work) + (1 + p) d(plastic)) / dA - 2 gamma,
//   speed += gain b.
//
// What growth releases goes off in waves, and leaves the body where these are damped: it is what damping and transfer
// take, so these are not among the energies. The length of a ring counts in its area, so that b is the same about an
// axis. Several tips that grow at a time share what they release by their areas.
// Before a tip has grown twice, and after it has come to rest, the balance says nothing, and its caller lets J decide.
// Weak: it is a control, not a law. It needs damping, and growth that is slow against it: waves that are still in the
// body count as not released. For research.
// Source: crack reference 5.2.1, and NairnMPM before 2015, which takes lengths of one crack, and J for the first growth
// alone.
#pragma once

#include <array>

#include "mpm/crack/fracture_definition.hpp"
#include "mpm/math/state_archive.hpp"

namespace mpm {

/// Energies of the whole run.
struct BodyEnergies {
  double potential = 0.0;  ///< stored, and lost other than by flow, less the work of what acts from outside [J]
  double plastic = 0.0;    ///< dissipated by flow [J]
};

class EnergyBalance {
 public:
  struct Speed {
    bool grows = true;
    double speed = 0.0;     ///< [m/s]
    double released = 0.0;  ///< by area, in the last two growths [J/m^2]; 0 before
    double excess = 0.0;    ///< b [J/m^2]; 0 until the tip has grown twice
  };

  /// The speed at which the tip goes on, when cracks have grown by that area [m^2]. It starts at constants.speed of the
  /// wave speed [m/s], falls by half at most, never below half of that at the start, and does not pass the wave speed;
  /// at the least speed with b below 0 the tip does not grow, and all is forgotten.
  Speed look(double area, const BodyEnergies& energies, const FractureConstants& constants, double wave_speed);
  /// True if the tip has grown twice since it began, or since it came to rest.
  bool known() const { return known_ == 2; }
  /// Books that the tip grows now from that area.
  void grown(double area, const BodyEnergies& energies);

  void serialise(StateArchive& archive);

 private:
  struct Record {
    double area = 0.0;
    BodyEnergies energies;
  };
  std::array<Record, 2> grown_;  ///< the last growth but one, the last
  int known_ = 0;                ///< number of these
  double speed_ = 0.0;           ///< 0: not started
};

}  // namespace mpm
