#include "mpm/sweep/draw.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "mpm/math/byte_hash.hpp"
#include "mpm/math/constants.hpp"

namespace mpm::sweep {
namespace {

constexpr std::uint64_t kMostAttempts = 10000;

/// The finaliser of SplitMix64.
std::uint64_t mixed(std::uint64_t z) {
  z += 0x9e3779b97f4a7c15ull;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  return z ^ (z >> 31);
}

}  // namespace

double random_part(std::uint64_t seed, const std::string& name, std::uint64_t index, std::uint64_t attempt) {
  ByteHash hash;
  hash.add(name.data(), name.size());
  const std::uint64_t bits = mixed(mixed(mixed(seed ^ hash.value()) + index) + attempt);
  return static_cast<double>(bits >> 11) * 0x1p-53;
}

double rounded(double value) {
  const std::string text = fmt::format("{:.12g}", value);
  double result = value;
  std::from_chars(text.data(), text.data() + text.size(), result);
  return result;
}

double draw(const Distribution& distribution, std::uint64_t seed, const std::string& name, std::uint64_t index) {
  const double from = distribution.from, to = distribution.to;
  if (distribution.kind == Distribution::Kind::uniform)
    return rounded(from + (to - from) * random_part(seed, name, index));
  if (distribution.kind == Distribution::Kind::log_uniform)
    return rounded(from * std::pow(to / from, random_part(seed, name, index)));
  for (std::uint64_t attempt = 0; attempt < kMostAttempts; ++attempt) {
    // 1 - part lies in (0, 1], where the logarithm is finite.
    const double radius = std::sqrt(-2.0 * std::log(1.0 - random_part(seed, name, index, 2 * attempt)));
    const double angle = 2.0 * kPi * random_part(seed, name, index, 2 * attempt + 1);
    const double value = rounded(distribution.mean + distribution.deviation * radius * std::cos(angle));
    if (value >= from && value <= to) return value;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace mpm::sweep
