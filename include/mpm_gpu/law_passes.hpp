// The kernel of a law: strain and stress of one particle, by the solver's own update (kernel/stress.hpp). A table has a
// pass for each law of the closed list, so that the law is chosen once a set; between gradients and laws go arrays, so
// that shape functions and laws do not know each other, as in the solver. Weak: the gradient takes dim^2 numbers a
// particle to memory and back; a kernel of both is to be measured on a card. For code of one lane alone.
#pragma once

#include <cstddef>
#include <type_traits>
#include <variant>

#include "mpm/kernel/stress.hpp"
#include "mpm/material/law.hpp"
#include "mpm_gpu/particle_passes.hpp"
#include "mpm_gpu/passes.hpp"

namespace mpm_gpu {

template <class T, class Geometry, class LawType>
struct LawKernel {
  mpm_kernel::SetView<T> set;
  mpm_kernel::StrainSettings settings;
  const T* gradient[9];
  std::uint8_t* fault;
  std::uint32_t first;

  void operator()(long i) const {
    const int p = static_cast<int>(first + i);
    // Only its first column is touched, so that inlined it is dim^2 registers.
    mpm_kernel::ChunkGradients<T> gradients;
    for (int c = 0; c < Geometry::kDim * Geometry::kDim; ++c) gradients.l[c][0] = gradient[c][p];
    const int good = mpm::Stress<Geometry, T>::template update<LawType>(set, p, 1, gradients, settings, nullptr);
    fault[p] = good == 1 ? 0 : kInverted;
  }

  static void run(Executor& run, const StepView<T>& step, int number, const void* law) {
    const SetView& set = step.sets[number];
    LawKernel kernel{solver_view(step.particles, set, Geometry::kDim),
                     {step.settings.dt, step.settings.terms, false},
                     {},
                     step.particles.fault,
                     set.first};
    kernel.set.law = law;
    for (int c = 0; c < 9; ++c) kernel.gradient[c] = step.particles.gradient[c];
    run.for_each("gpu: strain and stress", set.count, kernel);
  }
};

template <class T, class Geometry, class List = mpm::Law>
struct LawPasses;
template <class T, class Geometry, class... Laws>
struct LawPasses<T, Geometry, std::variant<Laws...>> {
  template <class LawType>
  static constexpr LawPass<T> pass() {
    // A user's law is called through pointers into the host's program.
    if constexpr (std::is_same_v<LawType, mpm::UserLaw>)
      return nullptr;
    else
      return &LawKernel<T, Geometry, LawType>::run;
  }
  static constexpr LawPass<T> kPasses[] = {pass<Laws>()...};
};

}  // namespace mpm_gpu
