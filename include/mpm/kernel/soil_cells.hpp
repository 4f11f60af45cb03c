// Data of the sweeps of the implicit step (implicit/implicit_step.hpp): plain data and a table of functions, one
// for each instruction set and precision, as kernels.hpp has them for the passes of an explicit step.
//
// A cell has one stress, the unknown. As six numbers, compression positive, it is r = (r_N, r_T), an orthonormal map of
// the tensor s with r_N = tr(s) / sqrt(3); the strain rate e is mapped alike, extension positive:
//
//   e_N = tr / sqrt(3), e_1 = (xx - yy) / sqrt(2), e_2 = (2 zz - xx - yy) / sqrt(6), e_3..5 = sqrt(2) (yz, xz, xy).
//
// With the gradients B of the cell's eight nodes (four in a plane, where the others have no mass) e = B v, and a stress
// gives the nodes the momentum dt V B^T r. About an axis, where x is the radius, yy is the rate v_r / r of hoops, and
// in the place of a node's gradient along y stands its hoop function, the mean of N / r: volumes and masses are those
// of whole rings. Other functions sweep such cells, so that those of planes and of space know nothing of it. A sweep
// takes cell after cell and solves its law for its own stress, in closed form, with the velocities as they are:
// Gauss-Seidel. Cells of a block whose numbers along each axis are odd or even alike share no node: eight of them are
// solved at once, one a lane.
//
//   |r_T| <= sqrt(2) (cohesion + sine r_N / sqrt(3)) / k(sine), r_N >= least; flow e_T = -a r_T, e_N = theta |e_T|,
//   theta = dilates sqrt(2/3) dilation / k(dilation),
//
// with the k of Mohr-Coulomb's surface at the Lode angle of r_T (material/drucker_prager.hpp), whose direction is that
// of -b_T whatever its size; of a round cone k is 1. A sweep takes the Lode angle that the one before has found, so
// that what follows from it is not waited for. Of mu(I), a round cone, sine is mu_s + (mu_2 - mu_s) y / (y + c) with
// the rate y of |e_T| that is not elastic, and c = reference_rate sqrt(r_N / (2 sqrt(3))): the root of a quadratic
// equation (material/mu_i.hpp) at the b_T and r_N of the last sweep. With b = e - W r + shift, what the cell's rate
// would be without its stress, and the diagonal numbers w that stand for its answer to it: stick r = -b / w, or slide,
// or part. Source: G. Daviet, F. Bertails-Descoubes (2016), A semi-implicit material point method for the continuum
// simulation of granular materials, ACM Trans. Graph. 35(4) 102; the closed form with compliance, strength at no
// pressure, a limit of tension and the Lode angle is this project's.
#pragma once

