// Threads that wait must not hold the cores that a controller needs.
#pragma once

namespace mpm_ros {

/// Makes the threads of OpenMP sleep when they have waited for some microseconds, unless OMP_WAIT_POLICY says
/// otherwise. They would spin for long by default: on cores that others use as well, a run on two threads was slower
/// than on one. OpenMP reads the variables once, when it is loaded, so the program starts itself again with them; call
/// this first in main().
void spin_only_briefly(char** argv);

}  // namespace mpm_ros
