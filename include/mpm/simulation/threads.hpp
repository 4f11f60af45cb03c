// How many threads a run takes when it is not told. The result does not depend on them.
#pragma once

#include <cstdint>

namespace mpm {

/// Threads that can run at once: processors that the program may use (its affinity, OMP_NUM_THREADS), and no more than
/// the processor time that its control group is given, as a container's.
int machine_threads();
/// The most that are of use for so many particles: at least 4,000 each, for fewer do not pay for the waiting at the end
/// of every pass.
int useful_threads(std::uint64_t particles);

}  // namespace mpm
