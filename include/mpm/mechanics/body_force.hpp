// Body force: an acceleration b(t, x, X) of the material, as a function of time, of the place x where the material is
// and of the place X where it was at the start. A particle pass of its own beside the kernel: f_i += sum of m_p b_p
// S_ip.
//
// When and where b is read: at the middle of the step, t + dt/2, and at the place where a particle will be then,
// x + v dt/2 with the velocity of the step's start. With it v^{n+1} - v^n = b dt is the midpoint rule. USAVG's
// internal force is the stress after half of the step's strain, so it belongs to the middle as well: read at the
// step's start, b alone would make the step first order (its error is dt/2 (db/dt + v . grad b) a unit of time). USF's
// force stays first order, and the impulse of the load is the midpoint rule's all the same.
// Source: GIMP notes (1.27), (1.31); the midpoint is ours.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "mpm/kernel/kernels.hpp"
#include "mpm/material/law.hpp"
#include "mpm/math/function.hpp"
#include "mpm/particles/particle_set.hpp"
#include "mpm/step/stage.hpp"

namespace mpm {

/// One load: its acceleration by world axis [m/s^2] on one set of particles, or on all.
struct BodyForceTerm {
  std::optional<int> set;  ///< which, by index; all without one
  std::array<Function, 3> acceleration;
};

/// A load that has no value somewhere. what() names the load, the place and the time.
class LoadError : public Error {
 public:
  using Error::Error;
};

/// All body forces of a scene, as one stage that is the last of them: its work is taken with the velocity that all
/// others have left. Audit: "body_force", the sum over particles of m b dt; the grid has no part in it.
class BodyForce : public Stage {
 public:
  /// Work on the material since the start [J]: nodal load times the displacement of its node in the step.
  virtual double work() const = 0;
};

/// `sets` and `laws`, one each, outlive the result; sets that a term with X, Y or Z acts on have their start_x.
/// `kernels`: of the sets' precision; their shape function spreads the load.
template <class T>
std::unique_ptr<BodyForce> make_body_force(const mpm_kernel::KernelTable<T>& kernels, std::vector<ParticleSet>& sets,
                                           const std::vector<Law>& laws, const std::vector<BodyForceTerm>& terms,
                                           int threads);

}  // namespace mpm
