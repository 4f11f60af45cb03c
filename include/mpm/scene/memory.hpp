// How much memory there is, so that a scene that cannot fit is refused and not stopped by the system halfway.
#pragma once

namespace mpm {

/// Of this machine, or of the container where that has a limit below it [bytes].
double usable_memory();

}  // namespace mpm
