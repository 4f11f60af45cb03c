// The kernels of loads (mpm/mechanics/particle_loads.hpp, face_tractions.hpp): accelerations at particles, the force
// that they and tractions are at nodes, and its work. For code of one lane alone.
#pragma once

#include "mpm/shape/dirac.hpp"
#include "mpm_gpu/stencil.hpp"

namespace mpm_gpu {

/// Acceleration of each particle, kept where the gradient was, which nobody needs at this time.
template <class T, int Dim>
struct LoadOfParticleKernel {
  StepView<T> step;
  LoadView load;

  void operator()(long p) const {
    const long id = step.particles.id[p];
    double sum[Dim];
    for (int c = 0; c < Dim; ++c) sum[c] = load.fixed == nullptr ? 0.0 : load.fixed[c * load.ids + id];
    for (long t = 0; t < load.count; ++t) {
      if ((load.acts[id] >> t & 1U) == 0) continue;
      for (int c = 0; c < Dim; ++c) sum[c] += load.value[t * Dim + c];
    }
    for (int c = 0; c < Dim; ++c) mpm::Wide<T>(sum[c]).store(step.particles.gradient[c] + p);
  }
};

/// Force of these at the nodes; `adds`: to what is there.
template <class T, int Dim, template <class> class ShapeClass>
struct LoadKernel {
  StepView<T> step;
  bool adds;

  void operator()(long node) const {
    using W = mpm::Wide<T>;
    const NodeView& to = step.nodes;
    int number[3];
    number_along<T, Dim>(step, node, number);
    double force[Dim] = {};
    each_particle_of<T, Dim, ShapeClass>(step, node, number,
                                         [&](const SetView& set, long p, const auto& stencil, const int* n) {
                                           const W part = W(set.mass) * stencil.value(n);
                                           for (int c = 0; c < Dim; ++c)
                                             force[c] += (part * W::load(step.particles.gradient[c] + p)).v;
                                         });
    for (int c = 0; c < Dim; ++c) {
      double& load = to.load[c * to.nodes + node];
      load = adds ? load + force[c] : force[c];
    }
  }
};

/// Force of tractions at the nodes, by the hat functions at the corners of a box's face (shape/traction.hpp), which
/// have equal parts of it.
template <class T, int Dim>
struct TractionKernel {
  StepView<T> step;
  TractionView traction;
  bool adds;

  void operator()(long node) const {
    const NodeView& to = step.nodes;
    int number[3];
    number_along<T, Dim>(step, node, number);
    double force[Dim] = {};
    each_particle_of<T, Dim, mpm::Dirac>(
        step, node, number, [&](const SetView& set, long p, const auto& /*stencil*/, const int* /*n*/) {
          const std::uint32_t acts = traction.acts[step.particles.id[p]];
          if (acts == 0) return;
          double lower[Dim], upper[Dim];
          for (int k = 0; k < Dim; ++k) {
            const double offset = in_cells(step.grid, k, step.particles.x[k][p]) - number[k];
            lower[k] = hat(offset - set.half[k]);
            upper[k] = hat(offset + set.half[k]);
          }
          for (long t = 0; t < traction.count; ++t) {
            if ((acts >> t & 1U) == 0) continue;
            const int axis = traction.face[t] / 2;
            double share = traction.face[t] % 2 == 1 ? upper[axis] : lower[axis];
            for (int k = 0; k < Dim; ++k) share *= k == axis ? 1.0 : 0.5 * (lower[k] + upper[k]);
            for (int c = 0; c < Dim; ++c) force[c] += share * traction.force[t * Dim + c];
          }
        });
    for (int c = 0; c < Dim; ++c) {
      double& load = to.load[c * to.nodes + node];
      load = adds ? load + force[c] : force[c];
    }
  }

 private:
  static double hat(double cells) {
    const double value = cells < 0.0 ? 1.0 + cells : 1.0 - cells;
    return value > 0.0 ? value : 0.0;
  }
};

/// Power of loads at each node, on the displacement of a particle in the step, v^{n+1} dt - a dt^2 / 2, over dt [W].
/// Source: GIMP notes (2.16).
template <class T, int Dim>
struct LoadPowerKernel {
  StepView<T> step;
  double* power;

  void operator()(long node) const {
    const NodeView& of = step.nodes;
    const double back = step.settings.solved ? 0.0 : 0.5 * step.settings.dt;
    double sum = 0.0;
    for (int c = 0; c < Dim; ++c) {
      const long at = c * of.nodes + node;
      sum += of.load[at] * (of.velocity[at] - back * of.acceleration[at]);
    }
    power[node] = sum;
  }
};

}  // namespace mpm_gpu
