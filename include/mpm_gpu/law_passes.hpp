// The kernels of a law: strain and stress of one particle, by the solver's own update (kernel/stress.hpp), and the rate
// at which it crosses cells, which limits the time step, by the solver's own survey (kernel/survey.hpp). A table has a
// pass for each law of the closed list, so that the law is chosen once a set; between gradients and laws go arrays, so
// that shape functions and laws do not know each other, as in the solver. Weak: the gradient takes dim^2 numbers a
// particle to memory and back; a kernel of both is to be measured on a card. For code of one lane alone.
#pragma once

#include <cstddef>
#include <type_traits>
#include <variant>

#include "mpm/kernel/stress.hpp"
#include "mpm/kernel/survey.hpp"
#include "mpm/material/law.hpp"
#include "mpm_gpu/average_pass.hpp"
#include "mpm_gpu/liquid_passes.hpp"
#include "mpm_gpu/particle_passes.hpp"
#include "mpm_gpu/passes.hpp"
#include "mpm_gpu/totals_pass.hpp"

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
    struct {
      const T* l[Geometry::kDim * Geometry::kDim];
    } gradients;
    for (int c = 0; c < Geometry::kDim * Geometry::kDim; ++c) gradients.l[c] = gradient[c] + p;
    const int good = mpm::Stress<Geometry, T>::template update<LawType>(set, p, 1, gradients, settings, nullptr);
    if (good != 1) fault[p] |= kInverted;
  }

  static void run(Executor& run, const Step<T>& step, int number, const void* law) {
    const SetView& set = step.sets[number];
    LawKernel kernel{solver_view(step.particles, set, Geometry::kDim),
                     {step.settings.strain_dt, step.settings.terms, false},
                     {},
                     step.particles.fault,
                     set.first};
    kernel.set.law = law;
    for (int c = 0; c < 9; ++c) kernel.gradient[c] = step.particles.gradient[c];
    run.for_each("gpu: strain and stress", set.count, kernel);
  }
};

template <class T, class Geometry, class LawType>
struct RateKernel {
  mpm_kernel::SetView<T> set;
  double cell;
  double* rates;
  std::uint32_t first;

  void operator()(long i) const {
    const int p = static_cast<int>(first + i);
    rates[p] = mpm::Survey<Geometry, T>::template fastest<LawType>(set, p, p + 1, cell).rate;
  }

  static void run(Executor& run, const Step<T>& step, int number, const void* law, double cell, double* rates) {
    const SetView& set = step.sets[number];
    RateKernel kernel{solver_view(step.particles, set, Geometry::kDim), cell, rates, set.first};
    kernel.set.law = law;
    run.for_each("gpu: limit of the time step", set.count, kernel);
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
  template <class LawType>
  static constexpr RatePass<T> rates() {
    if constexpr (std::is_same_v<LawType, mpm::UserLaw>)
      return nullptr;
    else
      return &RateKernel<T, Geometry, LawType>::run;
  }
  template <class LawType>
  static constexpr TotalsPass<T> totals() {
    if constexpr (std::is_same_v<LawType, mpm::UserLaw>)
      return nullptr;
    else
      return &TotalsKernel<T, Geometry, LawType>::run;
  }
  template <class LawType>
  static constexpr AveragePass<T> averages() {
    if constexpr (LawType::kAveragesStress && !std::is_same_v<LawType, mpm::UserLaw>)
      return &AverageKernel<T, Geometry, LawType>::run;
    else
      return nullptr;
  }
  template <class LawType>
  static constexpr RelaxPass<T> relaxes() {
    if constexpr (LawType::kMatter == mpm::Matter::liquid)
      return &RelaxKernel<T, Geometry, LawType>::run;
    else
      return nullptr;
  }
  static constexpr RelaxPass<T> kRelaxes[] = {relaxes<Laws>()...};
  static constexpr AveragePass<T> kAverages[] = {averages<Laws>()...};
  static constexpr LawPass<T> kPasses[] = {pass<Laws>()...};
  static constexpr RatePass<T> kRates[] = {rates<Laws>()...};
  static constexpr TotalsPass<T> kTotals[] = {totals<Laws>()...};
};

}  // namespace mpm_gpu
