// The mechanics kernels: what happens to the particles of one block of the grid in a step. The story of a step (USF):
//
//   scatter_momentum   tile of m v, m       <-  particles, by S                         (nodes: v = m v / m)
//   strain             grad v               <-  tile of v, by G                         GIMP notes (2.2)
//     (the law)        F, tau               <-  grad v dt, a register of particles at a time
//     and force        tile of f            <-  -m tau G, GIMP notes (1.26)             (nodes: a = f / m)
//   move               v, x of particles    <-  tiles of v and a, by S                  GIMP notes (2.15), (2.16)
//
// USAVG lets `move` scatter the new momentum as well, and strains once more, each time by half a step; USL strains only
// then, and begins with `force`. XPIC and FMPM `project` velocities to and fro before particles adopt them; APIC
// scatters and gathers an affine field. Between periods a law's `survey` finds what limits the time step (survey.hpp).
// Whatever else moves between particles and nodes (loads, volumes, a temperature) goes by `gather`, `gradient`,
// `spread` and `spread_gradient`, which know neither mass nor law of a body.
//
// Particles lie sorted by block (4 nodes along each axis), and inside a block by nearest node, the last axis fastest. A
// block works on a tile, its surroundings of 8 nodes along each axis in cache (tile.hpp): copied in, computed on,
// added out; no two blocks of one colour touch the same node. Gathers fill the lanes of a register with particles of
// one column of nodes (gather.hpp); scatters take a particle at a time and fill the lanes with nodes and components
// (scatter.hpp). Weights are made anew for every pass, a chunk of particles at a time (weights.hpp); laws take a
// register of particles at a time, whatever column they are of (stress.hpp).
//
// This file is the border: plain data and tables of functions. Behind it every file is compiled once an instruction
// set, with the namespace mpm under another name, so that nothing inline is shared; tables are chosen at run time.
// Passes are written once, in passes.hpp, over an interpolator, which knows a shape function as weights on nodes. There
// are two: product_interpolator.hpp, for products of three or five values along each axis (uGIMP, splines; a class as
// in shape/ugimp.hpp makes the values), and point_interpolator.hpp, for sums over points of a deformed domain (CPDI; a
// class as in shape/cpdi.hpp). Shape functions and laws do not know each other: between the passes and a geometry's
// laws go chunks of velocity gradients and stresses.
#pragma once

#include <cstdint>

