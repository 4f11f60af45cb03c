// Number of threads that a run takes if it is not told. The result does not depend on them.
#pragma once

#include <bitset>
#include <cstdint>
#include <vector>

namespace mpm {

/// Threads that can run at once: processors that the program may use (its affinity, OMP_NUM_THREADS), and no more than
/// the processor time that its control group is given, as a container's.
int machine_threads();
/// The most that are of use for so many particles: at least 4,000 each, for fewer do not pay for the waiting at the end
/// of every pass.
int useful_threads(std::uint64_t particles);

/// Processors of a machine, by number.
using ProcessorSet = std::bitset<1024>;
/// Those that this process may run on.
ProcessorSet own_processors();
/// Threads for one of several processes of a machine: all processors that it alone may use, a share of those that
/// others may use, too, and of the time that their control group is given. `all`: processors of each process.
int threads_beside(const std::vector<ProcessorSet>& all, std::size_t own);

}  // namespace mpm
