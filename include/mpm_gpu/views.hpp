// Arguments of kernels: plain numbers and pointers into memory that outlives a step.
//
// Particles are arrays of components, sorted by set, then by the cell around their nearest node; T, double or float, is
// the precision of all but places, which are double. Nodes lie in blocks of 4 along each axis, of which there are those
// that hold particles and the blocks around them, in the order of their keys; nodal numbers are [component][node] with
// `nodes` in a component, and double as in the solver.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace mpm_gpu {

constexpr int kMostHistory = 4;  ///< scalars of history that a law may have
constexpr int kEdge = 4;         ///< nodes of a block along an axis
constexpr int kBeside = 8;       ///< nodes below the domain's first that have a number in the table

constexpr int nodes_of_block(int dim) { return dim == 3 ? 64 : 16; }
constexpr int neighbours_of(int dim) { return dim == 3 ? 27 : 9; }

constexpr std::uint64_t kNoBlock = ~std::uint64_t{0};  ///< key of a place in the table that no block takes

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
  int period[3];                     ///< nodes of a periodic axis, a whole number of blocks; 0 of others
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

/// Number of a node among those of a periodic axis, 0 to the period less one; of other axes as it is.
constexpr int around(const GridView& grid, int k, int node) {
  const int period = grid.period[k];
  return period == 0 ? node : node < 0 ? node + period : node >= period ? node - period : node;
}
/// Key of one of the 3^dim blocks around a block, by its number, the last axis fastest.
constexpr std::uint64_t neighbour_key(const GridView& grid, int dim, std::uint64_t key, int number) {
  std::uint64_t neighbour = 0, part = 1;
  for (int k = dim - 1; k >= 0; --k, number /= 3) {
    const auto along = static_cast<std::uint64_t>(grid.blocks_along[k]);
    const int block = static_cast<int>(key % along) + number % 3 - 1;
    const int wrapped = around(grid, k, block * kEdge - kBeside);
    neighbour += part * static_cast<std::uint64_t>((wrapped + kBeside) / kEdge);
    part *= along;
    key /= along;
  }
  return neighbour;
}

/// Numbers along the axes of a block of the table as the host counts blocks (mpm/grid/grid_layout.hpp).
constexpr std::array<int, 3> host_block(const GridView& grid, int dim, std::uint64_t key) {
  std::array<int, 3> block{};
  for (int k = dim - 1; k >= 0; --k) {
    const auto along = static_cast<std::uint64_t>(grid.blocks_along[k]);
    block[static_cast<std::size_t>(k)] = static_cast<int>(key % along) - kBeside / kEdge;
    key /= along;
  }
  return block;
}
/// Key of the block with these numbers.
constexpr std::uint64_t key_of_host_block(const GridView& grid, int dim, const std::array<int, 3>& block) {
  std::uint64_t key = 0;
  for (int k = 0; k < dim; ++k) {
    key = key * static_cast<std::uint64_t>(grid.blocks_along[k]) +
          static_cast<std::uint64_t>(block[static_cast<std::size_t>(k)] + kBeside / kEdge);
  }
  return key;
}

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
  const std::uint32_t* id;
  const T* mass;     ///< null where all of each set have the same [kg]
  const T* surface;  ///< ParticleSet::surface; null without cut places
  double* taken;     ///< [number][particle], what its update took in this step (taken.hpp); null where nobody asks
};

/// Findings of a kernel about a particle.
enum Fault : std::uint8_t { kLeftCell = 1, kOutside = 2, kInverted = 4, kReturned = 8 };

/// Sums over particles, times their mass: energies [J], momentum [N s], places [kg m].
struct Totals {
  double kinetic = 0.0, elastic = 0.0, plastic = 0.0;
  double carried = 0.0;  ///< sum of speeds, as of momentum
  double momentum[3] = {}, place[3] = {};
  double least_j = 1e300;

