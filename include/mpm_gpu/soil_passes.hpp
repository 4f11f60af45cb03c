// Passes of the implicit step on a device (implicit_soil.hpp): arguments of its kernels, and the table of them. The
// kernels (soil_kernels.hpp) are code of one lane: a cell of soil is a group of one cell (mpm/kernel/soil_cells.hpp).
//
// Above each node of the table there is a cell of each soil, empty where no particle reaches it. Cells of a block whose
// numbers along each axis are odd or even alike share no node. They are the members of a turn, and lie beside each
// other: [soil][block][turn][member]. Blocks of one colour share no node either, and are swept at once.
#pragma once

#include <cstdint>

#include "mpm/kernel/soil_cells.hpp"
#include "mpm_gpu/executor.hpp"
#include "mpm_gpu/views.hpp"

namespace mpm_gpu {

constexpr int kSoilNumbers = 10;  ///< numbers that a particle gives to its cells

/// Holders of a component of a node's velocity, in the numbers of mpm::SoilGrid.
constexpr std::uint8_t kFreeComponent = 255, kAtRestComponent = 6;

/// Place of a cell among those of its block, by its number along each axis, of a node likewise, 0 to 3: that of its
/// turn, and in this of the member.
template <int Dim>
constexpr int place_of_cell(const int* at) {
  int turn = 0, member = 0;
  for (int k = 0; k < Dim; ++k) {
    turn |= (at[k] & 1) << (Dim - 1 - k);
    member = 2 * member + (at[k] >> 1);
  }
  return turn * (1 << Dim) + member;
}
/// The other way round.
template <int Dim>
constexpr void cell_at(int turn, int member, int* at) {
  for (int k = Dim - 1; k >= 0; --k, member >>= 1) at[k] = 2 * (member & 1) + (turn >> (Dim - 1 - k) & 1);
}

/// Memory of the soil in a step.
template <class T>
struct SoilView {
  mpm_kernel::SoilNode<T>* node;    ///< [node], and one more that stands for none
  mpm_kernel::SoilNode<T>* before;  ///< as the last pair of sweeps began with them
  mpm_kernel::SoilGroup<T, 1>* cell;
  mpm_kernel::SoilMask<T, 1>* mask;   ///< [cell]
  mpm_kernel::SoilMotion<T>* motion;  ///< [cell]
  T* number[kSoilNumbers];            ///< [particle]
  const std::uint8_t* holder;         ///< [node][world axis]
  mpm_kernel::SweepChange* change;    ///< [block][member], of each block's last sweep
  const std::int32_t* soil_of_set;    ///< [set]: number of its soil
  double lightest;                    ///< added to a node's mass [kg]
  int soils;
  bool loads;  ///< forces act that are not in proportion to mass
};

/// Rows of the contacts of blocks of one colour.
template <class T>
struct RowsView {
  mpm_kernel::ContactRow<T>* row;
  mpm_kernel::WallRow<T>* wall;
  const std::int32_t* range;  ///< [block]: first row and one past the last, first row of walls and one past the last
};

/// Impulses that stresses give to held components, of the six walls along the world axes [N s].
struct HeldSums {
  double of[6][3] = {};
  constexpr HeldSums& operator+=(const HeldSums& other) {
    for (int w = 0; w < 6; ++w) {
      for (int k = 0; k < 3; ++k) of[w][k] += other.of[w][k];
    }
    return *this;
  }
};
/// Sums of mpm::SoilDeeds.
struct DeedSums {
  HeldSums held;
  double light[3] = {}, taken = 0.0;
  constexpr DeedSums& operator+=(const DeedSums& other) {
    held += other.held;
    for (int k = 0; k < 3; ++k) light[k] += other.light[k];
    taken += other.taken;
    return *this;
  }
};

template <class T>
struct SoilPassTable {
  /// Numbers that the particles of a set give to cells. `soil`: constants, with pointers to the particles.
  void (*numbers)(Executor&, const SetView&, const mpm_kernel::SoilParticles<T>& soil, const SoilView<T>&);
  /// Velocities with gravity and loads, and inverse masses.
  void (*load)(Executor&, const Step<T>&, const SoilView<T>&);
  /// The cells of a soil, from the sets that are of it.
  void (*cells)(Executor&, const Step<T>&, const SoilView<T>&, int soil, double dt,
                const mpm_kernel::SoilConstants& constants);
  /// Gives nodes the momentum of the stresses in the blocks of one colour, by their numbers.
  void (*push)(Executor&, const Step<T>&, const SoilView<T>&, const std::int32_t* blocks, long count);
  /// Sweeps blocks of one colour that have a mark, by their numbers; `marked`, [block].
  void (*sweep)(Executor&, const Step<T>&, const SoilView<T>&, const std::int32_t* blocks, long count,
                const std::uint8_t* marked, bool backwards);
  /// [block]: sums of the changes of all members.
  void (*changes)(Executor&, const SoilView<T>&, long blocks, mpm_kernel::SweepChange* to);
  /// Lets stresses and velocities go on by `factor` times what they have changed since the last call.
  void (*go_on)(Executor&, const Step<T>&, const SoilView<T>&, T factor);
  void (*go_on_in_rows)(Executor&, const RowsView<T>&, long rows, long walls, T factor);
  /// Solves the contacts of blocks of one colour, of which `rows` has the ranges.
  void (*meet)(Executor&, const SoilView<T>&, const RowsView<T>& rows, long count);
  /// Finds what held components take of stresses; `partial`: room for the sums of groups of nodes.
  HeldSums (*held)(Executor&, const Step<T>&, const SoilView<T>&, Buffer<HeldSums>& partial);
  /// Impulses that stresses give to components at rest of some nodes, by their numbers: three of each.
  void (*held_at_rest)(Executor&, const Step<T>&, const SoilView<T>&, const std::int32_t* numbers, long count,
                       double* to);
  /// Finds the motion of all cells, for the particles.
  void (*motion)(Executor&, const Step<T>&, const SoilView<T>&);
  /// Strain and stress of the particles of a set, whose soil has this number.
  void (*take)(Executor&, const Step<T>&, const SetView&, const mpm_kernel::SoilParticles<T>& soil, const SoilView<T>&,
               int number);
  /// Sums of what nodes do beside moving, before store().
  DeedSums (*deeds)(Executor&, const Step<T>&, const SoilView<T>&, Buffer<DeedSums>& partial);
  /// Gives the grid the velocities that were found.
  void (*store)(Executor&, const Step<T>&, const SoilView<T>&);
  /// Gives components at rest of some nodes the velocity that they would have, with these impulses, three of each.
  void (*store_at_rest)(Executor&, const Step<T>&, const SoilView<T>&, const std::int32_t* numbers, long count,
                        const double* impulses);
  /// Copies nodes by their numbers, to a list or from one.
  void (*pack)(Executor&, const SoilView<T>&, const std::int32_t* numbers, long count, mpm_kernel::SoilNode<T>* to);
  void (*unpack)(Executor&, const SoilView<T>&, const std::int32_t* numbers, long count,
                 const mpm_kernel::SoilNode<T>* from);
  /// Copies impulses of rows, three numbers each.
  void (*impulses)(Executor&, const RowsView<T>&, long rows, long walls, T* to);
  /// [block]: 1 where a block holds particles.
  void (*owners)(Executor&, const Step<T>&, std::uint8_t* to);
};

const SoilPassTable<double>& soil_passes(int dim, double);
const SoilPassTable<float>& soil_passes(int dim, float);

}  // namespace mpm_gpu
