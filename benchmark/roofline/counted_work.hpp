// The least work of a step a particle, counted from the method: multiply-adds, and bytes to and from memory. What a
// kernel's share of the machine's limits is computed from; it does not depend on how a kernel is written.
//
// Counted for uGIMP (3 nodes an axis, d axes, 3^(d-1) rows of 3 nodes along the last axis), sums factored by axis:
//   weights    14 an axis for S and G of its three nodes; every pass finds its own (storing them costs more)
//   momentum   d + 1 values (mass and momentum) times 3 weights of the last axis, then one a node; 3^(d-1) products of
//              the other weights in 3D
//   gradient   a row's sums with S and with G (6), d of them joined to the d gradients of each of d components; 3
//              products of weights a row (2 in 2D)
//   force      the same in the other direction
//   law        grad v dt, its exponential to the second term, F and J, then neo-Hookean stress, logarithm left out
//   gather     velocity and acceleration: 2 d components, 3 a row and one to join it; then v and x
// A division counts as one. A regather of the new momentum, d values, uses the weights of the pass that it is in.
//
// Numbers moved of a particle are those that a pass must read or write once: x and v for the momentum, x, F (twice) and
// the stress, which is written, for strain, x and v (twice each) for the motion. Numbers of the grid are counted a
// node: a field that is gathered into is cleared, read and written, so 3 a component; the pass over nodes for the
// velocity reads mass and momentum and writes velocity; the update reads mass, momentum and force and writes velocity
// and acceleration. A node has 8 particles in 3D, 4 in 2D: the block's edge and what two tiles share are left out.
#pragma once

#include <string>
#include <vector>

namespace roofline {

struct Work {
  std::string kernel;     ///< its name in the table of kernels (mpm/kernel/kernels.hpp)
  double multiply_adds;   ///< a particle
  double positions;       ///< numbers of a particle that are always double
  double particle_reals;  ///< numbers of a particle in the run's precision
  double grid_doubles;    ///< numbers of the grid, a particle

  /// [bytes], `real`: of a number in the run's precision.
  double bytes(double real) const { return 8.0 * (positions + grid_doubles) + real * particle_reals; }
};

/// Every kernel, of an elastic solid (`dim` 3) or a block in plane strain (2).
inline std::vector<Work> counted_kernels(int dim) {
  const double d = dim, rows = dim == 3 ? 9.0 : 3.0, nodes = 3.0 * rows, share = dim == 3 ? 1.0 / 8.0 : 1.0 / 4.0;
  const double weights = 14.0 * d, matrix = d * d, symmetric = dim == 3 ? 6.0 : 4.0;
  const double products = dim == 3 ? rows : 0.0;
  const double momentum = (d + 1.0) * (nodes + 3.0) + products, regather = d * (nodes + 3.0) + products;
  const double gradient = rows * d * (6.0 + d) + rows * d;
  // du; du du; I + du + du du / 2; F; J; b = F F^T and the stress from it.
  const double law = matrix + d * matrix + matrix + d * matrix + (dim == 3 ? 9.0 : 3.0) + d * symmetric + 12.0;
  const double gather = 2.0 * d * (nodes + rows) + products + 3.0 * d;
  return {
      {"scatter_momentum", weights + momentum, d, d, 3.0 * (d + 1.0) * share},
      {"nodal_velocity", (1.0 + d) * share, 0.0, 0.0, (2.0 * d + 1.0) * share},
      {"strain_and_force", weights + 2.0 * gradient + law, d, 2.0 * matrix + symmetric, 4.0 * d * share},
      {"strain", weights + gradient + law, d, 2.0 * matrix + symmetric, d * share},
      {"nodal_update", (1.0 + 3.0 * d) * share, 0.0, 0.0, (4.0 * d + 1.0) * share},
      {"move", weights + gather, 2.0 * d, 2.0 * d, 2.0 * d * share},
      {"move_and_regather", weights + gather + regather, 2.0 * d, 2.0 * d, 5.0 * d * share},
  };
}

/// Names of the kernels of one step, in order.
inline std::vector<std::string> kernels_of_step(bool usavg) {
  if (!usavg) return {"scatter_momentum", "nodal_velocity", "strain_and_force", "nodal_update", "move"};
  return {"scatter_momentum", "nodal_velocity", "strain_and_force", "nodal_update", "move_and_regather",
          "nodal_velocity",   "strain"};
}

/// The kernels of one step.
inline std::vector<Work> counted_step(int dim, bool usavg) {
  std::vector<Work> step;
  for (const std::string& name : kernels_of_step(usavg)) {
    for (const Work& work : counted_kernels(dim)) {
      if (work.kernel == name) step.push_back(work);
    }
  }
  return step;
}

}  // namespace roofline
