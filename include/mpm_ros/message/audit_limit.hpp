// Limit within which the momentum audit must close, for the checks of a bag and for /diagnostics.
#pragma once

#include "mpm/particles/particle_scalar.hpp"

namespace mpm_ros {

/// Largest residual of the audit over the momentum exchanged that is taken for round-off. Double: the design's rule.
/// Single: velocities of particles are floats, rounded by at most 6e-8 a step; over many particles that averages out.
/// Five shipped scenes close to 1e-8 to 3e-8; falling_block, where all particles move as one, to 7e-8.
/// Weak: what moves as one is rounded the same way, and that adds up over steps: falling_block in steps a fifth as long
/// is off by 2.5e-7, and fails in single precision though nothing else is wrong.
constexpr double audit_limit(mpm::Precision precision) { return precision == mpm::Precision::float32 ? 1e-7 : 1e-10; }

}  // namespace mpm_ros
