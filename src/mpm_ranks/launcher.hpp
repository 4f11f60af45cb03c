// What launchers of MPI programs tell the processes that they start. Private to this folder.
#pragma once

namespace mpm {

/// How many ranks the launcher has started; 1 if none of those known has started this process.
int launched_ranks();

}  // namespace mpm
