// The list of particle fields (particle_field_table.cpp), private to this folder.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "particle_view.hpp"

namespace mpm {

struct ParticleField {
  const char* name;
  const char* unit;
  unsigned needs;  ///< ViewNeeds
  double (*value)(const ParticleView&);
  bool of_start = false;  ///< looks at where the particle was at the start
};

/// Null for a name that is none of them.
const ParticleField* find_particle_field(const std::string& name);
/// Names and units of those that a scene may ask for, in their order.
std::vector<std::pair<std::string, std::string>> names_of_particle_fields();

}  // namespace mpm
