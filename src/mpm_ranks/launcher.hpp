// Facts that launchers of MPI programs tell the processes that they start. Private to this folder.
#pragma once

namespace mpm {

/// Number of ranks that the launcher has started; 1 if none of those known has started this process.
int launched_ranks();

}  // namespace mpm
