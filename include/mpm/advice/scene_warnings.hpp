// Warnings of what is possible in a scene, and most often not meant: a unit that was forgotten, an end that no sync
// point meets.
#pragma once

#include <string>
#include <vector>

#include "mpm/scene/scene.hpp"

namespace mpm {

/// One line each. To be asked when the scene's end is known, which a command line may change.
std::vector<std::string> scene_warnings(const Scene& scene);

/// The slowest wave of the materials of the scene's bodies, unstrained.
struct SlowestWave {
  double speed = 0.0;  ///< [m/s]
  std::string material;
};
SlowestWave slowest_wave(const Scene& scene);
/// Warning of a rigid body that is faster than waves; speeds in m/s.
std::string faster_than_waves(const std::string& body, double speed, const SlowestWave& wave);

}  // namespace mpm
