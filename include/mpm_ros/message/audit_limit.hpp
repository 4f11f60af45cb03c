// How well the momentum audit must close, for the checks of a bag and for /diagnostics.
#pragma once

#include "mpm/particles/particle_scalar.hpp"

namespace mpm_ros {

/// Largest residual of the audit over the momentum exchanged that is round-off. Double: the design's rule, of which
/// sums over millions of steps keep well clear. Single: momenta of particles are sums of floats, each rounded by 6e-8
/// of itself with either sign; short runs close to about 2e-8. Weak: nothing bounds the drift of a very long single
/// run.
constexpr double audit_limit(mpm::Precision precision) { return precision == mpm::Precision::float32 ? 1e-7 : 1e-10; }

}  // namespace mpm_ros
