// Turns four registers, a component of particles each, into four numbers a particle: what is computed with particles
// in the lanes is scattered a particle at a time.
#pragma once

#include "mpm/kernel/wide.hpp"

namespace mpm {

/// Lane l: lane l of a and of b in turn; of their lower or upper halves.
template <int N, bool Upper>
struct Alternate {
  static constexpr int at(int l) { return (l % 2) * N + l / 2 + (Upper ? N / 2 : 0); }
};
/// The same by pairs of lanes.
template <int N, bool Upper>
struct AlternatePairs {
  static constexpr int at(int l) { return (l / 2 % 2) * N + l / 4 * 2 + l % 2 + (Upper ? N / 2 : 0); }
};

/// to[4 l + k] = lane l of a_k.
template <class T>
void interleave(T* to, Wide<T> a0, Wide<T> a1, Wide<T> a2, Wide<T> a3) {
  constexpr int N = Wide<T>::kLanes;
  if constexpr (N == 1) {
    a0.store(to);
    a1.store(to + 1);
    a2.store(to + 2);
    a3.store(to + 3);
  } else {
    const Wide<T> low01 = shuffle<Alternate<N, false>>(a0, a1), high01 = shuffle<Alternate<N, true>>(a0, a1);
    const Wide<T> low23 = shuffle<Alternate<N, false>>(a2, a3), high23 = shuffle<Alternate<N, true>>(a2, a3);
    if constexpr (N == 2) {
      low01.store(to);
      low23.store(to + N);
      high01.store(to + 2 * N);
      high23.store(to + 3 * N);
    } else {
      shuffle<AlternatePairs<N, false>>(low01, low23).store(to);
      shuffle<AlternatePairs<N, true>>(low01, low23).store(to + N);
      shuffle<AlternatePairs<N, false>>(high01, high23).store(to + 2 * N);
      shuffle<AlternatePairs<N, true>>(high01, high23).store(to + 3 * N);
    }
  }
}

}  // namespace mpm
