// The kernel of particles that have left the grid: puts them back as mpm/boundary/leaving.cpp does. For code of one
// lane alone.
#pragma once

#include "mpm_gpu/stencil.hpp"

namespace mpm_gpu {

template <class T, int Dim>
struct PutBackKernel {
  static constexpr double kInside = 1e-3;  ///< part of a cell by which a particle is put inside the edge

  StepView<T> step;
  SetView set;
  double* numbers;  ///< [number][particle]: kinetic energy that is taken [J], then momentum that is given [N s]

  void operator()(long i) const {
    const long p = set.first + i, count = step.particles.count;
    const auto mass = static_cast<double>(mass_of(step.particles, set, p).v);
    for (int c = 0; c <= Dim; ++c) numbers[c * count + p] = 0.0;
    for (int k = 0; k < Dim; ++k) {
      const double cells = in_cells(step.grid, k, step.particles.x[k][p]);
      if (cells >= set.lowest[k] && cells <= set.highest[k]) continue;
      const double v = static_cast<double>(step.particles.v[k][p]);
      if (!(cells - cells == 0.0 && v - v == 0.0)) {
        step.particles.fault[p] = kOutside;  // it stays so
        return;
      }
      const double side = cells < set.lowest[k] ? -1.0 : 1.0;
      const double inside = side < 0.0 ? set.lowest[k] + kInside : set.highest[k] - kInside;
      step.particles.x[k][p] = step.grid.origin[k] + inside / step.grid.inverse_cell[k];
      step.particles.fault[p] = kReturned;
      const double outward = side * v;
      if (!(outward > 0.0)) continue;
      step.particles.v[k][p] = T(0);
      numbers[p] += 0.5 * mass * outward * outward;
      numbers[(1 + k) * count + p] = -side * outward * mass;
    }
  }
};

/// Faults and ids, for the host.
struct FaultKernel {
  const std::uint8_t* fault;
  const std::uint32_t* id;
  std::uint8_t* fault_to;
  std::uint32_t* id_to;
  void operator()(long p) const {
    fault_to[p] = fault[p];
    id_to[p] = id[p];
  }
};

}  // namespace mpm_gpu
