// Threads that wait must not hold the cores that a controller needs.
#pragma once

namespace mpm_ros {

/// Makes the threads of OpenMP sleep while they wait, unless OMP_WAIT_POLICY says otherwise. They would spin by
/// default: on cores that others use as well, a run on two threads was slower than on one. OpenMP reads the variable
/// once, when it is loaded, so the program starts itself again with it; call this first in main().
void wait_without_spinning(char** argv);

}  // namespace mpm_ros
