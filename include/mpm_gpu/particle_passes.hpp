// The kernels of particles beside the law's: the velocity gradient before it, and the motion at the end of a step, by
// the solver's own advance of a particle (kernel/advance.hpp). For code of one lane alone.
#pragma once

#include "mpm/kernel/advance.hpp"
#include "mpm_gpu/stencil.hpp"

namespace mpm_gpu {

/// The particles of a set as the solver's headers see them, for what runs there.
template <class T>
mpm_kernel::SetView<T> solver_view(const ParticleView<T>& particles, const SetView& set, int dim) {
  mpm_kernel::SetView<T> view{};
  view.mass = set.mass;
  for (int k = 0; k < dim; ++k) {
    view.x[k] = particles.x[k];
    view.next_x[k] = particles.next_x[k];
    view.v[k] = particles.v[k];
  }
  for (int c = 0; c < 9; ++c) view.f[c] = particles.f[c];
  for (int c = 0; c < 6; ++c) view.tau[c] = particles.tau[c];
  for (int h = 0; h < kMostHistory; ++h) view.history[h] = particles.history[h];
  return view;
}

/// Notes the stretch that boxes of the shape function have in this step.
template <class T, int Dim>
struct DomainKernel {
  StepView<T> step;

  void operator()(long p) const {
    for (int k = 0; k < Dim; ++k) step.particles.domain[k][p] = step.particles.f[k * Dim + k][p];
  }
};

template <class T, int Dim, template <class> class ShapeClass>
struct GradientKernel {
  StepView<T> step;
  SetView set;

  void operator()(long i) const {
    using W = mpm::Wide<T>;
    const long p = set.first + i;
    const auto stencil = stencil_of<T, Dim, ShapeClass>(step, set, p);
    W l[Dim][Dim] = {};
    each_node_of<Dim, Stencil<T, Dim, ShapeClass>::kNodes>(step, p, [&](long node, const int* n) {
      W slope[Dim];
      for (int k = 0; k < Dim; ++k) slope[k] = stencil.beside(n, k);
      for (int c = 0; c < Dim; ++c) {
        const W v(step.nodes.velocity[c * step.nodes.nodes + node]);
        for (int k = 0; k < Dim; ++k) l[c][k] += v * slope[k];
      }
    });
    for (int c = 0; c < Dim; ++c) {
      for (int k = 0; k < Dim; ++k) l[c][k].store(step.particles.gradient[c * Dim + k] + p);
    }
  }
};

/// Increments at particles: kept where the gradient was, which nobody needs at this time.
template <class T, int Dim, template <class> class ShapeClass>
struct IncrementToParticlesKernel {
  StepView<T> step;
  SetView set;

  void operator()(long i) const {
    using W = mpm::Wide<T>;
    const long p = set.first + i;
    const auto stencil = stencil_of<T, Dim, ShapeClass>(step, set, p);
    W sum[Dim] = {};
    each_node_of<Dim, Stencil<T, Dim, ShapeClass>::kNodes>(step, p, [&](long node, const int* n) {
      const W value = stencil.value(n);
      for (int c = 0; c < Dim; ++c) sum[c] += value * W(step.nodes.increment[c * step.nodes.nodes + node]);
    });
    for (int c = 0; c < Dim; ++c) sum[c].store(step.particles.gradient[c] + p);
  }
};

/// `Kind`: the particle's velocity gains the grid's acceleration, or becomes the grid's, with its first moment B or
/// not.
template <class T, int Dim, template <class> class ShapeClass, mpm_kernel::Motion Kind>
struct MoveKernel {
  StepView<T> step;
  SetView set;

  void operator()(long i) const {
    using W = mpm::Wide<T>;
    const long p = set.first + i;
    constexpr bool kAffine = Kind == mpm_kernel::kAffine, kGains = Kind == mpm_kernel::kIncrement;
    constexpr Beside kWith = kAffine ? Beside::moment : Beside::gradient;
    const auto stencil = stencil_of<T, Dim, ShapeClass, kWith>(step, set, p);
    W velocity[Dim] = {}, acceleration[Dim] = {}, b[Dim][Dim] = {};
    each_node_of<Dim, Stencil<T, Dim, ShapeClass>::kNodes>(step, p, [&](long node, const int* n) {
      const W value = stencil.value(n);
      for (int c = 0; c < Dim; ++c) {
        const W v(step.nodes.velocity[c * step.nodes.nodes + node]);
        velocity[c] += value * v;
        if (kGains) acceleration[c] += value * W(step.nodes.acceleration[c * step.nodes.nodes + node]);
        for (int k = 0; kAffine && k < Dim; ++k) b[c][k] += v * stencil.beside(n, k);
      }
    });
    for (int c = 0; kAffine && c < Dim * Dim; ++c) b[c / Dim][c % Dim].store(step.particles.affine[c] + p);
    const mpm_kernel::SetView<T> view = solver_view(step.particles, set, Dim);
    mpm_kernel::MoveSettings settings{step.settings.dt, step.settings.flip, false};
    mpm::Advance<T, Dim, Kind, false, false> advance(view, settings);
    std::uint8_t fault = step.particles.fault[p];
    for (int c = 0; c < Dim; ++c) {
      const int before = nearest_node(in_cells(step.grid, c, step.particles.x[c][p]));
      advance.template particles<kGains, false>(c, static_cast<int>(p), 1, velocity[c], acceleration[c], W(0.0));
      const double cells = in_cells(step.grid, c, step.particles.next_x[c][p]);
      if (!(cells >= set.lowest[c] && cells <= set.highest[c])) {
        fault |= kOutside;
      } else if (nearest_node(cells) != before) {
        fault |= kLeftCell;
      }
    }
    step.particles.fault[p] = fault;
    if (!kGains || step.particles.slip == nullptr) return;
    mpm_kernel::Moved moved{};
    advance.add_to(moved);
    step.particles.slip[p] = moved.slip_energy;
  }
};

}  // namespace mpm_gpu
