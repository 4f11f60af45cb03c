// Sums over the particles of a set, for reports: energies, momentum, the smallest J. Energies are the law's own, of
// each particle's state in double. For code of one lane alone.
#pragma once

#include "mpm/math/dimension.hpp"
#include "mpm_gpu/particle_passes.hpp"

namespace mpm_gpu {

/// Components of particles, read as double: from[c][p].
template <class T>
struct InDouble {
  struct Component {
    const T* values;
    double operator[](int p) const { return static_cast<double>(values[p]); }
  };
  const T* const* from;
  Component operator[](int c) const { return {from[c]}; }
};

template <class T, class Geometry, class LawType>
struct TotalsKernel {
  ParticleView<T> particles;
  const void* law;
  std::uint32_t first;

  Totals operator()(long i) const {
    constexpr int kDim = Geometry::kDim;
    const int p = static_cast<int>(first + i);
    const LawType& of = *static_cast<const LawType*>(law);
    const auto f = mpm::full(Geometry::load_matrix(InDouble<T>{particles.f}, p));
    const auto tau = mpm::full(Geometry::load_symmetric(InDouble<T>{particles.tau}, p));
    const double mass = particles.mass == nullptr ? 1.0 : static_cast<double>(particles.mass[p]);
    Totals one;
    double squared = 0.0;
    for (int k = 0; k < kDim; ++k) {
      const auto v = static_cast<double>(particles.v[k][p]);
      squared += v * v;
      one.momentum[k] = mass * v;
      one.place[k] = mass * particles.x[k][p];
    }
    one.kinetic = mass * (0.5 * squared);
    one.carried = mass * __builtin_sqrt(squared);
    one.least_j = determinant(f);
    one.elastic = mass * of.elastic_energy(f, tau, one.least_j);
    if constexpr (LawType::kPlasticWork >= 0) {
      one.plastic = mass * static_cast<double>(particles.history[LawType::kPlasticWork][p]);
      one.elastic -= of.heat_fraction() * one.plastic;
    }
    return one;
  }

  static Totals run(Executor& run, const Step<T>& step, int number, const void* law, Buffer<Totals>& room) {
    const SetView& set = step.sets[number];
    return run.reduce<Totals>("gpu: sums for reports", set.count, TotalsKernel{step.particles, law, set.first}, room);
  }
};

}  // namespace mpm_gpu
