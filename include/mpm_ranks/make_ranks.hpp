// The ranks that this process was started as, for a program's main(): those of MPI in a build that has it (MPM_MPI),
// and none in one that has not. Which of the two is what CMake links; callers are the same.
//
//   const std::shared_ptr<mpm::Communicator> ranks = mpm::make_ranks();  // null: alone
//   try { … } catch (const std::exception& error) { if (ranks) return mpm::end_all(*ranks, error.what(), 2); … }
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "mpm/ranks/communicator.hpp"

namespace mpm {

/// Traffic that a rank has sent since it was made.
struct Traffic {
  std::uint64_t messages = 0;     ///< to single ranks
  std::uint64_t bytes = 0;        ///< in them
  std::uint64_t collectives = 0;  ///< exchanges of all with all: sums, largest values, gathers
  std::uint64_t shared = 0;       ///< bytes that this rank gave to those
};

/// Error that ends the ranks of a test, which are no processes.
class RanksEnded : public RanksError {
 public:
  RanksEnded(const std::string& reason, int code) : RanksError(reason), code_(code) {}
  int code() const { return code_; }

 private:
  int code_;
};

/// To be called once. Null when the process was started alone: by no launcher of MPI, or as the only rank.
/// @throws RanksError in a build without MPI that a launcher started as one of several ranks; or when MPI does not know
/// of as many ranks as the launcher does
std::shared_ptr<Communicator> make_ranks();

/// Processes that this one starts from now on are alone, whatever launcher has started this one.
void forget_launcher();

/// Refuses ranks for what runs in one process only, by its name. @throws RanksError where a launcher has started
/// several
void refuse_ranks(const std::string& what);

/// For a rank that cannot go on, while others may wait for it. `reason`: a line for stderr. Where all ranks come here
/// within a second, as they do when what they were given is at fault, the first one tells it and all return `code`;
/// else this one tells it, and the processes of all ranks end with `code`.
/// @throws RanksEnded if the ranks are not those of make_ranks() but a test's
int end_all(const Communicator& ranks, const std::string& reason, int code);

/// For a rank on which something has failed that all ranks do together, before it goes on to something else. Returns
/// where all ranks come here within a second: it has failed on all of them, alike. Else this rank tells the reason, a
/// line for stderr, and the processes of all ranks end with `code`. Ranks of a test are taken to fail alike.
void fail_alike(const Communicator& ranks, const std::string& reason, int code);

/// Number of threads a rank may take so that those of the same machine do not stand in each other's way.
int threads_of_rank(const Communicator& ranks);

/// Traffic of ranks that make_ranks() made.
Traffic sent(const Communicator& ranks);

}  // namespace mpm
