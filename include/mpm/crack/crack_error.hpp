// The error of this folder: a crack, a law of tractions or a rule of growth that cannot be.
#pragma once

#include "mpm/math/error.hpp"

namespace mpm {

/// Numbers of a crack that contradict each other or are out of their range. what() says which and what to do.
class CrackError : public Error {
 public:
  using Error::Error;
};

}  // namespace mpm
