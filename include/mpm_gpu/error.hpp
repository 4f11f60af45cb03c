// Errors of this library.
#pragma once

#include "mpm/math/error.hpp"

namespace mpm_gpu {

/// Refusal or failure of this library or of a card, in one line with a remedy.
class GpuError : public mpm::Error {
 public:
  using mpm::Error::Error;
};

}  // namespace mpm_gpu