namespace mpm_kernel {

constexpr int kTileEdge = 8;          ///< nodes of a tile along an axis
constexpr int kTileMargin = 2;        ///< number of these before the block's first
constexpr int kMostHistory = 4;       ///< scalars of history that a law may have
constexpr double kSlack = 1e-5;       ///< slack of the limits that `move` reports on [cells]
constexpr int kChunk = 64;            ///< particles at a time
constexpr int kBuffer = kChunk + 16;  ///< and what the last register writes beyond them
constexpr double kNoWall = 1e9;       ///< node number of a wall that there is not

/// The grid: nodal fields are [block][component][node], 64 nodes a block (16 in a plane, 4 in a line).
struct GridView {
  double origin[3], inverse_cell[3];
  double low_wall[3], high_wall[3];  ///< node numbers of the domain's faces that are walls
  double least_mass;                 ///< a node with less takes no part [kg]
  double* mass;                      ///< [kg]
  double* momentum;                  ///< as gathered, until XPIC's increments or the next gathering use it [N s]
  double* velocity;                  ///< [m/s]
  double* force;                     ///< force [N], then acceleration [m/s^2]
};

/// The block at work.
struct BlockView {
  int owner;              ///< its number among the blocks that hold particles
  const int* neighbours;  ///< indices of the 3^dim blocks around it, the last axis fastest
  int corner[3];          ///< node numbers of the tile's lower corner
  bool loose;             ///< particles have moved beyond it since they were sorted: the whole tile is in use
};

template <class T>
struct LawKernels;
template <class T>
struct ShapeKernels;

/// The particles of one body.
template <class T>
struct SetView {
  const std::uint32_t* group;            ///< first particle of each group, and one past the last
  const std::uint32_t* group_begin;      ///< first group of each owner, and one past the last
  double mass;                           ///< mass of a particle [kg]
  bool weighed;                          ///< true if particles have masses of their own, on any rank
  const T* masses;                       ///< these [kg]; null if there are none here
  double half[3];                        ///< half of its box [cells]
  bool whole_domains, planar_functions;  ///< about an axis: AxisRules (shape/axis_rules.hpp)
  double lowest[3], highest[3];          ///< limits of a centre [cells]
  const double* x[3];                    ///< [m]
  double* next_x[3];                     ///< place where `move` puts it; may be x
  T* v[3];                               ///< [m/s]
  T* f[9];                               ///< deformation gradient
  T* tau[6];                             ///< Kirchhoff stress over initial density [J/kg]
  T* history[kMostHistory];
  T* domain[9];  ///< F in the grid's axes (of a stretching box: its diagonal) as the step began
  T* affine[9];  ///< APIC: B, sum of S v_c (x_i - x_p)_k, [component][axis] [m^2/s]
  /// Rates of damping by place, on the grid's and on the particle's velocity [1/s]; null where constant.
  const double* damping[2];
  /// Strain that brings no stress, as heat and moisture bring, alike along all axes: what it is to be, and what it was
  /// when the stress was last computed (free_strain.hpp). Null where no material expands.
  const double* free_strain;
  double* strained_free;
  /// Slope of the free strain along each axis that the next increment is enhanced by [1/m], then 0; and the distance to
  /// the place whose slope the gradient takes [m] (transport/enhanced_strain.hpp). Null where there is none.
  double* free_slope[3];
  const double* slope_lead[3];
  const void* law;  ///< the law; null where no pass asks for it
  const LawKernels<T>* law_kernels;
  const ShapeKernels<T>* shape;  ///< null for points of domains
};

/// Numbers of a set's particles beside what SetView has, for the passes that take any: arrays in the order of the
/// particles. The set takes no part where the first one is null.
struct ParticleArrays {
  const double* from[3];
  double* to[3];
};

struct StrainSettings {
  double dt;                           ///< [s]
  int terms;                           ///< number of terms of exp(grad v dt)
  bool and_force;                      ///< the internal force goes to the grid
  const double* dilatation = nullptr;  ///< on the nodes, to take in place of the particles' own (mean.hpp) [1/s]
};

struct MoveSettings {
  double dt;                      ///< [s]
  double flip;                    ///< FLIP fraction
  bool regather;                  ///< the new momentum goes to the grid
  bool counted = false;           ///< true if what the PIC fraction takes is counted; it is whenever `damped`
  bool damped = false;            ///< damping acts in the particles' update, or its energy is asked for
  bool by_point = false;          ///< about an axis: AxisMotion::point
  double grid_damping = 0.0;      ///< rate on the grid's velocity at the particle, where it is constant [1/s]
  double particle_damping = 0.0;  ///< rate on the particle's own velocity [1/s]
};

/// Places of particles after `move`.
struct Moved {
  bool loose;  ///< some have left the block
  bool gone;   ///< some have left the tile's reach or the place where they may be, or are not finite
  int groups;  ///< groups of particles, and how often they were gathered: once when all lanes share a column
  int parts;
  double slip_energy = 0.0;       ///< counted: kinetic energy that the PIC fraction took [J]
  double drag_energy = 0.0;       ///< damped: the same of damping [J]
  double drag[3] = {};            ///< damped: momentum that damping took [N s]
  double grid_kinetic = 0.0;      ///< damped: sum of m |v0|^2 / 2, v0 the grid's velocity that is damped [J]
  double particle_kinetic = 0.0;  ///< damped: the same of the particles' own [J]
};

/// About an axis: where v_r / r stands after the gradients of a plane, and the column of the hoop stress after theirs.
constexpr int kHoopGradient = 4, kHoopColumn = 2;

/// Velocity gradients of a chunk [1/s]: d v_c / d x_k of dim axes is l[c * dim + k]. Of a scalar: its gradient, c = 0.
template <class T>
struct ChunkGradients {
  alignas(64) T l[9][kBuffer];
};
/// Columns of -m tau of every particle of a chunk [J]: the force through a face, four numbers a particle.
template <class T>
struct ChunkStresses {
  alignas(64) T column[3][4 * kBuffer];
};

struct Failure {
  int set;       ///< -1: none
  int particle;  ///< the first whose J is not positive
};

/// The particle that limits the time step, of several.
struct Fastest {
  double rate;   ///< rate of its waves, motion and viscosity, across a cell [1/s]; perhaps not a number
  int particle;  ///< the first one of equal rates; one whose rate is not a number comes before all others
};

/// One law in one geometry and precision (stress.hpp, survey.hpp).
template <class T>
struct LawKernels {
  /// Particles [first, first + count): F <- exp(grad v dt) F, then the law; with `out`, the new stress's columns too.
  /// Returns the place in the chunk of the first particle whose J is not positive, or `count`.
  int (*update)(const SetView<T>&, int first, int count, const ChunkGradients<T>&, const StrainSettings&,
                ChunkStresses<T>* out);
  /// Columns of the stress as it is.
  void (*columns)(const SetView<T>&, int first, int count, ChunkStresses<T>& out);
  /// Finds the fastest of particles [first, last), fewer than 2^24 of them; `cell`: the smallest edge [m].
  Fastest (*survey)(const SetView<T>&, int first, int last, double cell);
};

/// Values beside the values of a shape function: nothing; its gradient [1/m]; the values' first moments about the
/// particle S (x_i - x_p) [m], which give B of APIC; these over their second moment D [1/m], by which B D^-1 (x_i -
/// x_p) goes to the grid.
enum class Beside { nothing, gradient, moment, affine };

/// A shape function that is a product along the axes, in one number of axes and precision (weights.hpp).
template <class T>
struct ShapeKernels {
  /// By Beside: the weights of particles [first, first + count), at most kChunk, of the block; `weights` is of the type
  /// in weights.hpp for this number of axes and of nodes along an axis.
  void (*fill[4])(const GridView&, const BlockView&, const SetView<T>&, int first, int count, void* weights);
  bool stretches;  ///< a particle's box follows F_kk of the step's start: SetView::domain
};

/// Way in which particles take over the grid's motion.
enum Motion {
  kIncrement,  ///< FLIP, PIC: velocity gains the acceleration
  kAdopt,      ///< XPIC, FMPM: velocity becomes the grid's
  kAffine,     ///< APIC: the same, and the first moment of the grid's velocity
  kMotions
};

/// One number of axes, shape function, precision and instruction set, and the laws of one geometry. Functions of a
/// block work on all sets of particles.
template <class T>
struct KernelTable {
  using Scatter = void (*)(const GridView&, const BlockView&, const SetView<T>*, int sets);

