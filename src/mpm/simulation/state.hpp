// The inside of a Simulation: what the rooms below it are put together from. Private to this room.
#pragma once

#include <chrono>
#include <limits>

#include "mpm/boundary/absorbing.hpp"
#include "mpm/boundary/leaving.hpp"
#include "mpm/contact/material_contact.hpp"
#include "mpm/contact/point_contact.hpp"
#include "mpm/contact/rigid_contact.hpp"
#include "mpm/contact/tool_sides.hpp"
#include "mpm/mechanics/continuum.hpp"
#include "mpm/mechanics/damping.hpp"
#include "mpm/mechanics/face_tractions.hpp"
#include "mpm/mechanics/particle_loads.hpp"
#include "mpm/simulation/projected.hpp"
#include "mpm/simulation/simulation.hpp"
#include "mpm/step/schedule.hpp"

namespace mpm {

/// What limits the step when velocity conditions do.
inline const std::string kConditionsName = "boundaries.conditions";

/// The largest time step that something allows, and what and where that is. Put into words only when asked for.
struct StepLimit {
  enum class Cause { nothing, material, tool, damping, scene, period };
  double dt = std::numeric_limits<double>::infinity();  ///< [s]
  Cause cause = Cause::nothing;
  const std::string* name = nullptr;  ///< of the body, deformable or rigid
  double speed = 0.0;                 ///< [m/s]
  Vec3 place = Vec3::Zero();          ///< of the particle [m]
  bool foreseen = false;              ///< shortened for what stiffens
  std::string text() const;
};

/// The straight line with the least squares through points that come one by one.
class LineFit {
 public:
  void add(double t, double y);
  /// Not a number before the second point.
  double slope() const;
  /// For checkpoints: of every metric.
  static void keep(StateArchive& archive, std::vector<LineFit>& fits);

 private:
  int count_ = 0;
  double mean_t_ = 0.0, mean_y_ = 0.0, tt_ = 0.0, ty_ = 0.0;
};

struct SetView;

struct Simulation::State {
  SimulationDefinition definition;
  int threads = 1;
  Isa isa = Isa::plain;
  std::vector<std::string> warnings, notes;

  std::vector<ParticleSet> sets;
  std::vector<Law> laws;  ///< of each set
  FieldMap field_map;
  Fields fields;
  std::unique_ptr<Sorter> sorter;
  std::unique_ptr<ToolSides> sides;  ///< of thin tools, in a scene that has any
  std::unique_ptr<Mechanics> mechanics;
  std::vector<RigidBody> bodies;
  Modules modules;
  std::vector<ContactLedger*> contacts;         ///< of each body, owned by modules
  std::unique_ptr<VolumeSurvey> survey;         ///< of contact between deformable bodies, when the scene has any
  MaterialContact* pairs = nullptr;             ///< the same, owned by modules
  ParticleLoads* loads = nullptr;               ///< owned by modules, when the scene has any
  FaceTractions* tractions = nullptr;           ///< the same
  DampingControl* damping = nullptr;            ///< the same
  std::vector<VelocityConditions*> conditions;  ///< of each field, the same
  std::vector<Absorbing*> absorbing;            ///< of each absorbing face and field, owned by modules
  std::optional<Leaving> leaving;               ///< of a scene that lets particles leave

  std::int64_t time = 0;  ///< [ns]
  StepReport steps;
  ImpulseAccount gravity;
  Vec3 initial_momentum = Vec3::Zero();
  double total_mass = 0.0;
  std::chrono::duration<double> wall{0.0};
  StepLimit material_limit;  ///< as surveyed at the last sync point
  StepLimit previous_limit;  ///< as surveyed at the one before
  StepLimit limit;           ///< of the last period's steps
  bool failed = false;
  std::vector<LineFit> rates;  ///< of each metric; those without a window stay empty

  /// Of every field.
  const GridLayout& layout() const { return fields.front()->layout; }
  template <class T>
  void add_mechanics();
  /// A stage of each field.
  template <class Make>
  void add_in_fields(Make&& make) {
    for (int f = 0; f < field_map.count(); ++f) modules.add_in_field(make(), f);
  }
  /// Says of a thin body what becomes of its two sides.
  void add_sides(const RigidBody& body);
  /// Contact between deformable bodies, when the scene has any (contact_terms.cpp).
  void add_pairs();
  /// Contact with a rigid body that is made of particles.
  ContactLedger& add_rigid_particles(const RigidBody& body, const std::vector<ContactLaw>& laws_of_sets);
  /// Bodies, and the stages of contact with them.
  void add_rigid_bodies();
  /// What either asks of the mechanics.
  VolumeSurvey& volumes();
  /// Absorbing faces.
  void add_absorbing();
  /// @throws RigidError for a body at a periodic face
  void check_periodic(const RigidBody& body) const;
  /// Velocity conditions. @throws ConditionError
  void add_conditions();
  /// Of each set, for particle fields (particle_view.hpp).
  std::vector<SetView> views() const;
  /// Of all particles [N s].
  Vec3 momentum() const;
  /// Of all particles [J].
  double kinetic_energy() const;
  /// Work and losses of contact, loads and conditions since the start; nothing that is summed over particles.
  EnergyReport given_energy() const;
  /// What the material allows now.
  StepLimit survey_material() const;
  /// What material, tools, damping and scene allow in the sync period that begins now. @throws DampingError
  StepLimit step_limit() const;
  /// Runs to the next sync point. @throws PhysicsError, LoadError, DampingError, FunctionError
  void run_period();
  /// One step of the schedule, with the checks after it; it begins at `start` [s].
  void step(double start, double dt);
  /// @throws PhysicsError for a particle that is not where it may be
  void sort(double now);
  /// All that the run remembers (keep_state.cpp).
  void keep(StateArchive& archive);
  void keep_particles(StateArchive& archive);
  void keep_grid(StateArchive& archive);
  void keep_limit(StateArchive& archive, const char* name, StepLimit& kept);
  /// Lets the bodies that start geostatic, already under their weight's stress, come to rest. Before anything is
  /// sorted.
  void settle();
  [[noreturn]] void fail(const std::string& what, ParticleRef particle, double now, const std::string& remedy) const;
};

/// @throws DefinitionError when there is none of that name
const MaterialDefinition& find_material(const SimulationDefinition& definition, const DeformableBody& body);

/// Sums over all particles of `term(set, index)`, grouped so that the result does not depend on the number of threads.
template <class Value, class Term>
Value sum_particles(const std::vector<ParticleSet>& sets, int threads, Value zero, Term&& term) {
  constexpr int kGroup = 4096;
  Value total = zero;
  for (const ParticleSet& set : sets) {
    const int groups = (set.size() + kGroup - 1) / kGroup;
    std::vector<Value> partial(groups, zero);
#pragma omp parallel for schedule(static) num_threads(threads)
    for (int g = 0; g < groups; ++g) {
      const int end = std::min(set.size(), (g + 1) * kGroup);
      for (int p = g * kGroup; p < end; ++p) partial[g] += term(set, p);
    }
    for (const Value& value : partial) total += value;
  }
  return total;
}

/// Deformation gradient and stress of one particle as full tensors (what a geometry does not store filled in), for what
/// is not a kernel.
struct ParticleTensors {
  Matrix3<double> f;
  Symmetric3<double> tau;  ///< Kirchhoff stress over initial density [J/kg]
  double j;                ///< det f
};
ParticleTensors particle_tensors(const ParticleSet& set, GeometryKind geometry, int p);

}  // namespace mpm
