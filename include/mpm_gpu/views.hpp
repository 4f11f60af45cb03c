// Arguments of kernels: plain numbers and pointers into memory that outlives a step.
//
// Particles are arrays of components, sorted by set, then by the cell around their nearest node; T, double or float, is
// the precision of all but places, which are double. Nodes lie in blocks of 4 along each axis, of which there are those
// that hold particles and the blocks around them, in the order of their keys; nodal numbers are [component][node] with
// `nodes` in a component, and double as in the solver.
#pragma once

#include <cstdint>

namespace mpm_gpu {

constexpr int kMostHistory = 4;  ///< scalars of history that a law may have
constexpr int kEdge = 4;         ///< nodes of a block along an axis
constexpr int kBeside = 8;       ///< nodes below the domain's first that have a number in the table

constexpr int nodes_of_block(int dim) { return dim == 3 ? 64 : 16; }
constexpr int neighbours_of(int dim) { return dim == 3 ? 27 : 9; }

/// Place of a key in an ascending list, which holds it; -1 if it does not.
constexpr std::int32_t place_of(const std::uint64_t* keys, long count, std::uint64_t key) {
  long first = 0, end = count;
  while (first < end) {
    const long middle = (first + end) / 2;
    if (keys[middle] < key) {
      first = middle + 1;
    } else {
      end = middle;
    }
  }
  return first < count && keys[first] == key ? static_cast<std::int32_t>(first) : -1;
}

enum class Face : int { open, slip, fixed, frictional };

struct GridView {
  double origin[3], inverse_cell[3];
  int last_node[3];                  ///< on the upper face
  long blocks_along[3];              ///< edges of the box of all blocks that may be needed
  Face faces[6];                     ///< 2 * axis, + 1 for the upper one
  double friction[6];                ///< coefficients of frictional walls; infinite: none slides while pressed
  double low_wall[3], high_wall[3];  ///< node numbers of the faces that are walls
  int wall_layers;                   ///< layers of nodes beyond a wall that it holds, too
  double gravity[3];                 ///< [m/s^2]
  double least_mass;                 ///< a node with less takes no part [kg]
};

/// Nearest node of a place in cells, > -64; half way between two the upper one, as GridLayout::nearest() has it.
constexpr int nearest_node(double cells) { return static_cast<int>(cells + (64.5 + 1e-12)) - 64; }
constexpr double in_cells(const GridView& grid, int k, double x) { return (x - grid.origin[k]) * grid.inverse_cell[k]; }

/// One body.
struct SetView {
  std::uint32_t first, count;    ///< its particles
  double mass;                   ///< mass of a particle [kg]
  double half[3];                ///< half of a particle's box [cells]
  double lowest[3], highest[3];  ///< limits of a centre [cells]
  bool averages;                 ///< the mean stress of a cell is taken
  std::uint32_t first_id;        ///< ids of the set are those from here on
};

template <class T>
struct ParticleView {
  long count;
  double* x[3];       ///< [m]
  double* next_x[3];  ///< after the motion: x itself where no strain follows [m]
  T* v[3];            ///< [m/s]
  T* f[9];            ///< deformation gradient
  T* tau[6];          ///< Kirchhoff stress over initial density [J/kg]
  T* history[kMostHistory];
  double* strain_before;  ///< plastic strain at the start of the step before; null where no stress is averaged
  T* affine[9];           ///< APIC: B, sum of S v_c (x_i - x_p)_k [m^2/s]
  T* gradient[9];         ///< gradient of the velocity, in this step [1/s]
  T* domain[3];           ///< stretch of the shape function's box, of the step's start; of one that has it
  std::uint32_t* node;    ///< number of the nearest node in the table
  std::uint8_t* fault;    ///< bits of Fault, in this step
  double* slip;           ///< energy that PIC takes in this step; null with FLIP alone [J]
};

/// Findings of a kernel about a particle.
enum Fault : std::uint8_t { kLeftCell = 1, kOutside = 2, kInverted = 4 };

struct NodeView {
  long blocks, nodes;        ///< numbers of both
  const std::uint64_t* key;  ///< keys of the blocks, ascending
  const std::int32_t*
      neighbours;              ///< numbers of the 3^dim blocks around each, the last axis fastest; -1: there is none
  const std::uint32_t* begin;  ///< [set][node]: first of the particles that are nearest to it
  const std::uint32_t* end;    ///< and one past the last
  double* mass;                ///< [kg]
  double* momentum;            ///< [N s]
  double* velocity;            ///< [m/s]
  double* acceleration;        ///< [m/s^2]
  std::uint16_t* hold;         ///< bits of walls.hpp; null where no step needs them of the one before
  double* increment;           ///< increment of XPIC or FMPM that is at work [m/s]
  // Numbers of nodes on walls alone, [row][component][node]: a row for the wall at a face of each axis, or one for all
  // where each axis of a node is held by one wall.
  int held_rows;
  double* held;       ///< impulse that walls give in a step [N s]
  double* held_more;  ///< the same on increments; null without XPIC and FMPM
  double* left;       ///< velocity that walls leave before increments; null without frictional walls [m/s]
  double* averaged;   ///< energy that mean stresses take in the cell above a node; null without them [J]
};

struct StepSettings {
  double dt;         ///< [s]
  double strain_dt;  ///< time of one update of strain: half of dt where there are two [s]
  double flip;       ///< fraction of FLIP; the rest is PIC
  bool from_start;   ///< XPIC: increments are of the velocity at the step's start
  int terms;         ///< number of terms of exp(grad v strain_dt)
};

template <class T>
struct StepView {
  GridView grid;
  ParticleView<T> particles;
  NodeView nodes;
  const SetView* sets;        ///< for the host, which hands out the passes
  const SetView* sets_there;  ///< the same, for kernels
  int set_count;
  StepSettings settings;
};

}  // namespace mpm_gpu
