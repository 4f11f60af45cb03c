// What a Simulation says of itself at a sync point: plain values, SI, no reference into the solver.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mpm/contact/contact_report.hpp"
#include "mpm/contact/pair_report.hpp"
#include "mpm/math/geometry.hpp"
#include "mpm/rigid/rigid_body.hpp"

namespace mpm {

struct BodyState {
  std::string name;
  Pose pose;
  Twist twist;
  Drive drive = Drive::functions;
  double mass = 0.0;  ///< [kg] of a body that is free; 0: it only moves as it is told
};

/// Energies [J].
struct EnergyReport {
  double kinetic = 0.0;
  double elastic = 0.0;        ///< stored in the material
  double plastic = 0.0;        ///< dissipated by plastic flow since the start
  double potential = 0.0;      ///< -sum m g.x
  double contact_work = 0.0;   ///< done by rigid bodies on the material since the start
  double load_work = 0.0;      ///< done by loads, velocity conditions and absorbing faces since the start
  double pair_friction = 0.0;  ///< taken by sliding between deformable bodies since the start
  double interface = 0.0;      ///< stored in imperfect interfaces, as the last step began
  double friction = 0.0;       ///< taken by sliding on rigid bodies since the start
  // Of free rigid bodies; contact_work is then what they lost to the material.
  double free_kinetic = 0.0;
  double free_potential = 0.0;
  double free_work = 0.0;  ///< done on them by applied wrenches and by what drives their told velocities
  double free_loss = 0.0;  ///< lost where they and the material met, sliding left out
  /// Of the material.
  double total() const { return kinetic + elastic + potential + interface; }
  /// With free bodies.
  double whole() const { return total() + free_kinetic + free_potential; }
};

/// One external impulse on the material since the start [N s].
struct NamedImpulse {
  std::string name;  ///< "gravity", "contact/blade", "wall/z_min", "damping", "body_force", "condition/lid",
                     ///< "absorbing/x_min", …
  Vec3 impulse = Vec3::Zero();
};

/// Momentum balance: change = sum of the impulses + residual. Each term is found independently of the others.
struct AuditReport {
  Vec3 momentum = Vec3::Zero();  ///< of the particles now [N s]
  Vec3 initial_momentum = Vec3::Zero();
  std::vector<NamedImpulse> impulses;
  double exchanged = 0.0;  ///< momentum exchanged: sum over steps and sources of |impulse| [N s]
  double carried = 0.0;    ///< sum of m |v| of the particles now [N s]
  double residual = 0.0;   ///< |change - sum of impulses| / max(exchanged, carried)
};

/// What limited the time step, and the steps taken.
struct StepReport {
  std::uint64_t steps = 0;  ///< since the start
  double dt_min = 0.0;      ///< [s] over the run so far
  double dt_max = 0.0;
  double dt_last = 0.0;
  std::string limited_by;  ///< what and where: "wave speed of 'soil' (61 m/s …) at (0.1, 0, 0.3) m", "time.step"
};

struct SolverState {
  std::int64_t time = 0;  ///< [ns]
  StepReport step;
  EnergyReport energy;
  AuditReport audit;
  std::uint64_t particles = 0;
  std::uint64_t returned = 0;  ///< particles that have left the grid and were put back (grid.leave)
  double min_j = 1.0;          ///< smallest det F of any particle now
  double wall_seconds = 0.0;   ///< spent in stepping
};

}  // namespace mpm
