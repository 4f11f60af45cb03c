// Definition of how a rigid body meets other rigid bodies and walls (contact/body_contact.hpp).
#pragma once

#include <string>
#include <vector>

namespace mpm {

struct CollideDefinition {
  double friction = 0.5;            ///< Coulomb's coefficient; of two bodies the smaller one counts
  std::vector<std::string> except;  ///< names of bodies that it never meets
};

}  // namespace mpm
