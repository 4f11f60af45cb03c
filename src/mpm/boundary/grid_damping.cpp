#include "mpm/boundary/grid_damping.hpp"

namespace mpm {

void GridDamping::forces_gathered(StepContext& context) {
  Grid& grid = context.grid;
  const int nodes = grid.layout.nodes_per_block();
  Vec3 given = Vec3::Zero();
  for (int b = 0; b < grid.blocks.size(); ++b) {
    for (int k = 0; k < grid.layout.dim(); ++k) {
      const double* momentum = grid.momentum.block(b) + k * nodes;
      double* force = grid.force.block(b) + k * nodes;
      double total = 0.0;
      for (int n = 0; n < nodes; ++n) {
        const double f = -rate_ * momentum[n];
        force[n] += f;
        total += f;
      }
      given[grid.layout.axis(k)] += total * context.dt;
    }
  }
  account_.add(given);
}

}  // namespace mpm