  constexpr Totals& operator+=(const Totals& other) {
    kinetic += other.kinetic;
    elastic += other.elastic;
    plastic += other.plastic;
    carried += other.carried;
    for (int k = 0; k < 3; ++k) {
      momentum[k] += other.momentum[k];
      place[k] += other.place[k];
    }
    if (!(other.least_j >= least_j)) least_j = other.least_j;
    return *this;
  }
};

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
  double* load;                ///< forces beside the internal ones; null without any [N]
  double* work;                ///< work of increments that FLIP is mixed with; null without them [J]
  /// 1 at nodes near rigid bodies, where frictional walls act after contact; null where none is marked.
  const std::uint8_t* near;
  // Numbers of nodes on walls alone, [row][component][node]: a row for the wall at a face of each axis, or one for all
  // where each axis of a node is held by one wall.
  int held_rows;
  double* held;       ///< impulse that walls give in a step [N s]
  double* held_more;  ///< the same on increments and after contact; null where there are none
  double* left;       ///< velocity that walls leave before increments; null without frictional walls [m/s]
  double* moved;      ///< change of the velocity for the strain by contact; null where walls act once [m/s]
  double* averaged;   ///< energy that mean stresses take in the cell above a node; null without them [J]
};

struct StepSettings {
  double dt;                ///< [s]
  double strain_dt;         ///< time of one update of strain: half of dt where there are two [s]
  double flip;              ///< fraction of FLIP; the rest is PIC
  bool from_start;          ///< XPIC: increments are of the velocity at the step's start
  int terms;                ///< number of terms of exp(grad v strain_dt)
  int increments;           ///< number of increments of XPIC or FMPM
  double part;              ///< part of the next increment that particles take over, where XPIC is mixed with FLIP
  bool solved;              ///< a stage solves an implicit step: no internal force, and loads work on its end
  bool driven;              ///< forces act on the nodes beside the internal ones and gravity
  double node_damping;      ///< rate of a force on the nodes, which is one of these [1/s]
  bool damped;              ///< damping acts in the particles' update, or its energies are asked for
  double grid_damping;      ///< rate there on the grid's velocity at the particle [1/s]
  double particle_damping;  ///< and on its own [1/s]
};

/// Loads on particles (loads.hpp).
struct LoadView {
  long count, ids;            ///< number of loads whose value is the same wherever they act, and of particles
  const std::uint32_t* acts;  ///< by id: bit t if load t of these acts on the particle
  const double* value;        ///< [load][axis], in this step [m/s^2]
  const double* fixed;        ///< [axis][id], of loads that differ from particle to particle; null without any [m/s^2]
};

/// Tractions on faces of particles' boxes (tractions.hpp).
struct TractionView {
  long count;
  const std::uint32_t* acts;  ///< by id: bit t if traction t acts on the particle
  const int* face;            ///< face of each, 2 * axis, + 1 for the upper one
  const double* force;        ///< [traction][axis], on the face of a particle in this step [N]
};

/// Nodes at which velocities are prescribed (prescribed.hpp). Entries of a node follow each other, and are orthogonal.
struct HeldView {
  long nodes, entries;
  const std::uint32_t* node;   ///< numbers in the table
  const std::uint32_t* first;  ///< first entry of each, and one past the last
  const double* direction;     ///< [entry][axis], unit vectors
  const double *start, *end;   ///< [entry], velocity along it as the step begins and ends [m/s]
  double* given;               ///< [entry], impulse along it in this step [N s]
};
/// Velocity that is to be held there.
enum class HeldPart : int { strain_at_start, strain_at_end, motion, first_increment, increment };

/// A step as kernels are given it.
template <class T>
struct StepView {
  GridView grid;
  ParticleView<T> particles;
  NodeView nodes;
  const SetView* sets_there;
  int set_count;
  StepSettings settings;
};
/// The same for the host, which hands out the passes; kernels are given no more than the view.
template <class T>
struct Step : StepView<T> {
  const SetView* sets;
};

}  // namespace mpm_gpu
