// The mechanics kernels: what happens to the particles of one block of the grid in a step. The story of a step (USF):
//
//   scatter_momentum   tile of m v, m       <-  particles, by S                         (nodes: v = m v / m)
//   strain             grad v               <-  tile of v, by G                         GIMP notes (2.2)
//     (the law)        F, tau               <-  grad v dt, a register of particles at a time
//     and force        tile of f            <-  -m tau G, GIMP notes (1.26)             (nodes: a = f / m)
//   move               v, x of particles    <-  tiles of v and a, by S                  GIMP notes (2.15), (2.16)
//
// USAVG lets `move` scatter the new momentum as well, and strains once more, each time by half a step. Loads on
// particles add `scatter_load`. Between periods `survey` finds what limits the time step (survey.hpp).
//
// Particles lie sorted by block (4 nodes along each axis), and inside a block by nearest node, the last axis fastest. A
// block works on a tile, its surroundings of 8 nodes along each axis in cache (tile.hpp): copied in, computed on,
// added out; no two blocks of one colour touch the same node. Gathers fill the lanes of a register with particles of
// one column of nodes (gather.hpp); scatters take a particle at a time and fill the lanes with nodes and components
// (scatter.hpp). Weights are made anew for every pass, a chunk of particles at a time (weights.hpp); laws take a
// register of particles at a time, whatever column they are of (stress.hpp).
//
// This file is the border: plain data and a table of functions. Behind it every file is compiled once an instruction
// set, with the namespace mpm under another name, so that nothing inline is shared; the table is chosen at run time.
// A shape function whose support is three nodes along each axis (uGIMP, quadratic splines) is a class as in
// shape/ugimp.hpp; one whose nodes are scattered (CPDI) brings passes of its own and fills the same table. Neither
// touches the schedule (mechanics/continuum.cpp); a test does both. In a plane, what happens out of it is the policy of
// the geometry (math/dimension.hpp): the passes ask it for the gradient and the columns of a stress.
#pragma once

#include <cstdint>

namespace mpm_kernel {

constexpr int kTileEdge = 8;     ///< nodes of a tile along an axis
constexpr int kTileMargin = 2;   ///< of these, before the block's first
constexpr int kMostHistory = 3;  ///< scalars of history that a law may have
constexpr double kSlack = 1e-5;  ///< of the limits that `move` reports on [cells]

/// The grid: nodal fields are [block][component][node], 64 nodes a block (16 in a plane).
struct GridView {
  double origin[3], inverse_cell[3];
  double least_mass;  ///< a node with less takes no part [kg]
  double* mass;       ///< [kg]
  double* momentum;   ///< as gathered [N s]
  double* velocity;   ///< [m/s]
  double* force;      ///< force [N], then acceleration [m/s^2]
};

/// The block at work.
struct BlockView {
  int owner;              ///< its number among the blocks that hold particles
  const int* neighbours;  ///< indices of the 3^dim blocks around it, the last axis fastest
  int corner[3];          ///< node numbers of the tile's lower corner
  bool loose;             ///< particles have moved beyond it since they were sorted: the whole tile is in use
};

/// The particles of one body.
template <class T>
struct SetView {
  const std::uint32_t* group;        ///< first particle of each group, and one past the last
  const std::uint32_t* group_begin;  ///< first group of each owner, and one past the last
  double mass;                       ///< of a particle [kg]
  double half[3];                    ///< half of its box [cells]
  double lowest[3], highest[3];      ///< where a centre may be [cells]
  const double* x[3];                ///< [m]
  double* next_x[3];                 ///< where `move` puts it; may be x
  T* v[3];                           ///< [m/s]
  T* f[9];                           ///< deformation gradient
  T* tau[6];                         ///< Kirchhoff stress over initial density [J/kg]
  T* history[kMostHistory];
  const double* load[3];  ///< acceleration by a load; null without one [m/s^2]
  const void* law;        ///< the law
  int law_kind;           ///< its index in the list of laws (material/law.hpp)
};

struct StrainSettings {
  double dt;       ///< [s]
  int terms;       ///< of exp(grad v dt)
  bool and_force;  ///< the internal force goes to the grid
};

struct MoveSettings {
  double dt;      ///< [s]
  double flip;    ///< FLIP fraction
  bool regather;  ///< the new momentum goes to the grid
};

/// Where particles are after `move`.
struct Moved {
  bool loose;  ///< some have left the block
  bool gone;   ///< some have left the tile's reach or the place where they may be, or are not finite
  int groups;  ///< groups of particles, and how often they were gathered: once when all lanes share a column
  int parts;
};

struct Failure {
  int set;       ///< -1: none
  int particle;  ///< the first whose J is not positive
};

/// The particle that limits the time step, of several.
struct Fastest {
  double rate;   ///< of its waves, motion and viscosity, across a cell [1/s]; perhaps not a number
  int particle;  ///< the first one of equal rates; one whose rate is not a number comes before all others
};

/// One geometry, shape function, precision and instruction set. Functions of a block work on all sets of particles.
template <class T>
struct KernelTable {
  int lanes;       ///< particles of a register: the largest group
  bool by_column;  ///< a group's particles share a column of nodes; else their nearest node
  void (*scatter_momentum)(const GridView&, const BlockView&, const SetView<T>*, int sets);
  Failure (*strain)(const GridView&, const BlockView&, const SetView<T>*, int sets, const StrainSettings&);
  Moved (*move)(const GridView&, const BlockView&, const SetView<T>*, int sets, const MoveSettings&);
  void (*scatter_load)(const GridView&, const BlockView&, const SetView<T>*, int sets, double* field);
  /// Of particles [first, last) of a set, fewer than 2^24 of them; `cell`: the smallest edge [m].
  Fastest (*survey)(const SetView<T>&, int first, int last, double cell);
  /// v = p / m on the nodes of blocks [first, last).
  void (*nodal_velocity)(const GridView&, int first, int last);
  /// a = f / m + gravity, v = p / m + a dt on the nodes of blocks [first, last).
  void (*nodal_update)(const GridView&, int first, int last, double dt, const double* gravity);
};

}  // namespace mpm_kernel
