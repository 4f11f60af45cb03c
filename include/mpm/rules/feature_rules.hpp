// Features of a scene that do not go together, in one table: which two, why, and what to do. It is asked for scenes and
// for definitions made in C++ alike, and doc/features.md shows it.
//
// A feature is one that a scene has or has not, or a run of it (RunKind). What steps on a graphics processor cannot
// have yet is a row each: who adds a capability there takes its row out. Rules on a value, a material or one body stand
// beside what reads them (method_rules.hpp, implicit_rules.hpp, rigid_rules.hpp, geometry_rules.hpp, the modules). Two
// features that stand in no row go together but for these.
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
  axisymmetric,
  body_laws,
  collisions,
  conditions,
  conditions_beside_contact,
  contact_at_nodes,
  cracks,
  cut_particles,
  damping,
  damping_of_place,
  device,
  divided_bodies,
  following_ground,
  free_bodies,
  frictional_walls,
  implicit_steps,
  leaving,
  line,
  loads,
  loads_beside_cut,
  loads_of_place,
  oblique_biot,
  own_laws,
  particle_damping,
  particle_tools,
  periodic_axes,
  plane_stress,
  point_particles,
  pore_pressure,
  ranks,
  rigid_bodies,
  rings,
  robots,
  sheared_boxes,
  sleep,
  sleep_damping,
  solid,
  thin_tools,
  tool_heat,
  tool_laws,
  tractions_of_place,
  transport,
  volumes
};
constexpr int kFeatures = static_cast<int>(Feature::volumes) + 1;

/// Features of a run that are none of its scene.
struct RunKind {
  int ranks = 1;        ///< number of processes
  bool device = false;  ///< true if another processor takes the steps (step/device.hpp)
};

/// Two features that do not go together.
struct FeatureRule {
  Feature feature;     ///< that which is refused, by its key
  Feature beside;      ///< the other
  const char* reason;  ///< sentence without an end
  const char* remedy;  ///< the same
};

/// A rule that is broken, and by whom.
struct BrokenRule {
  const FeatureRule* rule;
  std::string who, who_beside;  ///< as find_feature() has them

  /// "sleep and cracks ('notch') do not go together: " and the reason.
  std::string why() const;
};

const std::vector<FeatureRule>& feature_rules();
/// Words for it, such as "thin tools".
const char* feature_name(Feature feature);
/// Key of a scene, or option of a program, that asks for it, such as "rigid_bodies".
const char* feature_key(Feature feature);
/// Name of who has the feature, such as "'blade'", or an empty text where that needs no saying; nothing where none has
/// it.
std::optional<std::string> find_feature(Feature feature, const SimulationDefinition& definition,
                                        const RunKind& run = {});

/// The first rule that a definition breaks; empty when it breaks none. `coming`: a feature that it is about to have.
std::optional<BrokenRule> broken_rule(const SimulationDefinition& definition, const RunKind& run = {},
                                      std::optional<Feature> coming = {});
/// The same as a fault by the key of its first feature, with what to do.
std::optional<MethodFault> feature_fault(const SimulationDefinition& definition, const RunKind& run = {},
                                         std::optional<Feature> coming = {});

}  // namespace mpm
