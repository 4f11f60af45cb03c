// Puts the particles of a set into another order, one array after another.
#pragma once

#include <cstdint>

#include "mpm/particles/particle_order.hpp"
#include "mpm/particles/particle_set.hpp"

namespace mpm {

/// One array of each type, kept: an array that is written anew takes it, and leaves its own for the next.
struct PermuteScratch {
  PaddedArray<double> doubles;
  PaddedArray<float> floats;
  PaddedArray<std::uint32_t> ids;
  PaddedArray<std::uint8_t> sides;
  PaddedArray<double>& of(const PaddedArray<double>&) { return doubles; }
  PaddedArray<float>& of(const PaddedArray<float>&) { return floats; }
  PaddedArray<std::uint32_t>& of(const PaddedArray<std::uint32_t>&) { return ids; }
  PaddedArray<std::uint8_t>& of(const PaddedArray<std::uint8_t>&) { return sides; }
};

/// The room that an array of so many particles gets where they come and go: more by a sixteenth to a quarter, in steps,
/// so that few are made anew before the grid is divided anew: arrays of many different lengths leave holes in the heap
/// that none of them fits into. Room beyond the particles takes no memory before it is written.
std::size_t room_for_particles(std::size_t particles);

/// The first particles become those at `places`, order.count() of them, each of which is in the order; what is at other
/// places is dropped. Particles asleep follow them. They keep their places, but for as many as others came or went:
/// where more are awake than before the first ones asleep go to the end, in order, where fewer the last ones come to
/// the beginning.
/// Arrays that are made anew get room for `room` particles.
void permute(ParticleSet& set, const std::uint32_t* places, const ParticleOrder& order, std::size_t room,
             PermuteScratch& scratch, int threads);

}  // namespace mpm
