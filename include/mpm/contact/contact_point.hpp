// A point of the material's surface near a rigid body, as the search finds it anew in every step.
#pragma once

#include <cstdint>

#include "mpm/math/geometry.hpp"

namespace mpm {

struct ContactPoint {
  int body = 0, field = 0, law = 0;  ///< indices of the body, the velocity field and the law
  std::uint32_t particle = 0;        ///< id of the particle
  Vec3 place = Vec3::Zero();         ///< world [m]
  Vec3 normal = Vec3::Zero();        ///< out of the body
  Vec3 velocity = Vec3::Zero();      ///< velocity of the body there [m/s]
  Vec3 centre = Vec3::Zero();        ///< centre of the particle [m]
  int chooser = -1;                  ///< set of a particle that chooses a field at every node, near a crack; else -1
  double gap = 0.0;                  ///< distance to the body, negative inside [m]
  double area = 0.0;                 ///< area of the surface that the point represents [m^2]
};

}  // namespace mpm
