// Stress intensities of a crack's tip and the energy that is released when it grows, each from the other. The split of
// J into two modes is by the ratio of the openings of the faces near the tip.
//
//   G = (A_I K_I^2 + A_II K_II^2) / (2 G_shear),   at rest (K_I^2 + K_II^2) / E'
//
// Weak: the openings next to a tip are the least accurate field there, and the modes' ratio has their error (typically
// 2 degrees of phase); the interaction integral with crack_tip_field.hpp is better where it holds.
// Source: crack reference 4.7.
#pragma once

#include "mpm/crack/elastic_constants.hpp"

namespace mpm {

/// In the frame of the tip: one has the sign of the normal opening, two that of the shear opening (above minus below,
/// along the tip's direction).
struct StressIntensity {
  double one = 0.0, two = 0.0;  ///< K_I, K_II [Pa sqrt(m)]
};

/// K from J [J/m^2] and the openings of a point behind the tip [m], of which the ratio counts. `speed` of the tip
/// [m/s]. Zero for J <= 0, for no opening, and at or above the speed of surface waves.
StressIntensity split_by_openings(double j, double normal_opening, double shear_opening,
                                  const ElasticConstants& constants, double speed = 0.0);

/// G [J/m^2] of a tip at rest or with a speed [m/s]; 0 at or above the speed of surface waves.
double release_rate(const StressIntensity& k, const ElasticConstants& constants, double speed = 0.0);

}  // namespace mpm
