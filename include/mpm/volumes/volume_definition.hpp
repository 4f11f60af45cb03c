// Definition of a volume of space in which material is counted.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "mpm/rigid/motion.hpp"
#include "mpm/rigid/surface.hpp"

namespace mpm {

/// The most volumes of a scene: a particle remembers each in a bit of a double's whole numbers.
inline constexpr std::size_t kMostVolumes = 50;

struct VolumeDefinition {
  std::string name;
  std::string of;  ///< rigid body that it moves with; empty: it stands in the world
  std::shared_ptr<const Surface> surface;
  Pose pose;  ///< in the body's frame, or the world's
};

/// Material in a volume at a sync point.
struct VolumeReport {
  std::string name;
  double mass = 0.0;           ///< [kg]
  double volume = 0.0;         ///< volume of the material as it is deformed [m^3]
  Vec3 centre = Vec3::Zero();  ///< centre of mass, world [m]; not a number without mass
  double mass_in = 0.0;        ///< that came in since the start [kg]
  double mass_out = 0.0;       ///< that went out since the start [kg]
};

/// Names and units of the numbers that a run reports of a volume.
std::vector<std::pair<std::string, std::string>> volume_numbers(const std::string& name);

}  // namespace mpm
