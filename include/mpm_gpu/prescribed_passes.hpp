// The kernels of prescribed velocities at nodes (mpm/boundary/condition.hpp), which stand above walls that always hold:
// an index is a held node, so a scene without any has none of them.
#pragma once

#include "mpm_gpu/views.hpp"

namespace mpm_gpu {

template <class T, int Dim>
struct HoldKernel {
  StepView<T> step;
  HeldView held;
  HeldPart part;

  void operator()(long i) const {
    const NodeView& of = step.nodes;
    const long node = held.node[i];
    const double mass = of.mass[node];
    const bool gives = part == HeldPart::motion || part == HeldPart::increment;
    for (std::uint32_t e = held.first[i]; e < held.first[i + 1]; ++e) {
      if (part == HeldPart::motion) held.given[e] = 0.0;
      if (gives && !(mass > step.grid.least_mass)) continue;
      double* of_part = part == HeldPart::first_increment || part == HeldPart::increment ? of.increment : of.velocity;
      const double* direction = held.direction + static_cast<long>(e) * Dim;
      double change = wanted(e);
      for (int c = 0; c < Dim; ++c) change -= of_part[c * of.nodes + node] * direction[c];
      for (int c = 0; c < Dim; ++c) of_part[c * of.nodes + node] += change * direction[c];
      if (gives) move_on(node, e, change);
    }
  }

 private:
  double wanted(std::uint32_t e) const {
    if (part == HeldPart::increment) return 0.0;
    return part == HeldPart::strain_at_start ? held.start[e] : held.end[e];
  }
  /// Adds a change of the motion to the acceleration, one of an increment to the velocity, and its impulse.
  void move_on(long node, std::uint32_t e, double change) const {
    const NodeView& of = step.nodes;
    const bool increment = part == HeldPart::increment;
    for (int c = 0; c < Dim; ++c) {
      const long at = c * of.nodes + node;
      const double along = change * held.direction[static_cast<long>(e) * Dim + c];
      if (increment) of.velocity[at] += along;
      if (!increment || of.work != nullptr) of.acceleration[at] += along / step.settings.dt;
    }
    held.given[e] += of.mass[node] * change;
  }
};

/// Work of each entry's impulse, at the mean of its velocities [J].
struct HeldWorkKernel {
  HeldView held;
  double* work;
  void operator()(long e) const { work[e] = 0.5 * (held.start[e] + held.end[e]) * held.given[e]; }
};
/// Shares of conditions in what entries give: factor[i] of the impulse of entry[i].
struct HeldShareKernel {
  HeldView held;
  const std::uint32_t* entry;
  const double* factor;
  double* share;
  void operator()(long i) const { share[i] = factor[i] * held.given[entry[i]]; }
};

/// Keys of the blocks of the table, for the host.
struct KeyKernel {
  const std::uint64_t* key;
  std::uint64_t* to;
  void operator()(long block) const { to[block] = key[block]; }
};

}  // namespace mpm_gpu
