// The sections of a scene file, one function each, in the order in which parse_scene() reads them. Each function checks
// its section, fills its part of the Scene and records in Scene::choices the defaults that it chose.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "mpm/advice/auto_method.hpp"
#include "mpm/rules/method_rules.hpp"
#include "mpm/scene/scene.hpp"
#include "mpm/scene/scene_parts.hpp"
#include "mpm/yaml/reader.hpp"

namespace mpm {

/// `units`
UnitSystem read_units(const Value& value);
/// `constants`, after units
void read_constants(const Value& value, SceneConstants& constants);
/// `grid`
void read_grid(const Map& root, Scene& scene);
/// `method`. Returns the part that is to be chosen once all sections are read, if any.
std::optional<AutoMethod> read_method(const Map& root, Scene& scene);
/// `method.damping`
void read_damping(const Value& value, Scene& scene);
/// `materials`
void read_materials(const Map& root, Scene& scene);
/// Completes a law of `materials` whose keys are read: what other keys stand for, and what follows from the grid. After
/// `grid`
void complete_law(const Map& map, Scene& scene, DruckerPragerDefinition& law);
void complete_law(const Map& map, Scene& scene, MohrCoulombDefinition& law);
void complete_law(const Map& map, Scene& scene, NorSandDefinition& law);
/// `bodies`, after materials
void read_bodies(const Map& root, Scene& scene);
/// The `region` of a load or condition.
Region read_region(const Value& value, GeometryKind geometry);
/// The `shape` of a deformable body that is a `height_field`, after `grid`
Region read_terrain(const Value& value, const SimulationDefinition& definition);
/// `bodies.<name>.initial`
void read_initial(const Value& value, const MaterialDefinition& material, Scene& scene, BodyDefinition& body);
/// `rigid_bodies`, and by read_contact() `contact`, after bodies. Returns the friction of tools that name none.
FrictionLaw read_rigid_bodies(const Map& root, Scene& scene);
/// `contact` without its pairs: how contact is found, and the law of tools without a law of their own. `with_tools`:
/// whether there are tools.
FrictionLaw read_contact(const Map& root, Scene& scene, bool with_tools);
/// `contact.pairs`, after rigid bodies. Deformable bodies that have a law with others get velocity fields of their own.
void read_contact_pairs(const Map& root, Scene& scene);
/// The law of contact that the keys say. `needs_friction`: whether friction has to be written, as for a pair; without
/// it surfaces are smooth.
ContactLaw read_contact_law(const Map& map, bool needs_friction);
/// `shape`, `pose` and `motion` of a rigid body, or of the region of a velocity condition.
void read_rigid_shape(const Map& map, const SimulationDefinition& definition, RigidBodyDefinition& body);
/// The first two of them.
void read_rigid_place(const Map& map, const SimulationDefinition& definition, RigidBodyDefinition& body);
void read_rigid_motion(const Map& map, GeometryKind geometry, RigidBodyDefinition& body);
/// The `shape` of a rigid body that is `revolved`, `cone` or `ring`; for a ring that can open it also sets the inner
/// radius. @throws RigidError for numbers that make no body.
std::unique_ptr<Surface> read_revolved_shape(const std::string& kind, const Value& value, RigidBodyDefinition& body);
/// `free` of a rigid body, after its shape and motion
void read_free(const Map& map, const SimulationDefinition& definition, RigidBodyDefinition& body);
std::optional<CollideDefinition> read_collide(const Value& value);
/// Refuses exceptions that name no rigid body, once all are read.
void check_collide(const Map& root, const SimulationDefinition& definition);
/// The `shape` of a rigid body that is a `polygon`, in planar scenes
std::unique_ptr<Surface> read_polygon(const Value& value, const SimulationDefinition& definition);
/// The `shape` of a rigid body that is a `height_field`, after `grid`
std::unique_ptr<Surface> read_height_field(const Value& value, const SimulationDefinition& definition);
/// The `shape` of a rigid body that is a robot's link, `urdf`, after `grid`
std::unique_ptr<Surface> read_urdf_link(const Value& value, const SimulationDefinition& definition);
/// The path of a file that a scene names: as it is written where it is absolute, or begins with package:// or file://;
/// else from the scene's folder.
std::string path_from_scene(const Value& value);
/// The same. @throws SceneError when there is no such file, with the place where it was looked for
std::string file_from_scene(const Value& value);
/// Below this a mesh is refused as too thin [m], after `grid`.
double thinnest_mesh(const SimulationDefinition& definition);
/// A pose; `inner_radius`: the inner radius of a ring that opens along x, else 0.
Pose read_pose(const Value& value, GeometryKind geometry, double inner_radius);
/// `robots`, whose links become rigid bodies, after `rigid_bodies`. `friction`: of links without one of their own.
void read_robots(const Map& root, const FrictionLaw& friction, Scene& scene);
/// `drive` and `limits` of a rigid body, after its shape
CommandDefinition read_commands(const Map& body, const std::string& name, Scene& scene);
/// The tf frame that `drive` names; `usual`: where it is `tf` alone.
std::string read_frame(const Value& drive, const std::string& usual);
void read_limits(const Value& value, MotionLimits& limits);
/// `boundaries`, after bodies and rigid bodies
void read_boundaries(const Map& root, Scene& scene);
/// Refuses a scene for a fault, by the place of its section and what follows it in the key.
[[noreturn]] void fail_at(const Map& root, const MethodFault& fault);
/// The name of a deformable body of the scene.
std::string read_body(const Value& value, const Scene& scene);
/// The `region` that chooses particles of a load or a flux, if there is one.
LoadRegion read_load_region(const Map& map, const Scene& scene);
/// A face of particles' domains by its name, in the order of kWallNames.
int read_edge(const Value& value, const Scene& scene);
/// `loads`, after bodies
void read_loads(const Map& root, Scene& scene);
/// `time` and `output`, because sync points and snapshots are chosen together
void read_time_and_output(const Map& root, Scene& scene);
/// A time that is a whole number of sync periods [s].
double read_sync_periods(const Value& value, const Scene& scene);
/// `output.terrain`, when sync period and `output.period` are known
void read_ground_output(const Value& value, Scene& scene);
/// `sleep`, after bodies, rigid bodies, loads and time
void read_sleep(const Map& root, Scene& scene);
/// `target`, after rigid bodies
void read_target(const Map& root, Scene& scene);
/// `transport`, after materials, bodies, rigid bodies and `sleep`
void read_transport(const Map& root, Scene& scene);
/// Adds the keys that materials have for the quantities that the scene transports. @throws SceneError for a material
/// that has one of another quantity
void add_transport_keys(const Value& material, const Map& root, std::vector<std::string>& keys);
/// A material's constants for a quantity; `material`: its index.
TransportMaterial read_transport_constants(const Map& map, Transported quantity, std::size_t material, Scene& scene);
/// Dimension of a quantity's value.
Dimension value_dimension(Transported quantity);
/// One of `materials`, with the keys of its law, of transport and of fracture.
Map material_map(const Value& value, const Map& root);
/// Reads the region of nodes that a condition or a prescribed value holds: `region`, or `shape` and `pose` as of a
/// rigid body.
void read_region_or_shape(const Map& map, const Scene& scene, RigidBodyDefinition& body);
/// `cracks`, after all that cracks may stand beside: rigid bodies, `boundaries`, `sleep` and `transport`
void read_cracks(const Map& root, Scene& scene);
/// True if the scene names a criterion by which cracks grow.
bool cracks_may_grow(const Map& root);
/// One of `cracks.list`, but for what depends on its tips' materials.
CrackDefinition read_crack(const Value& value, const Scene& scene);
/// The material of each tip of a crack, and whether J and growth are possible there. @throws SceneError at the tip's
/// key
void check_crack_tips(const Value& value, const CrackDefinition& crack, const Scene& scene);
/// One of `cracks.traction_laws`.
TractionLawDefinition read_traction_law(const Value& value);
/// The name of one of `laws`.
std::string read_traction_name(const Value& value, const std::vector<TractionLawDefinition>& laws);
/// `growth`, or `alternate`, of the scene or of a material.
GrowthRule read_growth_rule(const Value& value, const std::vector<TractionLawDefinition>& laws, bool alternate);
/// Adds the key `fracture`. @throws SceneError for a material that has it in a scene without cracks
void add_fracture_keys(const Value& material, const Map& root, std::vector<std::string>& keys);
/// A material's constants of fracture, after the scene's own rules of growth. `map`: of the material.
FractureConstants read_fracture_constants(const Map& map, const CracksDefinition& cracks);
/// Two numbers along x and z.
Vec2 read_plane_vector(const Value& value, const Dimension& dimension);
/// `volumes`, after rigid bodies
void read_volumes(const Map& root, Scene& scene);
/// `terrain`, after bodies, rigid bodies, robots, `sleep` and volumes
void read_bed(const Map& root, Scene& scene);
/// `metrics`, after bodies and volumes
void read_metrics(const Map& root, Scene& scene);

/// A number >= 0 or the word stick.
FrictionLaw read_friction(const Value& value);
/// {min, max}: the particles whose centres lie in it.
Box read_particle_region(const Value& value);
/// A name that Simulation::particle_fields() knows.
std::string read_particle_field(const Value& value);

}  // namespace mpm