namespace mpm_kernel {

constexpr int kCellNodes = 8;
constexpr int kGroupCells = 8;
/// 1 / sqrt(2), 1 / sqrt(3), 1 / sqrt(6): of the map from tensors.
constexpr double kOverRoot2 = 0.70710678118654752, kOverRoot3 = 0.57735026918962576, kOverRoot6 = 0.40824829046386302;

/// A node as sweeps see it.
template <class T>
struct alignas(4 * sizeof(T)) SoilNode {
  T v[3];          ///< [m/s]
  T inverse_mass;  ///< [1/kg]; 0 where no material is
};

/// Cells that share no node, one a lane; a device has groups of one. A lane without a cell has `push` 0 and nodes
/// without mass.
template <class T, int Cells = kGroupCells>
struct alignas(64) SoilGroup {
  T gradient[3][kCellNodes][Cells];  ///< mean of the nodes' over the soil in the cell, or the hoop function [1/m]
  T stress[6][Cells];                ///< r [Pa]
  T before[6][Cells];                ///< r as SweepTable::extrapolate() found it last [Pa]
  T shift[6][Cells];  ///< added to e: what the elastic part takes from the step's start, and closing [1/s]
  T closing[Cells];   ///< part of shift[0] by which openings close, or volume is given back [1/s]
  T weight_n[Cells], weight_t[Cells];          ///< change of the cell's e by its own r, at least [1/(Pa s)]
  T compliance_n[Cells], compliance_t[Cells];  ///< elastic, over the step [1/(Pa s)]
  T push[Cells];                               ///< dt V [m^3 s]
  T sine[Cells], cohesion[Cells];              ///< constants of the surface; cohesion [Pa]
  T dilation[Cells], dilates[Cells];
  T least[Cells];  ///< r_N at which the soil parts, if not at no strength [Pa]
  T lode[Cells];   ///< 1 where k follows the Lode angle, 0 for a round cone
  /// Constants of |r_T| <= strength + slope r_N and of the flow, at the Lode angle that the last sweep has found.
  T strength[Cells], slope[Cells], theta[Cells];
  int node[kCellNodes][Cells];
  int place[Cells];  ///< place of the cell among all places of cells; -1 without one
  T friction_rise;   ///< mu_2 - mu_s of mu(I); 0: strength does not depend on the rate
  T reference_rate;  ///< reference rate of mu(I), over the root of pressure [1/(s sqrt(Pa))]
  int mask;          ///< number of its SoilMask; -1: no node of it is held
};

/// Places of the soil of a group's cells: means over it of x, y, z, xy, xz and yz, in cells from the cell's lower
/// corner, and the number of edges in a metre along each axis; along y in a plane 0.
template <class T, int Cells = kGroupCells>
struct SoilPlaces {
  T mean[6][Cells];
  T inverse_cell[3];
  T over_radius[4][Cells];  ///< about an axis, means of 1, x, z and xz over the radius [1/m]
};

/// Marks of where nodes of a group are held, by walls, conditions or what is asleep: 0 for such components of velocity,
/// else 1.
template <class T, int Cells = kGroupCells>
struct SoilMask {
  T free[3][kCellNodes][Cells];
};

/// Effect of the velocities that were found on the cells of a group.
template <class T, int Cells = kGroupCells>
struct SoilFlow {
  T rate[6][Cells];      ///< e [1/s]
  T shear[Cells];        ///< |e_T| of its part that is not elastic [1/s]
  T opening[Cells];      ///< e_N - theta |e_T| of that part [1/s]
  T gradient[9][Cells];  ///< gradient of velocity, row by row [1/s]
};

/// A point of a rigid body at which contact acts on the nodes around it.
template <class T>
struct alignas(4 * sizeof(T)) ContactRow {
  T weight[kCellNodes][4];  ///< weight of a node along each axis, 0 where it is held; and 0
  T own;                    ///< change of the velocity at the point by an impulse there, of the axes the most [1/kg]
  T friction;               ///< coefficient; negative: no sliding while it presses
  T normal[3];              ///< out of the body
  T velocity[3];            ///< velocity of the body there [m/s]
  T impulse[3];             ///< on the material [N s]
  T before[3];              ///< impulse as extrapolate() found it last [N s]
  int node[kCellNodes];
};

/// A node on a wall with friction.
template <class T>
struct WallRow {
  int node;
  int axis;      ///< across the wall
  T out;         ///< 1 where the material lies towards higher numbers, else -1
  T free[3];     ///< 1 along axes on which nothing else holds the node, else 0
  T friction;    ///< coefficient; negative: no sliding
  T impulse[3];  ///< [N s]
  T before[3];   ///< impulse as extrapolate() found it last [N s]
};

/// Lists that are swept in one block, in this order or backwards.
template <class T>
struct SoilBlock {
  SoilGroup<T>* groups;
  ContactRow<T>* rows;
  WallRow<T>* walls;
  const SoilMask<T>* masks;
  int group_count, row_count, wall_count;
};

/// Sums over cells of push * w r^2, w the answer of a cell to its own stress: of the stresses, and of their changes in
/// a sweep [J].
struct SweepChange {
  double size, change;
};

/// Sums over the pieces of particles in a cell, weighted with volumes. About an axis 1 / r stands for
/// y, and xz / r in the place of the stress yz, which is none [1/m].
template <class T>
struct alignas(64) SoilSums {
  T volume;     ///< [m^3]
  T place[6];   ///< x, y, z, xy, xz, yz, in cells from the lower corner
  T stress[6];  ///< r
  T opening;    ///< logarithmic volume by which soil has opened, or that the pressure of metal does not account for
  T left;       ///< 1 - per_strain times plastic strain, not below 0: of soil, part of its fall of strength
  T dilates;    ///< part of its dilation that soil has
};

/// Constants of a soil that its cells have (implicit/soil_law.hpp).
struct SoilConstants {
  double bulk, shear;                  ///< [Pa]
  double sine_end, sine_fall;          ///< at the end of the fall of strength, and by how much it falls
  double cohesion_end, cohesion_fall;  ///< [Pa]
  double yield, hardening, saturation, saturation_rate;  ///< numbers of metal, as j2_plasticity has them [Pa]
  double dilation;
  double least;                          ///< r_N at which it parts [Pa]
  double friction_rise, reference_rate;  ///< as in SoilGroup
  bool follows_lode, opens, metal;       ///< opens: it remembers openings
};

/// Values that particles take from a cell.
template <class T>
struct alignas(64) SoilMotion {
  T gradient[9];     ///< gradient of velocity, row by row [1/s]
  T stress[6];       ///< r [Pa]
  T opening, shear;  ///< as in SoilFlow [1/s]
  T power;           ///< power of the stress on the strain, over volume [W/m^3]
  T unused[6];
};

/// Cells around a block, as BlockTable numbers its neighbours: where those of each block begin, by the node at their
/// lower corner, or null where none may be.
template <class T>
struct SoilPlacesOf {
  SoilSums<T>* sums[27];
  const SoilMotion<T>* motion[27];
};

/// The particles of a body of soil.
template <class T>
struct SoilParticles {
  const double* x[3];
  T* f[9];
  T* tau[6];
  T *strain, *opening, *work;  ///< history; without openings pressure is that of the volume
  const T* masses;             ///< null where all have `mass`
  double mass;                 ///< [kg]
  double half[3];              ///< half of a box along the grid's axes [cells]
  double origin[3], inverse_cell[3];
  double density;                         ///< initial [kg/m^3]
  double bulk, shear;                     ///< [Pa]
  double per_strain;                      ///< change of `left`, downwards, by plastic strain
  double strain_of_shear;                 ///< plastic strain over |e_T|
  double dilation_start, dilation_slope;  ///< DilationEnd
};

/// Passes over the particles [first, last) of a block whose first node has these numbers.
template <class T>
struct SoilPasses {
  void (*gather)(const SoilParticles<T>&, int first, int last, const int* corner, const SoilPlacesOf<T>&);
  void (*take)(const SoilParticles<T>&, int first, int last, const int* corner, const SoilPlacesOf<T>&, double dt);
};

template <class T>
struct SweepTable {
  /// Finds gradients and weights from the places of the soil, with `mask` where it is not null, and multiplies the
  /// weights with `push`.
  void (*prepare)(SoilGroup<T>&, const SoilPlaces<T>&, const SoilNode<T>* nodes, const SoilMask<T>* mask);
  /// Returns stresses to the surface of their soil, with the same direction of r_T.
  void (*project)(SoilGroup<T>&);
  /// Gives the nodes the momentum of the cells' stresses.
  void (*push)(const SoilBlock<T>&, SoilNode<T>* nodes);
  /// Solves the cells of a block once. Returns how much that changed.
  SweepChange (*sweep)(const SoilBlock<T>&, SoilNode<T>* nodes, bool backwards);
  /// Moves the stresses and impulses of a block, and the velocities of its `count` nodes, by `factor` times what they
  /// have changed since the last call, and notes them as they were; with a factor of 0 it notes them alone. `nodes`,
  /// `before`: of the block.
  void (*extrapolate)(const SoilBlock<T>&, SoilNode<T>* nodes, SoilNode<T>* before, int count, T factor);
  /// Solves the contacts of a block, walls first.
  void (*meet)(const SoilBlock<T>&, SoilNode<T>* nodes);
  /// Solves one point of contact.
  void (*touch)(ContactRow<T>&, SoilNode<T>* nodes);
  void (*flow)(const SoilGroup<T>&, const SoilNode<T>* nodes, SoilFlow<T>&);
  SoilPasses<T> passes;
};

/// Cells of space, of a plane strained in x and z, and sections of rings in x and z.
enum class CellKind { space, plane, rings };
constexpr int kCellKinds = 3;

/// One instruction set, by CellKind.
struct SweepFamily {
  SweepTable<double> in_double[kCellKinds];
  SweepTable<float> in_single[kCellKinds];
};

}  // namespace mpm_kernel
