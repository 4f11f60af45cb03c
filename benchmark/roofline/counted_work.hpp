// The least work of a step for each particle, counted from the method: multiply-adds, and bytes to and from memory. A
// kernel's share of the machine's limits is computed from these counts. They do not depend on how a kernel is written.
//
// Counted for uGIMP (3 nodes an axis, d axes, 3^(d-1) rows of 3 nodes along the last axis), sums factored by axis:
//   weights    14 an axis for S and G of its three nodes; every pass computes its own (storing them costs more)
//   momentum   d + 1 values (mass and momentum) times 3 weights of the last axis, then one a node; 3^(d-1) products of
//              the other weights in 3D
//   gradient   6 for the sums of a row with S and with G, then d to add them to the d gradients, for each of d
//              components; 3 products of weights a row (2 in 2D)
//   force      as many as the gradient, in the other direction
//   law        grad v dt, its exponential to the second term, F and J, then neo-Hookean stress without its logarithm
//   gather     velocity and acceleration: 2 d components, 3 a row and one to add it to the sum; then v and x
// A division counts as one. A regather of the new momentum, d values, uses the weights of the pass that it is in.
//
// The numbers of a particle are those that a pass must read or write once: x and v for the momentum; x, F (twice) and
// the stress, which is only written, for strain; x and v (twice each) for the motion. Numbers of the grid are counted
// for each node: a field that particles spread to is cleared, read and written, which makes 3 a component; the pass
// over nodes for the velocity reads mass and momentum and writes velocity; the update reads mass, momentum and force
// and writes velocity and acceleration. There are 8 particles for each node in 3D and 4 in 2D: the block's edge and the
// nodes that two tiles share are left out.
#pragma once

#include <string>
#include <vector>

namespace roofline {

struct Work {
  std::string kernel;     ///< its name in the table of kernels (mpm/kernel/kernels.hpp)
  double multiply_adds;   ///< for each particle
  double positions;       ///< numbers of a particle that are always double
  double particle_reals;  ///< numbers of a particle in the run's precision
  double grid_doubles;    ///< numbers of the grid for each particle

  /// Bytes moved for each particle; `real`: size of a number in the run's precision [bytes].
  double bytes(double real) const { return 8.0 * (positions + grid_doubles) + real * particle_reals; }
};

/// The work of every kernel for an elastic solid (`dim` 3) or an elastic block in plane strain (2).
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

/// Names of the kernels of one step, in the order of the step.
inline std::vector<std::string> kernels_of_step(bool usavg) {
  if (!usavg) return {"scatter_momentum", "nodal_velocity", "strain_and_force", "nodal_update", "move"};
  return {"scatter_momentum", "nodal_velocity", "strain_and_force", "nodal_update", "move_and_regather",
          "nodal_velocity",   "strain"};
}

/// The work of each kernel of one step.
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
