#include "mpm/ranks/hilbert.hpp"

#include <utility>

namespace mpm {

std::uint64_t hilbert_index(std::array<std::uint32_t, 3> x, int dim, int bits) {
  if (dim == 1) return x[0];
  const std::uint32_t top = std::uint32_t{1} << (bits - 1);
  for (std::uint32_t q = top; q > 1; q >>= 1) {
    const std::uint32_t below = q - 1;
    for (int i = 0; i < dim; ++i) {
      if ((x[i] & q) != 0) {
        x[0] ^= below;
      } else {
        const std::uint32_t swapped = (x[0] ^ x[i]) & below;
        x[0] ^= swapped;
        x[i] ^= swapped;
      }
    }
  }
  for (int i = 1; i < dim; ++i) x[i] ^= x[i - 1];
  std::uint32_t flips = 0;
  for (std::uint32_t q = top; q > 1; q >>= 1) {
    if ((x[dim - 1] & q) != 0) flips ^= q - 1;
  }
  std::uint64_t index = 0;
  for (int bit = bits - 1; bit >= 0; --bit) {
    for (int i = 0; i < dim; ++i) index = 2 * index + ((x[i] ^ flips) >> bit & 1U);
  }
  return index;
}

}  // namespace mpm
