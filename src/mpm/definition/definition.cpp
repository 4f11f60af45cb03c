#include "mpm/definition/definition.hpp"

#include <fmt/core.h>

namespace mpm {

const MaterialDefinition& find_material(const SimulationDefinition& definition, const DeformableBody& body) {
  for (const MaterialDefinition& material : definition.materials) {
    if (material.name == body.material) return material;
  }
  throw DefinitionError(fmt::format("body '{}': no material is called '{}'", body.name, body.material));
}

}  // namespace mpm
