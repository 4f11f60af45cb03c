// What the sweeps of the implicit step (implicit/implicit_step.hpp) work on: plain data and a table of functions, one
// for each instruction set and precision, as kernels.hpp has them for the passes of an explicit step.
//
// A cell has one stress, the unknown. As six numbers, compression positive, it is r = (r_N, r_T), an orthonormal map of
// the tensor s with r_N = tr(s) / sqrt(3); the strain rate e is mapped alike, extension positive:
//
//   e_N = tr / sqrt(3), e_1 = (xx - yy) / sqrt(2), e_2 = (2 zz - xx - yy) / sqrt(6), e_3..5 = sqrt(2) (yz, xz, xy).
//
// With the gradients B of the cell's eight nodes (four in a plane, where the others have no mass) e = B v, and a stress
// gives the nodes the momentum dt V B^T r. A sweep takes cell after cell and solves its law for its own stress, in closed
// form, with the velocities as they are: Gauss-Seidel.
//
//   |r_T| <= Y(r_N) = strength + slope r_N, r_N >= least; flow e_T = -a r_T, e_N = dilation |e_T|.
//
// Strength, slope and dilation follow the Lode angle of -b_T, the direction of r_T whatever its size: tables over the sine of
// three times that angle. Source: G. Daviet, F. Bertails-Descoubes (2016), A semi-implicit material point method for the
// continuum simulation of granular materials, ACM Trans. Graph. 35(4) 102; the closed form with compliance, strength at
// no pressure, a limit of tension and the Lode angle is this project's.
#pragma once

namespace mpm_kernel {

constexpr int kCellNodes = 8;
constexpr int kLodeSteps = 64;  ///< of the tables, from -1 to 1

/// A node as sweeps see it.
template <class T>
struct alignas(4 * sizeof(T)) SoilNode {
  T v[3];          ///< [m/s]
  T inverse_mass;  ///< [1/kg]; 0 where no material is
};

/// A soil, over the sine of three times the Lode angle.
template <class T>
struct SoilLaw {
  T strength[kLodeSteps + 2];  ///< of r_T where r_N is 0 [Pa]
  T slope[kLodeSteps + 2];
  T dilation[kLodeSteps + 2];
  T residual_strength[kLodeSteps + 2], residual_slope[kLodeSteps + 2];  ///< of the critical state
  T least;                      ///< r_N at which the soil parts: minus sqrt(3) times the tension that it bears [Pa]
  T compliance_n, compliance_t;  ///< elastic, of e_N / r_N and of e_T / r_T [1/Pa]
};

/// Where walls hold nodes of a cell: 0 for the components that they hold, else 1.
template <class T>
struct SoilMask {
  T free[3][kCellNodes];
};

/// A cell with soil.
template <class T>
struct alignas(64) SoilCell {
  T gradient[3][kCellNodes];  ///< mean of the nodes' over the soil in the cell [1/m]
  T stress[8];                ///< r [Pa], and two numbers that are 0
  T shift[8];                 ///< added to e: what the elastic part takes from the step's start, and the opening [1/s]
  T weight_n, weight_t;       ///< change of the cell's own e by its own r [1/(Pa s)]
  T own_n, own_t;             ///< the same with the compliance
  T closing;                  ///< part of shift[0] by which it closes, or gives back volume [1/s]
  T push;                     ///< dt V [m^3 s]
  T left;                     ///< of the way from residual to peak strength
  T dilates;                  ///< part of the dilation that is left
  int law;
  int mask;  ///< number of its SoilMask; -1: no node of it is held
  int node[kCellNodes];
};

/// A point of a rigid body at which contact acts on the nodes around it.
template <class T>
struct ContactRow {
  T weight[3][kCellNodes];  ///< along each axis, 0 where a wall holds the node
  T own;                    ///< change of the velocity at the point by an impulse there, of the axes the most [1/kg]
  T friction;               ///< coefficient; negative: no sliding while it presses
  T normal[3];              ///< out of the body
  T velocity[3];            ///< of the body there [m/s]
  T impulse[3];             ///< on the material [N s]
  int node[kCellNodes];
};

/// A node on a wall with friction.
template <class T>
struct WallRow {
  int node;
  int axis;            ///< across the wall
  T out;               ///< 1 where the material lies towards higher numbers, else -1
  T free[3];           ///< 1 along axes on which no other wall holds the node, else 0
  T friction;          ///< coefficient; negative: no sliding
  T impulse[3];        ///< [N s]
};

/// What is swept in one block, in this order or backwards.
template <class T>
struct SoilBlock {
  SoilCell<T>* cells;
  ContactRow<T>* rows;
  WallRow<T>* walls;
  const SoilMask<T>* masks;
  int cell_count, row_count, wall_count;
};

template <class T>
struct SweepTable {
  /// Gives the nodes the momentum of the cells' stresses.
  void (*push)(const SoilBlock<T>&, SoilNode<T>* nodes);
  /// Solves the cells of a block once. Returns the sum over cells of the square of the change of stress by
  /// `push * own`, so that blocks can be compared [J].
  double (*sweep)(const SoilBlock<T>&, const SoilLaw<T>*, SoilNode<T>* nodes, bool backwards);
  /// Solves the contacts of a block, walls first.
  void (*meet)(const SoilBlock<T>&, SoilNode<T>* nodes);
  /// What the velocities that were found do to a cell: its rate of strain e, six numbers; the plastic shear |e_T| and the
  /// opening e_N - dilation |e_T| of the part of it that is not elastic [1/s].
  void (*flow)(const SoilCell<T>&, const SoilLaw<T>&, const SoilNode<T>* nodes, T dt, T* e, T* shear, T* opening);
  /// The law alone: the stress for which e = w r + b.
  void (*solve)(const SoilLaw<T>&, T own_n, T own_t, T left, T dilates, const T* b, T* r);
};

/// One instruction set.
struct SweepFamily {
  SweepTable<double> in_double;
  SweepTable<float> in_single;
};

}  // namespace mpm_kernel
