// Faults of the particles in a step, summed over them: whether any has left its cell, and the first that has failed.
#pragma once

#include <cstdint>

#include "mpm_gpu/views.hpp"

namespace mpm_gpu {

struct Faults {
  static constexpr std::uint32_t kNone = 0xffffffffU;
  bool left = false;
  std::uint32_t outside = kNone, inverted = kNone;  ///< numbers of particles

  /// Those of one particle, of bits of ParticleView::fault.
  static constexpr Faults of(std::uint8_t bits, long particle) {
    Faults one;
    one.left = (bits & kLeftCell) != 0;
    if ((bits & kOutside) != 0) one.outside = static_cast<std::uint32_t>(particle);
    if ((bits & kInverted) != 0) one.inverted = static_cast<std::uint32_t>(particle);
    return one;
  }
  constexpr Faults& operator+=(const Faults& other) {
    left = left || other.left;
    outside = outside < other.outside ? outside : other.outside;
    inverted = inverted < other.inverted ? inverted : other.inverted;
    return *this;
  }
};

}  // namespace mpm_gpu
