// Values drawn at random for a sweep, the same on every machine: a draw is a hash of seed, name and index in place of
// the next state of a generator, so that one more parameter or one more draw leaves the others as they are.
//
// The hash is three rounds of the finaliser of SplitMix64, its upper 53 bits the place in [0, 1). Normal draws are by
// Box and Muller. Values are rounded to twelve digits, below which machines' logarithms may differ.
// Weak: draws are independent, where a low-discrepancy sequence would fill a space of few dimensions sooner.
// Sources: Steele, Lea, Flood (2014), Fast splittable pseudorandom number generators; Box, Muller (1958), A note on the
// generation of random normal deviates.
#pragma once

#include <cstdint>
#include <limits>
#include <string>

namespace mpm::sweep {

struct Distribution {
  enum class Kind { uniform, log_uniform, normal } kind = Kind::uniform;
  /// Bounds of a draw. A normal draw beyond them is drawn again.
  double from = -std::numeric_limits<double>::infinity(), to = std::numeric_limits<double>::infinity();
  double mean = 0.0, deviation = 1.0;  ///< mean and deviation of a normal distribution
};

/// A number in [0, 1). `attempt` counts numbers of one draw.
double random_part(std::uint64_t seed, const std::string& name, std::uint64_t index, std::uint64_t attempt = 0);

/// The draw `index` of the parameter `name`. NaN where ten thousand normal draws have missed the bounds.
double draw(const Distribution& distribution, std::uint64_t seed, const std::string& name, std::uint64_t index);

/// The number of twelve digits that is nearest to `value`.
double rounded(double value);

}  // namespace mpm::sweep
