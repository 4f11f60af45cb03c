// Speed of a tip from the energies of the whole body: it rises while a length of growth releases more energy than its
// faces take, and falls otherwise. With E the energies a unit of thickness and a the crack's length, over the last two
// lengths of growth,
//
//   b = -(d(strain + kinetic - external work) + (1 + p) d(plastic)) / da - 2 gamma,   speed += gain b.
//
// Weak: it is a control, not a law; energies oscillate with the waves in the body, and with several growing tips each
// takes the release of all for its own. For research.
// Source: crack reference 5.2.1.
#pragma once

#include <array>

#include "mpm/crack/fracture_definition.hpp"
#include "mpm/math/state_archive.hpp"

namespace mpm {

/// Of the whole body, a unit of thickness [J/m].
struct BodyEnergies {
  double potential = 0.0;  ///< strain and kinetic energy less the work of external loads
  double plastic = 0.0;    ///< dissipated
};

class EnergyBalance {
 public:
  struct Speed {
    bool grows = true;
    double speed = 0.0;   ///< [m/s]
    double excess = 0.0;  ///< b [J/m^2]; 0 until two lengths have grown
  };

  /// The speed at which the crack, of that length [m], goes on. It starts at constants.speed of the wave speed [m/s],
  /// falls by half at most, never below half of that at the start, and does not pass the wave speed; at the least
  /// speed with b below 0 the tip does not grow.
  Speed look(double length, const BodyEnergies& energies, const FractureConstants& constants, double wave_speed);
  /// Books that the crack grows now from that length.
  void grown(double length, const BodyEnergies& energies);

  void serialise(StateArchive& archive);

 private:
  struct Record {
    double length = 0.0;
    BodyEnergies energies;
  };
  std::array<Record, 2> grown_;  ///< the last growth but one, the last
  int known_ = 0;                ///< of these
  double speed_ = 0.0;           ///< 0: not started
};

}  // namespace mpm
