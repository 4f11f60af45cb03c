#include <fmt/format.h>

#include "launcher.hpp"
#include "mpm_ranks/make_ranks.hpp"

namespace mpm {

void refuse_ranks(const std::string& what) {
  if (const int ranks = launched_ranks(); ranks > 1) {
    throw RanksError(
        fmt::format("started as one of {} ranks, but {} runs in one process: start it without mpirun", ranks, what));
  }
}

}  // namespace mpm
