// Promises that must hold on any number of ranks, whoever they are: threads in a unit test, processes of MPI in
// test/mpi. Each check is called on all ranks at once.
#pragma once

#include <ostream>
#include <vector>

#include "mpm/ranks/communicator.hpp"

namespace mpm {

struct RanksPromise {
  const char* name;
  void (*check)(Communicator&);
};

/// For the names of tests.
inline std::ostream& operator<<(std::ostream& out, const RanksPromise& promise) { return out << promise.name; }

/// Promises of the interface itself.
std::vector<RanksPromise> communicator_promises();
/// Promises of the grid's division, and of particles that are handed over.
std::vector<RanksPromise> hand_over_promises();
/// Promises of nodes that several ranks give to.
std::vector<RanksPromise> halo_promises();
/// Promises of a checkpoint that they write together.
std::vector<RanksPromise> checkpoint_promises();

inline std::vector<RanksPromise> ranks_promises() {
  std::vector<RanksPromise> all = communicator_promises();
  for (const auto& more : {hand_over_promises(), halo_promises(), checkpoint_promises()}) {
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

}  // namespace mpm
