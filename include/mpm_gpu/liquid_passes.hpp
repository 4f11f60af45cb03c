// The kernels of the volume of liquids, by the solver's own formulas (kernel/volume_rule.hpp): the volume of each
// particle, the fullness of a node, what a particle sees of it, and J from that. For code of one lane alone.
#pragma once

#include "mpm/kernel/volume_rule.hpp"
#include "mpm_gpu/totals_pass.hpp"

namespace mpm_gpu {

/// Volume over mass of the particles of one set: `start`, or that times J.
template <class T, class Geometry>
struct VolumeKernel {
  ParticleView<T> particles;
  std::uint32_t first;
  double start;  ///< at the initial density [m^3/kg]
  bool stays;
  double* volume;

  void operator()(long i) const {
    const int p = static_cast<int>(first + i);
    volume[p] = stays ? start : start * determinant(Geometry::load_matrix(InDouble<T>{particles.f}, p));
  }
};

template <class T, int Dim, template <class> class ShapeClass>
struct FullnessKernel {
  StepView<T> step;
  const double* volume;
  double cell;  ///< volume of a cell [m^3]
  double* fullness;

  void operator()(long node) const {
    using W = mpm::Wide<T>;
    int number[3];
    number_along<T, Dim>(step, node, number);
    double sum = 0.0;
    each_particle_of<T, Dim, ShapeClass, Beside::gradient>(
        step, node, number, [&](const SetView& set, long p, const auto& stencil, const int* n) {
          sum += (mass_of(step.particles, set, p) * W(volume[p]) * stencil.value(n)).v;
        });
    double share = 1.0;
    for (int k = 0; k < Dim; ++k) {
      if (step.grid.period[k] != 0) continue;
      const int above = step.grid.last_node[k] - number[k];
      const bool upper = number[k] > above, folds = step.grid.faces[2 * k + (upper ? 1 : 0)] != Face::open;
      share *= mpm::VolumeRule::share(upper ? above : number[k], folds, ShapeClass<W>::kBeyondNext);
    }
    fullness[node] = mpm::VolumeRule::fullness(sum, share, cell);
  }
};

/// The fullness at a particle, the part of its weights on full nodes, and |grad v|^2 of the velocity that has been
/// gathered, before anything holds it: in the place of gradients.
template <class T, int Dim, template <class> class ShapeClass>
struct FullnessToParticlesKernel {
  StepView<T> step;
  SetView set;
  const double* fullness;

  void operator()(long i) const {
    using W = mpm::Wide<T>;
    const long p = set.first + i, nodes = step.nodes.nodes;
    const auto stencil = stencil_of<T, Dim, ShapeClass>(step, set, p);
    W seen(0.0), full(0.0), l[Dim][Dim] = {};
    each_node_of<Dim, Stencil<T, Dim, ShapeClass>::kNodes>(step, p, [&](long node, const int* n) {
      const W value = stencil.value(n);
      seen += value * W(fullness[node]);
      full += value * W(mpm::VolumeRule::full(fullness[node]));
      const double mass = step.nodes.mass[node];
      if (!(mass > step.grid.least_mass)) return;
      W slope[Dim];
      for (int k = 0; k < Dim; ++k) slope[k] = stencil.beside(n, k);
      for (int c = 0; c < Dim; ++c) {
        const W v(step.nodes.momentum[c * nodes + node] / mass);
        for (int k = 0; k < Dim; ++k) l[c][k] += v * slope[k];
      }
    });
    double squares = 0.0;
    for (int c = 0; c < Dim; ++c) {
      for (int k = 0; k < Dim; ++k) squares += static_cast<double>(l[c][k].v) * static_cast<double>(l[c][k].v);
    }
    seen.store(step.particles.gradient[0] + p);
    full.store(step.particles.gradient[1] + p);
    W(squares).store(step.particles.gradient[2] + p);
  }
};

/// J of a liquid's particles from that.
template <class T, class Geometry, class LawType>
struct RelaxKernel {
  StepView<T> step;
  SetView set;
  LawType law;
  double waited;  ///< time for which it acts [s]
  double* lost;   ///< elastic energy that each has lost [J]

  void operator()(long i) const {
    const int p = static_cast<int>(set.first + i);
    const auto f = Geometry::load_matrix(InDouble<T>{step.particles.f}, p);
    const double before = determinant(f);
    double j = before;
    const auto number = [&](int n) { return static_cast<double>(step.particles.gradient[n][p]); };
    lost[p] = 0.0;
    if (!mpm::VolumeRule::relax(number(0), number(1), number(2), waited, j)) return;
    const auto now = Geometry::dilatation(j);
    double components[Geometry::kMatrix];
    double* places[Geometry::kMatrix];
    for (int c = 0; c < Geometry::kMatrix; ++c) places[c] = &components[c];
    Geometry::store_matrix(now, places, 0);
    for (int c = 0; c < Geometry::kMatrix; ++c) step.particles.f[c][p] = static_cast<T>(components[c]);
    const auto tau = Geometry::load_symmetric(InDouble<T>{step.particles.tau}, p);
    const auto mass = static_cast<double>(mass_of(step.particles, set, p).v);
    lost[p] = mass * (law.elastic_energy(f, tau, before) - law.elastic_energy(now, tau, j));
  }

  static void run(Executor& run, const Step<T>& step, int number, const void* law, double waited, double* lost) {
    const SetView& set = step.sets[number];
    run.for_each("gpu: volume of liquids", set.count,
                 RelaxKernel{step, set, *static_cast<const LawType*>(law), waited, lost});
  }
};

}  // namespace mpm_gpu
