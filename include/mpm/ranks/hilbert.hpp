// A block's place along the Hilbert curve, which passes from each block of a cube to one beside it: a contiguous part
// of the curve is a compact part of space, with little surface. Source: Skilling (2004), Programming the Hilbert curve,
// AIP Conf. Proc. 707, 381-387: AxestoTranspose.
#pragma once

#include <array>
#include <cstdint>

namespace mpm {

/// `place`: along `dim` axes, each in [0, 2^bits); dim * bits <= 63. The result is in [0, 2^(dim * bits)).
std::uint64_t hilbert_index(std::array<std::uint32_t, 3> place, int dim, int bits);

}  // namespace mpm
