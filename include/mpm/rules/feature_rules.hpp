// Features of a scene that do not go together, in one table: which two, why, and what to do. It is asked for scenes and
// for definitions made in C++ alike, and doc/features.md shows it.
//
// A feature is one that a scene has or has not. Rules on a value, a material or one body stand beside what reads them
// (method_rules.hpp, implicit_rules.hpp, rigid_rules.hpp, geometry_rules.hpp, the modules). Two features that stand in
// no row go together but for these.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mpm/definition/definition.hpp"
#include "mpm/rules/method_rules.hpp"

namespace mpm {

enum class Feature {
  absorbing_faces,
  apic,
  average_dilatation,
  average_stress,
  body_laws,
  collisions,
  conditions,
  contact_at_nodes,
  cracks,
  damping,
  divided_bodies,
  following_ground,
  free_bodies,
  implicit_steps,
  leaving,
  line,
  loads,
  oblique_biot,
  particle_damping,
  particle_tools,
  periodic_axes,
  plane_stress,
  point_particles,
  pore_pressure,
  ranks,
  rings,
  robots,
  sleep,
  sleep_damping,
  solid,
  thin_tools,
  tool_heat,
  tool_laws,
  transport
};
constexpr int kFeatures = static_cast<int>(Feature::transport) + 1;

/// Two features that do not go together.
struct FeatureRule {
  Feature feature;     ///< that which is refused, by its key
  Feature beside;      ///< the other
  const char* reason;  ///< sentence without an end
  const char* remedy;  ///< the same
};

const std::vector<FeatureRule>& feature_rules();
/// Words for it, such as "thin tools".
const char* feature_name(Feature feature);
/// Key of a scene that asks for it, such as "rigid_bodies".
const char* feature_key(Feature feature);
/// Name of who has the feature, such as "'blade'", or an empty text where that needs no saying; nothing where none has
/// it. `ranks`: number of processes.
std::optional<std::string> find_feature(Feature feature, const SimulationDefinition& definition, int ranks);

/// The first rule that a definition breaks, by the key of its first feature; empty when it breaks none. `coming`: a
/// feature that it is about to have.
std::optional<MethodFault> feature_fault(const SimulationDefinition& definition, int ranks = 1,
                                         std::optional<Feature> coming = {});

}  // namespace mpm
