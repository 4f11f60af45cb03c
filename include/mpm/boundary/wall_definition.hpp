// Definition of the faces of the domain in a scene.
#pragma once

#include "mpm/rigid/contact_law.hpp"

namespace mpm {

/// absorbing and periodic faces are no walls: absorbing.hpp, periodic.hpp.
enum class WallKind { none, fixed, slip, frictional, symmetry, absorbing, periodic };

constexpr bool is_wall(WallKind kind) {
  return kind != WallKind::none && kind != WallKind::absorbing && kind != WallKind::periodic;
}

/// Definition of a face of the domain in a scene.
struct WallDefinition {
  WallKind kind = WallKind::none;
  FrictionLaw friction;  ///< frictional only
  bool hold = false;     ///< absorbing only: the forces of the start are held
};

}  // namespace mpm
