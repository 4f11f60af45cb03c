// The least work of a step a particle, counted from the method: multiply-adds and bytes. What a kernel's share of the
// machine's limit is computed from; it does not depend on how a kernel is written.
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
// A division counts as one.
#pragma once

#include <string>
#include <vector>

namespace roofline {

struct Work {
  std::string kernel;
  double multiply_adds;   ///< a particle
  double particle_reals;  ///< numbers read and written a particle
};

/// Numbers of the grid that a particle's share of it is read and written as, at 8 particles a cell in 3D and 4 in 2D:
/// mass, momentum, velocity and acceleration of one node a cell, each about three times in a step.
inline double grid_reals(int dim) { return dim == 3 ? 6.25 : 10.0; }

/// The kernels of one step of an elastic block; `twice` adds the second passes of USAVG.
inline std::vector<Work> counted_work(int dim, bool usavg) {
  const double d = dim, rows = dim == 3 ? 9.0 : 3.0, nodes = 3.0 * rows;
  const double weights = 14.0 * d, matrix = d * d, symmetric = dim == 3 ? 6.0 : 4.0, stored = dim == 3 ? 9.0 : 5.0;
  const double products = dim == 3 ? rows : 0.0;
  const double momentum = weights + (d + 1.0) * (nodes + 3.0) + products;
  const double gradient = weights + rows * d * (6.0 + d) + rows * d;
  const double force = gradient - weights;
  // du; du du; I + du + du du / 2; F; J; b = F F^T and the stress from it.
  const double law = matrix + d * matrix + matrix + d * matrix + (dim == 3 ? 9.0 : 3.0) + d * symmetric + 12.0;
  const double gather = weights + 2.0 * d * (nodes + rows) + products + 3.0 * d;
  std::vector<Work> work = {
      {"momentum scatter", momentum, 2.0 * d},
      {"gradient, law and force", gradient + law + force, d + 2.0 * stored + symmetric},
      {"gather and move", gather, 4.0 * d},
  };
  if (usavg) {
    work.push_back({"second momentum scatter", momentum, 0.0});  // in the pass that gathers
    work.push_back({"second gradient and law", gradient + law, 3.0 * d + 2.0 * stored + 2.0 * symmetric});
  }
  return work;
}

}  // namespace roofline
