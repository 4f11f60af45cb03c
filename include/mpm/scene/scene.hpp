// From YAML to a checked Scene, and from there to what a Simulation is made from.
//
//   mpm::Scene scene = mpm::load_scene("blade_in_soil", {"grid.cell=0.02"});
//   mpm::Simulation simulation(mpm::build(scene), {.threads = 2});
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "mpm/math/error.hpp"
#include "mpm/rigid/motion_limits.hpp"
#include "mpm/simulation/definition.hpp"
#include "mpm/simulation/global_quantity.hpp"

namespace mpm {

/// Bad scene. what() begins with "file:line: key.path: " and says what to write instead.
class SceneError : public Error {
 public:
  using Error::Error;
};

/// A region of space that a deformable body fills. Half-open: of two that share a face, one holds a point on it.
/// In planar scenes a sphere is a disk, and a box has no end along y.
struct Region {
  enum class Kind { box, sphere, cylinder } kind = Kind::box;
  Box box;                     ///< box
  Vec3 center = Vec3::Zero();  ///< sphere, cylinder [m]
  double radius = 0.0;         ///< [m]
  double height = 0.0;         ///< cylinder, along `axis`
  int axis = 2;
  bool about_axis = false;  ///< of an axisymmetric scene: only r >= 0 counts
  bool contains(const Vec3& point) const;
  Box bounds() const;
};

struct BodyDefinition {
  std::string name;
  std::string material;
  Region region;
  double jitter = 0.0;                            ///< farthest a particle starts from its lattice place [cells]
  std::array<Function, 3> velocity;               ///< initial, functions of place [m/s]
  std::optional<std::array<Function, 6>> stress;  ///< initial Cauchy stress, xx yy zz yz xz xy, of place [Pa]
  bool yy_follows = false;                        ///< planar: yy of it is what plane strain makes it
  std::optional<Function> temperature;            ///< initial, function of place [K]
  std::optional<GeostaticDefinition> geostatic;
  int field = 0;                     ///< velocity field, as its contact laws ask for
  bool cut_out_all = false;          ///< particles inside any rigid body are left out
  std::vector<std::string> cut_out;  ///< the same for rigid bodies by name
  std::string where;                 ///< "file:line: key.path", for errors found when it is built
  std::string initial_where, cut_out_where;
};

/// Which particles of its body a load acts on: those whose centres lie in it at the start. Without one a force acts on
/// all, a traction on the outermost.
struct LoadRegion {
  std::optional<Region> region;
  std::string where;  ///< "file:line: key.path"
};

/// How commands move a rigid body. For whoever gives the commands: the simulation does not know of it.
struct CommandDefinition {
  std::string frame;    ///< tf frame that the body follows; empty: it is commanded on topics
  MotionLimits limits;  ///< that its commands are kept within
};

/// What is written out, beside the sync period that carries it.
struct OutputDefinition {
  double period = 0.0;  ///< [s] between particle snapshots; a multiple of the sync period
  double first = 0.0;   ///< [s] of the first snapshot after that of the start; a multiple of the sync period
  std::vector<std::string> particle_fields;  ///< chosen scalars, beside x, y, z, id
  int particle_stride = 1;
  std::optional<Box> particle_region;  ///< only particles in it are written [m]
  std::vector<GlobalQuantity> global;  ///< sums and means over bodies, written over time
  double global_period = 0.0;          ///< [s] between them; a multiple of the sync period
};

struct Scene {
  SimulationDefinition definition;  ///< all but the particles of the bodies
  std::vector<BodyDefinition> bodies;
  std::vector<CommandDefinition> commands;   ///< of each of definition.rigid_bodies
  std::vector<LoadRegion> load_regions;      ///< of each of definition.particle_forces
  std::vector<LoadRegion> traction_regions;  ///< of each of definition.tractions
  OutputDefinition output;
  std::string path;                                          ///< of the file
  std::string text;                                          ///< as loaded, overrides applied, for the record
  std::vector<std::pair<std::string, std::string>> choices;  ///< what was chosen and why, for --explain
};

/// `name_or_path`: a shipped scene's name, or a path to a YAML file. `overrides`: "key.path=value".
/// @throws SceneError
Scene load_scene(const std::string& name_or_path, const std::vector<std::string>& overrides = {});
/// The same from text; `label` stands for the file in errors. Relative mesh paths start from the label's folder (from
/// the working folder when it has none), so a scene out of a bag is given its path as the label.
Scene parse_scene(const std::string& text, const std::string& label, const std::vector<std::string>& overrides = {});
/// Names and first comment lines of the scenes that are shipped.
std::vector<std::pair<std::string, std::string>> shipped_scenes();
/// Fills the bodies with particles and checks them against the grid and each other. @throws SceneError
SimulationDefinition build(const Scene& scene);

}  // namespace mpm
