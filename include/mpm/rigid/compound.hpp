// Several surfaces as one body, each at a place of its own in the body's frame.
//
// The signed distance is the smallest of the parts'. Outside and on the body it is exact, and so is the normal. Inside,
// where parts meet, it is weak: no deeper than in the deepest part, and zero on a face that two parts only share. Let
// parts overlap.
#pragma once

#include <memory>
#include <vector>

#include "mpm/rigid/motion.hpp"
#include "mpm/rigid/surface.hpp"

namespace mpm {

/// A surface and its pose in the body's frame.
struct PlacedSurface {
  std::shared_ptr<const Surface> surface;  ///< bounded along every axis
  Pose pose;                               ///< pose of the surface's frame in the body's [m]
};

/// Makes one surface of several parts. Of parts that are equally near the first counts. The thickness is that of the
/// thinnest part. @throws RigidError when there is no part, or one is without end.
std::unique_ptr<Surface> make_compound(std::vector<PlacedSurface> parts);

}  // namespace mpm