  int lanes;                  ///< particles of a register: the largest group
  bool by_column;             ///< a group's particles share a column of nodes; else their nearest node
  const LawKernels<T>* laws;  ///< by index in the list of laws (material/law.hpp)
  const ShapeKernels<T>* shape;
  Scatter scatter_momentum[2];  ///< m v and m; with the affine field of APIC
  Failure (*strain)(const GridView&, const BlockView&, const SetView<T>*, int sets, const StrainSettings&);
  /// The internal force of the stress as it is; with `pressure` on the nodes in place of the particles' own (mean.hpp).
  void (*force)(const GridView&, const BlockView&, const SetView<T>*, int sets, const double* pressure);
  /// `to` += m S times the particles' dilatation tr(grad v) [kg/s], or mean stress in the grid's axes [J].
  void (*spread_mean[2])(const GridView&, const BlockView&, const SetView<T>*, int sets, double* to);
  Moved (*move[kMotions])(const GridView&, const BlockView&, const SetView<T>*, int sets, const MoveSettings&);
  /// `to` += m S (S `from`): what the particles make of a field of velocities, as momentum.
  void (*project)(const GridView&, const BlockView&, const SetView<T>*, int sets, const double* from, double* to);
  /// True if a domain leaves the tile as particles now are; null where `move` knows.
  bool (*outgrown)(const GridView&, const BlockView&, const SetView<T>*, int sets);

  // Any numbers, ParticleArrays one a set; nodal fields of one component or of as many as there are axes.
  /// to[c] = sum of S component c of `field`.
  void (*gather)(const GridView&, const BlockView&, const SetView<T>*, const ParticleArrays*, int sets, int components,
                 const double* field);
  /// to[k] = sum of G_k `field`, of one component; about an axis to[2], unless null, is the sum of T `field`.
  void (*gradient)(const GridView&, const BlockView&, const SetView<T>*, const ParticleArrays*, int sets,
                   const double* field);
  /// to[k] = sum of G_k component k of `field`, which has as many as there are axes.
  void (*slopes)(const GridView&, const BlockView&, const SetView<T>*, const ParticleArrays*, int sets,
                 const double* field);
  /// The same of (x_i^2 / 2) along each axis, less the particle's place [m].
  void (*slope_lead)(const GridView&, const BlockView&, const SetView<T>*, const ParticleArrays*, int sets);
  /// Component c of `field` += S from[c], times m if `by_mass`.
  void (*spread)(const GridView&, const BlockView&, const SetView<T>*, const ParticleArrays*, int sets, int components,
                 bool by_mass, double* field);
  /// `field` += G_k from[k], summed over the axes, about an axis and T from[2] unless that is null: one component. With
  /// as many components as axes component k += G_k from[0].
  void (*spread_gradient)(const GridView&, const BlockView&, const SetView<T>*, const ParticleArrays*, int sets,
                          int components, bool by_mass, double* field);
  /// `to` -= m G_k from[0] times the gradient of `field` along k, summed over the axes: what conducts.
  void (*diffuse)(const GridView&, const BlockView&, const SetView<T>*, const ParticleArrays*, int sets,
                  const double* field, double* to);

  /// v = p / m on the nodes of blocks [first, last).
  void (*nodal_velocity)(const GridView&, int first, int last);
  /// a = f / m + gravity, v = p / m + a dt on the nodes of blocks [first, last).
  void (*nodal_update)(const GridView&, int first, int last, double dt, const double* gravity);
};

/// Passes by number of axes, less one; without laws and, of products along the axes, without the shape function. A
/// table that there is not is empty.
struct PassFamily {
  KernelTable<double> in_double[3];
  KernelTable<float> in_single[3];
};

/// A shape function by number of axes, less one.
struct ShapeFamily {
  ShapeKernels<double> in_double[3];
  ShapeKernels<float> in_single[3];
};

/// The laws of a geometry, by their index in the list of laws.
struct LawFamily {
  const LawKernels<double>* in_double;
  const LawKernels<float>* in_single;
};

}  // namespace mpm_kernel
