// A point of the material's surface near a rigid body: what is found of it anew in every step.
#pragma once

#include <cstdint>

#include "mpm/math/geometry.hpp"

namespace mpm {

struct ContactPoint {
  int body = 0, field = 0, law = 0;  ///< places in the lists of bodies, velocity fields and laws
  std::uint32_t particle = 0;        ///< its id
  Vec3 place = Vec3::Zero();         ///< world [m]
  Vec3 normal = Vec3::Zero();        ///< out of the body
  Vec3 velocity = Vec3::Zero();      ///< of the body there [m/s]
  double gap = 0.0;                  ///< negative inside [m]
  double area = 0.0;                 ///< of the surface that the point stands for [m^2]
};

}  // namespace mpm
