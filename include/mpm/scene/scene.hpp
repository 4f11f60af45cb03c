// From YAML to a checked Scene, and from there to the definition of a Simulation.
//
//   mpm::Scene scene = mpm::load_scene("blade_in_soil", {"grid.cell=0.02"});
//   mpm::Simulation simulation(scene, {2});  // on two threads; the same as of mpm::build(scene)
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "mpm/definition/definition.hpp"
#include "mpm/math/error.hpp"
#include "mpm/pace/target.hpp"
#include "mpm/ranks/communicator.hpp"
#include "mpm/rigid/motion_limits.hpp"
#include "mpm/simulation/global_quantity.hpp"

namespace mpm {

/// Thrown for a bad scene. what() begins with "file:line: key.path: " and says what to write instead.
class SceneError : public Error {
 public:
  using Error::Error;
};

class Terrain;

/// A region of space that a deformable body fills. Half-open: a point on a face that two regions share is in one of
/// them only. In planar scenes a sphere is a disk, and a box is infinite along y.
struct Region {
  enum class Kind { box, sphere, cylinder, terrain } kind = Kind::box;
  Box box;                     ///< box
  Vec3 center = Vec3::Zero();  ///< sphere, cylinder [m]
  double radius = 0.0;         ///< [m]
  double height = 0.0;         ///< cylinder, along `axis`
  int axis = 2;
  bool about_axis = false;                 ///< in an axisymmetric scene: only r >= 0 counts
  std::shared_ptr<const Terrain> terrain;  ///< terrain
  bool contains(const Vec3& point) const;
  Box bounds() const;
};

struct BodyDefinition {
  std::string name;
  std::string material;
  Region region;
  double jitter = 0.0;                            ///< largest initial offset from the lattice along an axis [cells]
  std::uint64_t seed = 0;                         ///< seed of the offsets; 0: that of the standard library
  std::array<Function, 3> velocity;               ///< initial, functions of place [m/s]
  std::optional<std::array<Function, 6>> stress;  ///< initial Cauchy stress, xx yy zz yz xz xy, of place [Pa]
  bool yy_follows = false;                        ///< plane strain: yy follows from the other components
  std::optional<Function> temperature;            ///< initial, function of place [K]
  std::optional<GeostaticDefinition> geostatic;
  int field = 0;                     ///< velocity field, which follows from contact laws
  bool cut_out_all = false;          ///< true if particles inside any rigid body are left out
  std::vector<std::string> cut_out;  ///< names of rigid bodies inside which particles are left out
  std::string where;                 ///< "file:line: key.path", for errors found while building
  std::string initial_where, cut_out_where;
};

/// The particles of a body on which a load acts: those whose centres lie in the region at the start. Without a region a
/// force acts on all particles and a traction on the outermost ones.
struct LoadRegion {
  std::optional<Region> region;
  std::string where;  ///< "file:line: key.path"
};

/// Definition of the commands that move a rigid body. It is for the source of the commands; the simulation does not use
/// it.
struct CommandDefinition {
  std::string frame;    ///< tf frame that the body follows; empty: commands come on topics
  MotionLimits limits;  ///< limits within which commands are kept
};

/// Maps of the ground's height (terrain/ground_map.hpp), as they are given out over time.
struct GroundOutput {
  double period = 0.0;      ///< time between two maps, a multiple of the sync period [s]
  double resolution = 0.0;  ///< distance between points [m]
  double change = 0.0;      ///< a map is given out if a height differs from that of the last one by more than this [m]
  std::string of;           ///< deformable body that alone is ground; empty: all
  std::string follows;      ///< rigid body that a window follows; empty: maps are of the whole domain
  Vec2 window = Vec2::Zero();  ///< size of the window along x and y [m]
};

/// The output of a run.
struct OutputDefinition {
  double period = 0.0;         ///< time between particle snapshots, a multiple of the sync period [s]
  bool period_chosen = false;  ///< the scene does not say how often: by the length of the run
  double first = 0.0;  ///< time of the first snapshot after that of the start, a multiple of the sync period [s]
  std::vector<std::string> particle_fields;  ///< chosen scalars, besides x, y, z, id
  int particle_stride = 1;
  std::optional<Box> particle_region;  ///< region outside which particles are not written [m]
  std::vector<GlobalQuantity> global;  ///< global quantities, written over time
  double global_period = 0.0;          ///< time between them, a multiple of the sync period [s]
  std::optional<GroundOutput> ground;  ///< `terrain`
};

struct Scene {
  SimulationDefinition definition;  ///< complete except for the particles of the bodies
  std::vector<BodyDefinition> bodies;
  /// One per entry of definition.rigid_bodies, then one per robot whose base moves.
  std::vector<CommandDefinition> commands;
  std::vector<LoadRegion> load_regions;      ///< one per entry of definition.particle_forces
  std::vector<LoadRegion> traction_regions;  ///< one per entry of definition.tractions
  /// By Transported, one per entry of its fluxes.
  std::array<std::vector<LoadRegion>, kQuantities> flux_regions;
  OutputDefinition output;
  std::optional<pace::Target> target;  ///< target that its discretisation is to be chosen for (target_choice.hpp)
  std::string path;                    ///< path of the file
  std::string text;                    ///< as loaded, with overrides applied, for the record
  std::vector<std::pair<std::string, std::string>> choices;  ///< key and reason of each choice made here, for --explain
};

/// Names of what Scene::commands are of.
std::vector<std::string> commanded_names(const Scene& scene);

/// Loads and checks a scene. `name_or_path`: the name of a shipped scene, or a path to a YAML file. `overrides`:
/// "key.path=value". @throws SceneError
Scene load_scene(const std::string& name_or_path, const std::vector<std::string>& overrides = {});
/// Reads and checks a scene from text; `label` is the name of the file in errors. Relative mesh paths start from the
/// folder of the label (from the working folder if it has none), so a scene from a bag gets its original path as the
/// label.
Scene parse_scene(const std::string& text, const std::string& label, const std::vector<std::string>& overrides = {});
/// Names and first comment lines of the shipped scenes.
std::vector<std::pair<std::string, std::string>> shipped_scenes();
/// Fills the bodies with particles and checks them against the grid and each other. `ranks`: where the run is over
/// several; then each gets its own particles alone, and the call is collective. `interrupt`: as in SimulationOptions,
/// asked by a process that builds alone. @throws SceneError, StoppedError
SimulationDefinition build(const Scene& scene, Communicator* ranks = nullptr,
                           const std::function<bool()>& interrupt = {});

}  // namespace mpm
