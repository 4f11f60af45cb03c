// End of a run over several ranks that fails on one of them alone.
#pragma once

#include "mpm/ranks/communicator.hpp"

namespace mpm {

/// The physics failed (exit code 3) on this rank, and the others do not know of it: unlike after a PhysicsError, which
/// all ranks throw, they can do nothing together any more, and nothing is written.
class RankFailure : public RanksError {
 public:
  using RanksError::RanksError;
};

}  // namespace mpm
