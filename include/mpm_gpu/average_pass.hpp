// The kernel of mean stresses (mechanics/stress_average.hpp): an index is a cell, by the node at its lower corner. It
// visits the particles of its own that flow twice, for the sums and to give the means, so that nothing goes over memory
// between. A particle's cell is that where it is now; the solver on the processor takes the nearest cell of its block
// for one that has left that by more than half a cell. For code of one lane alone.
#pragma once

#include "mpm/kernel/flowing.hpp"
#include "mpm/kernel/stress.hpp"
#include "mpm_gpu/executor.hpp"
#include "mpm_gpu/particle_passes.hpp"
#include "mpm_gpu/stencil.hpp"

namespace mpm_gpu {

template <class T, class Geometry, class LawType>
struct AverageKernel {
  static constexpr int kDim = Geometry::kDim;
  using W = mpm::Wide<double>;
  using Stored = mpm::StoredStress<Geometry>;
  using Particles = mpm::FlowingParticles<Geometry, T, LawType>;

  StepView<T> step;
  mpm::FlowingArrays<T> arrays;
  const void* law;  ///< law of the set, where kernels are run
  int number;       ///< number of the set
  SetView set;
  bool adds;  ///< to the energy that other sets have lost in the cell

  /// visit(particle) for those of the cell above a node.
  template <class Visit>
  void each_of_cell(long node, Visit&& visit) const {
    int corner[3];
    number_along<T, kDim>(step, node, corner);
    const long block = node / nodes_of_block(kDim);
    const Local<kDim> local = local_of<kDim>(node);
    for (int beside = 0; beside < 1 << kDim; ++beside) {
      Local<kDim> there = local;
      for (int k = 0; k < kDim; ++k) there.at[k] += beside >> (kDim - 1 - k) & 1;
      const long at = number_of<kDim>(step.nodes, block, there);
      if (at < 0) continue;
      const long row = number * step.nodes.nodes + at;
      for (std::uint32_t p = step.nodes.begin[row]; p < step.nodes.end[row]; ++p) {
        bool within = true;
        for (int k = 0; k < kDim; ++k) {
          const double cells = in_cells(step.grid, k, step.particles.x[k][p]);
          within = within && around(step.grid, k, static_cast<int>(cells + 64.0) - 64) == corner[k];
        }
        if (within) visit(p);
      }
    }
  }

  void operator()(long node) const {
    mpm::FlowingArrays<T> with_pressure = arrays;
    if constexpr (!finds_pressure(LawType::kStressFrom)) {
      const W speed = static_cast<const LawType*>(law)->wave_speed(
          mpm::Matrix3<W>{W(1.0), W(0.0), W(0.0), W(0.0), W(1.0), W(0.0), W(0.0), W(0.0), W(1.0)},
          mpm::Symmetric3<W>{W(0.0), W(0.0), W(0.0), W(0.0), W(0.0), W(0.0)}, W(1.0));
      with_pressure.least_pressure = Particles::kPressure * speed.v * speed.v;
    }
    const Particles particles(with_pressure);
    double sum = 0.0, volume = 0.0, stress[Stored::kCount] = {};
    int flowing = 0;
    each_of_cell(node, [&](std::uint32_t p) {
      if (!particles.flows(p)) return;
      double own[Stored::kCount];
      particles.stress(p, own);
      const double mass = mass_of(step.particles, set, p).v;
      sum += mass;
      volume += mass * particles.volume_ratio(p);
      for (int i = 0; i < Stored::kCount; ++i) stress[i] += mass * own[i];
      ++flowing;
    });
    for (double& one : stress) one /= sum;
    const double mean_energy = flowing > 1 ? energy(stress, volume / sum) : 0.0;
    double lost = adds ? step.nodes.averaged[node] : 0.0;
    each_of_cell(node, [&](std::uint32_t p) {
      const bool flows = flowing > 1 && particles.flows(p);
      particles.remember(p);
      if (!flows) return;
      const double ratio = particles.volume_ratio(p), factor = volume / sum / ratio;
      double own[Stored::kCount];
      particles.stress(p, own);
      lost += mass_of(step.particles, set, p).v * (energy(own, ratio) - mean_energy);
      particles.set_stress(p, stress);
      const double root = kDim == 3 ? inverse_cbrt(W(factor)).v : 0.0;
      particles.stretch(p, kDim == 3 ? factor * root * root : sqrt(W(factor)).v);
    });
    step.nodes.averaged[node] = lost;
  }
  /// Elastic energy of a particle's stress [J/kg], for which no law that averages asks for F.
  double energy(const double* stress, double volume_ratio) const {
    constexpr decltype(Geometry::dilatation(1.0)) kNoMatter{};
    return static_cast<const LawType*>(law)->elastic_energy(kNoMatter, Stored::symmetric(stress), volume_ratio);
  }

  static void run(Executor& run, const Step<T>& step, int number, const void* law) {
    const SetView& set = step.sets[number];
    bool adds = false;
    for (int before = 0; before < number; ++before) adds = adds || step.sets[before].averages;
    AverageKernel kernel{step, {}, law, number, set, adds};
    for (int i = 0; i < 6; ++i) kernel.arrays.stress[i] = step.particles.tau[i];
    for (int i = 0; i < 9; ++i) kernel.arrays.gradient[i] = step.particles.f[i];
    kernel.arrays.strain = step.particles.history[LawType::kPlasticStrain];
    kernel.arrays.strain_before = step.particles.strain_before;
    run.for_each("gpu: mean stress of cells", step.nodes.nodes, kernel);
  }
};

}  // namespace mpm_gpu
