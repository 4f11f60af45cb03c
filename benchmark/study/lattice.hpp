// Bodies of a suite: particles on a regular lattice, as a scene fills a shape.
#pragma once

#include <functional>
#include <string>

#include "mpm/definition/definition.hpp"
#include "study/suite.hpp"

namespace mpm::study {

/// True if a point [m] belongs to the body.
using Inside = std::function<bool(const Vec3& place)>;

/// Equal cells of size `cell` from `min` to `max` [m]; the method and the discretisation's time step.
/// @param sync period of sync points [s]
SimulationDefinition empty_definition(const std::string& name, GeometryKind geometry, const MethodDefinition& method,
                                      const Discretisation& discretisation, double cell, const Vec3& min,
                                      const Vec3& max, double sync, double end);

/// The one body, "block", of the one material: particles of `box` [m] that lie inside, with the velocity field given.
/// @throws StudyError when no particle does
void add_block(SimulationDefinition& definition, const MaterialDefinition& material, const Box& box,
               const Inside& inside = {}, const std::function<Vec3(const Vec3&)>& velocity = {},
               const std::string& name = "block");

}  // namespace mpm::study
