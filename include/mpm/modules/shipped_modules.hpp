// The physics that every build has, each by the function that adds its modules.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "mpm/modules/run_parts.hpp"
#include "mpm/shape/traction.hpp"

namespace mpm {

struct ShippedModules {
  void (*add)(RunParts&);
  /// Numbers of its modules that a scene may choose as global quantities: name and unit.
  std::vector<std::pair<std::string, std::string>> numbers = {};
};

/// In the order in which they are added; when they act is said by their ranks (step/order.hpp).
const std::vector<ShippedModules>& shipped_modules();

/// Faces of some particles' domains, on which a traction or a flux acts.
struct ChosenFaces {
  int set = 0;
  DomainFace face;
  std::vector<std::uint32_t> particles;  ///< by id from the set's first
};
/// `what` acts: "traction", "flux". Before anything is sorted. @throws DefinitionError for a body, face or particle
/// that is not there, or has no area
ChosenFaces choose_faces(const std::string& body, int face, const std::vector<std::uint32_t>& particles,
                         const char* what, const RunParts& parts);

/// Loads of a definition on particles, for sets that begin as it says. @throws DefinitionError for a body or particle
/// that is not there
std::vector<ParticleLoadTerm> particle_load_terms(const SimulationDefinition& definition,
                                                  const std::vector<ParticleSet>& sets, Communicator* ranks = nullptr);

void add_periodic(RunParts& parts);
void add_leaving(RunParts& parts);
void add_axis(RunParts& parts);
void add_stress_average(RunParts& parts);
void add_volume_correction(RunParts& parts);
void add_damping(RunParts& parts);
void add_rigid_motion(RunParts& parts);
void add_robots(RunParts& parts);
void add_tool_sides(RunParts& parts);
void add_absorbing(RunParts& parts);
void add_walls(RunParts& parts);
void add_conditions(RunParts& parts);
void add_pairs(RunParts& parts);
void add_rigid_contact(RunParts& parts);
void add_implicit(RunParts& parts);
void add_particle_loads(RunParts& parts);
void add_tractions(RunParts& parts);
void add_sleep(RunParts& parts);
void add_step_limit(RunParts& parts);
void add_transport(RunParts& parts);
void add_cracks(RunParts& parts);
void add_bed(RunParts& parts);
void add_volumes(RunParts& parts);

}  // namespace mpm
