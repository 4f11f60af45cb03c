// Everything a Simulation is made from, in SI, with its defaults. A Scene fills this in; tests may do so by hand.
// Planar scenes lie in the x-z plane: y components are ignored, `thickness` is along y. A line lies along x: y and z
// components are ignored, `area` is across it. An axisymmetric scene has r = x and z; x components are radial, y ones
// are ignored, and sums over particles are those of the whole body around the axis.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "mpm/bed/bed_definition.hpp"
#include "mpm/boundary/condition.hpp"
#include "mpm/boundary/wall_definition.hpp"
#include "mpm/contact/pair_detection.hpp"
#include "mpm/contact/pair_normal.hpp"
#include "mpm/crack/definition.hpp"
#include "mpm/material/definition.hpp"
#include "mpm/math/error.hpp"
#include "mpm/math/geometry.hpp"
#include "mpm/math/geometry_kind.hpp"
#include "mpm/math/nanoseconds.hpp"
#include "mpm/math/tensor.hpp"
#include "mpm/mechanics/particle_loads.hpp"
#include "mpm/particles/particle_scalar.hpp"
#include "mpm/rigid/rigid_body.hpp"
#include "mpm/robot/definition.hpp"
#include "mpm/shape/axis_rules.hpp"
#include "mpm/shape/kind.hpp"
#include "mpm/sleep/sleep_definition.hpp"
#include "mpm/step/damping.hpp"
#include "mpm/step/schedule.hpp"
#include "mpm/step/transfer.hpp"
#include "mpm/transport/definition.hpp"
#include "mpm/volumes/volume_definition.hpp"

