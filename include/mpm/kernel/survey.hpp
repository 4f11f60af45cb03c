// Rate of particles of one body that limits the time step: how many times a second a particle's waves and motion cross
// a cell, with what its viscosity adds, a register of particles at a time. The law is chosen as in stress.hpp.
// Source: method reference 11; Hirsch, Numerical Computation of Internal and External Flows, 7.3 (viscous rate).
#pragma once

#include <limits>

#include "mpm/kernel/stress.hpp"

namespace mpm {

template <class Geometry, class T>
class Survey {
  using W = Wide<T>;
  using Fastest = mpm_kernel::Fastest;
  static constexpr int kDim = Geometry::kDim;

 public:
  template <class LawType>
  MPM_FLATTEN static Fastest fastest(const mpm_kernel::SetView<T>& set_view, int first, int last, double cell) {
    const mpm_kernel::SetView<T> set = set_view;
    const LawType law = *static_cast<const LawType*>(set.law);
    const W per_cell(1.0 / cell), viscous(2.0 * kDim / (cell * cell));
    const W endless(std::numeric_limits<T>::infinity());
    alignas(64) T number[W::kLanes], order[W::kLanes], rate[W::kLanes];
    for (int l = 0; l < W::kLanes; ++l) number[l] = static_cast<T>(l);
    W place = W::load(number), found(0.0), most(-1.0), most_rate(-1.0);
    for (int p = first; p < last; p += W::kLanes) {
      const int lanes = last - p;
      const auto f = Geometry::load_matrix(WideReader<T>{set.f, lanes}, p);
      const auto tau = Geometry::load_symmetric(WideReader<T>{set.tau, lanes}, p);
      const W j = determinant(f);
      W speed2(0.0);
      for (int k = 0; k < kDim; ++k) {
        const W v = W::load_first(set.v[k] + p, lanes);
        speed2 += v * v;
      }
      const W rates = (law.wave_speed(f, tau, j) + sqrt(speed2)) * per_cell + law.diffusivity(j) * viscous;
      // Puts what is not a number before all numbers.
      const W ranks = select(WideMask<T>::first(lanes), select(rates <= endless, rates, endless), W(-1.0));
      const auto faster = ranks > most;
      most = select(faster, ranks, most);
      most_rate = select(faster, rates, most_rate);
      found = select(faster, place, found);
      place += W(W::kLanes);
    }
    most.store(order);
    most_rate.store(rate);
    found.store(number);
    int best = 0;
    for (int l = 1; l < W::kLanes; ++l) {
      if (order[l] > order[best] || (order[l] == order[best] && number[l] < number[best])) best = l;
    }
    return {static_cast<double>(rate[best]), first + static_cast<int>(number[best])};
  }
};

}  // namespace mpm
