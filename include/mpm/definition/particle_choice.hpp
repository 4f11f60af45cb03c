// Choice of the particles that are read, and of the fields that are read for them.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "mpm/math/geometry.hpp"

namespace mpm {

struct ParticleChoice {
  int stride = 1;             ///< every `stride`-th by id, >= 1
  std::optional<Box> region;  ///< only particles with centres in it, faces included [m]; in a plane y is ignored
};

/// Fields of the chosen particles, in order of id.
struct ParticleColumns {
  std::vector<std::uint32_t> ids;
  std::vector<std::vector<float>> values;  ///< values of each field, one a particle; SI
};

}  // namespace mpm