namespace mpm {

constexpr double kMostSteps = 1e7;  ///< in a sync period; more is a run that went wrong

/// A definition that cannot be simulated (bad input: exit code 2).
class DefinitionError : public Error {
 public:
  using Error::Error;
};

struct GridDefinition {
  Vec3 cell = Vec3::Zero();  ///< cell size along each axis [m]
  Vec3 min = Vec3::Zero();   ///< corners of the domain that material may not leave [m]; a node lies on min
  Vec3 max = Vec3::Zero();
  std::uint64_t leave_limit = 0;  ///< number of particles that may leave and are put back; one more ends the run
};

/// Shortest edge of a cell, along the axes that the grid has.
inline double shortest_edge(const Vec3& cell, GeometryKind geometry) {
  double least = cell.x();
  for (const int axis : axes_of(geometry)) least = std::min(least, cell[axis]);
  return least;
}

struct TimeDefinition {
  double end = 0.0;              ///< [s]; 0 for a node that runs until it is stopped
  double cfl = 0.5;              ///< fraction of a cell that the fastest wave may travel in a step, in (0, 1)
  std::optional<double> step;    ///< upper limit of the time step [s]
  std::int64_t sync = 0;         ///< period of sync points [ns]; commands, services and outputs live on them
  std::optional<double> budget;  ///< wall time of a sync period, at which implicit steps end their sweeps [s]
};

struct MethodDefinition {
  ShapeKind shape = ShapeKind::ugimp;
  UpdateScheme update = UpdateScheme::usavg;
  std::optional<int> sweeps;  ///< sweeps of each implicit step; without it as many as its contacts need
  Transfer transfer;
  bool average_dilatation = false;  ///< volume changes averaged over the grid, against locking
  /// True gives what flows one stress in a cell (mechanics/stress_average.hpp); see averages_stress().
  std::optional<bool> average_stress;
  DampingDefinition damping;
  AxisRules axis;                            ///< axisymmetric scenes alone
  int gradient_terms = 2;                    ///< terms of exp(grad v dt)
  int particles_per_direction = 2;           ///< particles along a cell's edge
  Precision precision = Precision::float64;  ///< precision of particle data other than positions
};

/// Order of the faces in arrays: x_min, x_max, y_min, y_max, z_min, z_max.
extern const std::array<const char*, 6> kWallNames;

/// Soil at rest at the start: under its own weight, settled before the run (simulation/geostatic.cpp).
struct GeostaticDefinition {
  std::optional<double> k0;  ///< horizontal over vertical stress; without it that of the material
  double residual = 1e-3;    ///< unbalanced force over weight at which it counts as settled
};

/// Part of a body's particles that is here, where other ranks have the rest.
struct BodyPart {
  std::vector<std::uint32_t> numbers;  ///< among all particles of the body, ascending; one for each position here
  std::uint64_t whole = 0;             ///< particles of the body on all ranks
  bool cut = false;                    ///< the body has parts and surfaces, though this rank may have no particle of it
};

/// A lattice of particles that is a body's own: centre i along an axis is at origin + (i + 1/2) spacing.
struct ParticleLattice {
  Vec3 origin = Vec3::Zero();   ///< [m]
  Vec3 spacing = Vec3::Zero();  ///< [m]
};

struct DeformableBody {
  std::string name;
  std::string material;                      ///< name in SimulationDefinition::materials
  int field = 0;                             ///< velocity field; bodies in one field move as one where they meet
  std::vector<Vec3> positions;               ///< particle centres [m]
  std::vector<Vec3> velocities;              ///< one each, or empty for rest [m/s]
  std::vector<Symmetric3<double>> stresses;  ///< Cauchy stress at the start, one each, or empty [Pa]
  /// True if in plane strain the yy of these stresses follows from the others. In a line yy and zz always do; in plane
  /// stress they are zero.
  bool yy_follows = false;
  std::vector<double> temperatures;  ///< at the start, one each, or empty for that of the material [K]
  std::optional<GeostaticDefinition> geostatic;
  double particle_volume = 0.0;  ///< volume of a particle at the start [m^3]; for rings the area of their section [m^2]
  std::vector<double> parts;     ///< part of it that each particle has; empty where each has all of it
  /// Distance of each particle's centre from the surface of the body beside it, over the reach of its box (or 1 away
  /// from it): so far contact sees it reach. Empty where that is 1 for each.
  std::vector<double> surfaces;
  std::optional<ParticleLattice> lattice;  ///< without it the grid's: particles_per_direction from grid.min on
  std::string filling;                     ///< difference from the grid's lattice, for reports; may be empty
  std::optional<BodyPart> part;            ///< without it all particles of the body are here
};

/// An acceleration of the material as a function of time, place and place at the start (mechanics/particle_loads.hpp).
struct BodyForceDefinition {
  std::string body;                      ///< deformable body that it acts on; all when empty
  std::array<Function, 3> acceleration;  ///< [m/s^2]
  LoadSpread spread = LoadSpread::domain;
};

/// A force on particles of a body, as a function of time, place and place at the start (mechanics/particle_loads.hpp).
struct ParticleForceDefinition {
  std::string body;                      ///< deformable body that it acts on
  std::vector<std::uint32_t> particles;  ///< by number among all of the body's, on all ranks; all when empty
  std::array<Function, 3> force;         ///< [N]
  bool shared = true;                    ///< true if they share the force in proportion to mass; else it acts on each
  LoadSpread spread = LoadSpread::domain;
};

/// A traction on a face of each of some particles of a body, a force over its current area
/// (mechanics/face_tractions.hpp), as functions of time, place and place at the start.
struct TractionDefinition {
  std::string body;  ///< deformable body that it acts on
  int face = 0;      ///< face of the particles' domains, in the order of kWallNames
  /// By number among all of the body's, on all ranks; the outermost of each row when empty.
  std::vector<std::uint32_t> particles;
  bool follows = false;  ///< true if its axes turn with the face's normal and edges
  /// Components along world axes [Pa]; if it follows the face, pressure (compression is positive), then shear along the
  /// edges that span the face, in the order of axes.
  std::array<Function, 3> value;
};

/// Place where contact with rigid bodies acts.
enum class ContactMethod {
  points,  ///< at points of the material's surface (contact/point_contact.hpp)
  nodes    ///< at the grid's nodes in the body (contact/rigid_contact.hpp)
};
/// The law between two deformable bodies of different velocity fields, or a deformable body and a rigid one, by name.
struct PairDefinition {
  std::string first, second;  ///< a rigid body is the second
  ContactLaw law;
};
struct ContactDefinition {
  ContactMethod method = ContactMethod::points;
  bool sharp_edges = true;  ///< contact at points: whether they see where a tool's face ends (contact/edge_cover.hpp)
  NormalRule normals;       ///< between deformable bodies (contact/material_contact.hpp) and for rigid particles
  DetectionRule detection;  ///< for the same contact
  /// Deformable bodies of different fields without a law pass through each other; a rigid body has a law with all.
  std::vector<PairDefinition> pairs;
};

enum class Statistic { mean, std_dev, min, max, sum };
struct TimeWindow {
  double from = 0.0, to = 0.0;  ///< [s]
};
/// A number of the summary: a statistic of a particle field over one body (over all when `body` is empty), a number of
/// the whole run, or a formula of the metrics before it.
struct MetricDefinition {
  std::string name;
  std::string number = {};   ///< that a module reports (NamedNumber); empty: a statistic
  std::string formula = {};  ///< an expression of metrics before it and of `constants`
  NamedConstants constants = {};
  Statistic statistic = Statistic::mean;
  std::string field;
  std::string body;
  /// With a window, the number is the statistic's rate of change in it [1/s]: the slope of the least-squares line
  /// through its values at sync points. Without one it is the statistic at the end.
  std::optional<TimeWindow> rate;
  std::optional<TimeWindow> over;  ///< the number is the mean over the sync points after `from`, up to `to`
  std::optional<double> at;        ///< the number is that of the first sync point not before this time [s]
  std::optional<Box> region;       ///< particles whose centres are in it, at that time [m]; all of the body without one
};

struct SimulationDefinition {
  std::string name;
  GeometryKind geometry = GeometryKind::solid;
  double thickness = 1.0;  ///< thickness of a planar scene, along y [m]
  double area = 1.0;       ///< area of a line, across x [m^2]
  GridDefinition grid;
  TimeDefinition time;
  MethodDefinition method;
  Vec3 gravity = Vec3::Zero();  ///< [m/s^2]
  std::vector<MaterialDefinition> materials;
  std::vector<DeformableBody> bodies;
  std::vector<RigidBodyDefinition> rigid_bodies;
  std::vector<RobotDefinition> robots;  ///< their links are among rigid_bodies
  ContactDefinition contact;
  std::array<WallDefinition, 6> walls;
  std::vector<ConditionDefinition> conditions;
  std::vector<BodyForceDefinition> body_forces;
  std::vector<ParticleForceDefinition> particle_forces;
  std::vector<TractionDefinition> tractions;
  std::optional<SleepDefinition> sleep;
  std::optional<BedDefinition> bed;  ///< ground that follows bodies; it is the only deformable body
  TransportDefinition transport;
  CracksDefinition cracks;
  std::vector<VolumeDefinition> volumes;
  std::vector<MetricDefinition> metrics;
  std::vector<std::string> warnings = {};  ///< one line each, of who made the definition

  /// Size of a particle across the grid's axes: thickness [m] in a plane, area [m^2] in a line, 1 in a solid.
  double across() const { return planar(geometry) ? thickness : (geometry == GeometryKind::line ? area : 1.0); }
  /// Shortest edge of a grid cell [m].
  double smallest_cell() const { return shortest_edge(grid.cell, geometry); }
};

/// Material of a body. @throws DefinitionError when there is none of that name
const MaterialDefinition& find_material(const SimulationDefinition& definition, const DeformableBody& body);

}  // namespace mpm
