// A map of heights from its message.
#pragma once

#include <mpm_ros/HeightMap.h>

#include <string>

#include "mpm/rigid/surface.hpp"

namespace mpm_ros {

/// @throws mpm::Error, with the topic: a message whose numbers make no map, or of another frame than the world's
mpm::HeightGrid height_grid(const HeightMap& message, const std::string& topic, const std::string& world_frame);

}  // namespace mpm_ros
