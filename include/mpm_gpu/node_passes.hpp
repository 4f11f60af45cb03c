// The kernels of nodes: mass and momentum before the strain, force and the update of momentum after it. Sums are in
// double, as the solver's grid is, of terms in the precision of the run. For code of one lane alone.
// Source: Nairn, GIMP notes (2.8), (1.26), (2.14).
#pragma once

#include "mpm/kernel/stress.hpp"
#include "mpm_gpu/stencil.hpp"
#include "mpm_gpu/walls.hpp"

namespace mpm_gpu {

/// `Affine`: with APIC's affine field, v + B D^-1 (x_i - x_p).
template <class T, class Geometry, template <class> class ShapeClass, bool Affine = false>
struct MomentumKernel {
  static constexpr int kDim = Geometry::kDim;
  StepView<T> step;

  void operator()(long node) const {
    using W = mpm::Wide<T>;
    int number[3];
    number_along<T, kDim>(step, node, number);
    double mass = 0.0, momentum[kDim] = {};
    each_particle_of<T, kDim, ShapeClass, Affine ? Beside::affine : Beside::gradient>(
        step, node, number, [&](const SetView& set, long p, const auto& stencil, const int* n) {
          const W of_particle = mass_of(step.particles, set, p), part = of_particle * stencil.value(n);
          mass += part.v;
          W sum[kDim];
          for (int c = 0; c < kDim; ++c) sum[c] = part * W::load(step.particles.v[c] + p);
          for (int k = 0; Affine && k < kDim; ++k) {
            const W arm = of_particle * stencil.beside(n, k);
            for (int c = 0; c < kDim; ++c) sum[c] += arm * W::load(step.particles.affine[c * kDim + k] + p);
          }
          for (int c = 0; c < kDim; ++c) momentum[c] += sum[c].v;
        });
    const NodeView& to = step.nodes;
    const bool carries = mass > step.grid.least_mass;
    double velocity[kDim];
    for (int c = 0; c < kDim; ++c) velocity[c] = carries ? momentum[c] / mass : 0.0;
    hold_for_strain<kDim>(step.grid, to, node, number, velocity);
    to.mass[node] = mass;
    for (int c = 0; c < kDim; ++c) {
      to.momentum[c * to.nodes + node] = momentum[c];
      to.velocity[c * to.nodes + node] = velocity[c];
    }
  }
};

/// `Driven`: with NodeView::load and damping of the nodes.
template <class T, class Geometry, template <class> class ShapeClass, bool Driven = false>
struct ForceKernel {
  static constexpr int kDim = Geometry::kDim;
  StepView<T> step;

  void operator()(long node) const {
    using W = mpm::Wide<T>;
    const NodeView& to = step.nodes;
    int number[3];
    number_along<T, kDim>(step, node, number);
    const double mass = to.mass[node], dt = step.settings.dt;
    double force[kDim] = {};
    if (mass > step.grid.least_mass && !step.settings.solved) {
      const auto add = [&](const SetView& set, long p, const auto& stencil, const int* n) {
        const auto stress = Geometry::load_symmetric(mpm::WideReader<T>{step.particles.tau, 1}, static_cast<int>(p));
        const W of_particle = mass_of(step.particles, set, p);
        W sum[kDim] = {};
        for (int k = 0; k < kDim; ++k) {
          W column[kDim];
          Geometry::column(stress, k, column);
          const W slope = -of_particle * stencil.beside(n, k);
          for (int c = 0; c < kDim; ++c) sum[c] += column[c] * slope;
        }
        for (int c = 0; c < kDim; ++c) force[c] += sum[c].v;
      };
      each_particle_of<T, kDim, ShapeClass>(step, node, number, add);
    }
    const bool carries = mass > step.grid.least_mass;
    for (int c = 0; Driven && c < kDim; ++c) {
      const long at = c * to.nodes + node;
      force[c] -= step.settings.node_damping * to.momentum[at];
      if (to.load != nullptr) force[c] += to.load[at];
    }
    double acceleration[kDim], free[kDim], velocity[kDim];
    for (int c = 0; c < kDim; ++c) {
      acceleration[c] = carries ? force[c] / mass + step.grid.gravity[c] : 0.0;
      free[c] = carries ? to.momentum[c * to.nodes + node] / mass + acceleration[c] * dt : 0.0;
      velocity[c] = free[c];
    }
    hold_at_end<kDim>(step.grid, to, node, number, mass, velocity);
    for (int c = 0; c < kDim; ++c) {
      const long at = c * to.nodes + node;
      const double change = velocity[c] - free[c];
      to.velocity[at] = velocity[c];
      to.acceleration[at] = acceleration[c] + change / dt;
    }
  }
};

/// The velocity of which increments are found: of the step's start (XPIC), in which a wall's nodes rest, or of its end
/// (FMPM). Source: method reference 6.6; Hammerquist & Nairn (2017), Nairn & Hammerquist (2021).
template <class T, int Dim, bool Mixed = false>
struct FirstIncrementKernel {
  StepView<T> step;

  void operator()(long node) const {
    const NodeView& to = step.nodes;
    int number[3];
    number_along<T, Dim>(step, node, number);
    const double mass = to.mass[node];
    const bool carries = mass > step.grid.least_mass;
    double first[Dim];
    for (int c = 0; c < Dim; ++c) {
      const long at = c * to.nodes + node;
      first[c] = !step.settings.from_start ? to.velocity[at] : carries ? to.momentum[at] / mass : 0.0;
    }
    hold_increment<Dim>(step.grid, to, node, number, 0.0, first);
    for (int c = 0; c < Dim; ++c) to.increment[c * to.nodes + node] = first[c];
    if (Mixed) to.work[node] = 0.0;
  }
};

/// The next increment, dv - S+ S dv: what particles have of the one before it, gathered, is taken from that. Walls hold
/// theirs. `Mixed`: particles take over a part of the first and of those after it, as they gain an acceleration; its
/// work is as mechanics/increments.hpp has it.
template <class T, int Dim, template <class> class ShapeClass, bool Mixed = false>
struct IncrementKernel {
  StepView<T> step;

  void operator()(long node) const {
    using W = mpm::Wide<T>;
    const NodeView& to = step.nodes;
    int number[3];
    number_along<T, Dim>(step, node, number);
    const double mass = to.mass[node];
    if (!(mass > step.grid.least_mass)) return;  // zero from the first
    double momentum[Dim] = {};
    each_particle_of<T, Dim, ShapeClass>(step, node, number,
                                         [&](const SetView& set, long p, const auto& stencil, const int* n) {
                                           const W part = mass_of(step.particles, set, p) * stencil.value(n);
                                           for (int c = 0; c < Dim; ++c)
                                             momentum[c] += (part * W::load(step.particles.gradient[c] + p)).v;
                                         });
    double next[Dim], work = 0.0;
    const double dt = step.settings.dt;
    for (int c = 0; c < Dim; ++c) {
      const long at = c * to.nodes + node;
      next[c] = to.increment[at] - momentum[c] / mass;
      if (Mixed) next[c] *= step.settings.part;
      if (Mixed) work += mass * next[c] * (to.velocity[at] - 0.5 * dt * to.acceleration[at]);
    }
    if (Mixed) to.work[node] += work;
    hold_increment<Dim>(step.grid, to, node, number, mass, next);
    for (int c = 0; c < Dim; ++c) {
      const long at = c * to.nodes + node;
      to.increment[at] = next[c];
      to.velocity[at] += next[c];
      if (Mixed) to.acceleration[at] += next[c] / dt;
    }
  }
};

}  // namespace mpm_gpu
