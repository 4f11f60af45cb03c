// Reports of a Simulation at a sync point: plain values, SI, without references into the solver.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "mpm/contact/contact_report.hpp"
#include "mpm/contact/pair_report.hpp"
#include "mpm/crack/tip_numbers.hpp"
#include "mpm/math/geometry.hpp"
#include "mpm/rigid/rigid_body.hpp"
#include "mpm/step/module.hpp"

namespace mpm {

struct BodyState {
  std::string name;
  Pose pose;
  Twist twist;
  Drive drive = Drive::functions;
  double mass = 0.0;  ///< [kg] of a free body; 0: all of its motion is prescribed
};

/// One external impulse on the material since the start [N s].
struct NamedImpulse {
  std::string name;  ///< "gravity", "contact/blade", "wall/z_min", "damping", "body_force", "condition/lid",
                     ///< "absorbing/x_min", …
  Vec3 impulse = Vec3::Zero();
};

/// Momentum balance: change = sum of the impulses + residual. Each term is found independently of the others.
struct AuditReport {
  Vec3 momentum = Vec3::Zero();  ///< momentum of the particles now [N s]
  Vec3 initial_momentum = Vec3::Zero();
  std::vector<NamedImpulse> impulses;
  double exchanged = 0.0;  ///< momentum exchanged: sum over steps and sources of |impulse| [N s]
  double carried = 0.0;    ///< sum of m |v| of the particles now [N s]
  double residual = 0.0;   ///< |change - sum of impulses| / max(exchanged, carried)
};

/// Limit of the time step, and the steps taken.
struct StepReport {
  std::uint64_t steps = 0;  ///< since the start
  double dt_min = 0.0;      ///< [s] over the run so far
  double dt_max = 0.0;
  double dt_last = 0.0;
  double courant =
      0.0;  ///< largest part of a cell that a wave was seen to cross in a step; above 1 steps were too long
  std::uint64_t divided = 0;  ///< sync periods whose steps were made shorter on the way
  std::string limited_by;     ///< cause and place: "wave speed of 'soil' (61 m/s …) at (0.1, 0, 0.3) m", "time.step"
};

/// An explicit crack. Lists have an entry for each point of its chain.
struct CrackReport {
  std::string name;
  double length = 0.0, open_length = 0.0;               ///< all of it, and without tractions [m]
  std::vector<Vec3> points, above, below;               ///< the chain and its faces, world [m]
  std::vector<double> normal_traction, shear_traction;  ///< [Pa]
  std::vector<bool> debonded;                           ///< the law of tractions has failed
};

/// The tip of an explicit crack, as it was last looked at: at the last sync point, or when it could grow.
struct CrackTipReport : TipNumbers {
  std::string crack, end;                                ///< the crack's name; "start" or "end" of its chain
  Vec3 place = Vec3::Zero(), direction = Vec3::UnitX();  ///< world [m]; of growth straight on
  std::string state, growth, material;  ///< state of J; reason why it grew or not; material of constants
  bool has_j = true;                    ///< false: it was looked at, and J could not be found
  bool stopped = false;                 ///< it grows no more, as `growth` says
};

/// Sharing of the particles among ranks.
struct SharingReport {
  std::uint64_t handed_over = 0;  ///< particles from rank to rank, since the start
  std::uint64_t divisions = 0;    ///< number of times that the grid was divided
  double imbalance = 1.0;         ///< particles of the fullest rank over the mean of all, when they last met
};

struct SolverState {
  std::int64_t time = 0;  ///< [ns]
  StepReport step;
  /// kinetic, elastic (stored in the material), plastic (dissipated by flow since the start), potential (-sum m g.x);
  /// and what modules add: contact_work (of rigid bodies on the material), load_work (of loads, velocity conditions and
  /// absorbing faces), friction (taken by sliding on rigid bodies), pair_friction (between deformable bodies),
  /// interface (stored in imperfect interfaces at the start of the last step); of free rigid bodies free_kinetic,
  /// free_potential, free_work (of applied wrenches, and of what drives their prescribed velocities) and free_loss
  /// (where they and the material met, sliding left out), contact_work being what they lost to the material.
  EnergyReport energy;
  AuditReport audit;
  std::uint64_t particles = 0;
  std::vector<NamedNumber> numbers;  ///< numbers of modules: "returned" (particles that were put back), "alpha", …
  double min_j = 1.0;                ///< smallest det F of any particle now
  double wall_seconds = 0.0;         ///< spent in stepping

  /// One of `numbers`, or 0 where the run has none of that name.
  double number(const std::string& name) const {
    const auto found = std::find_if(numbers.begin(), numbers.end(), [&](const auto& n) { return n.name == name; });
    return found == numbers.end() ? 0.0 : found->value;
  }
};

}  // namespace mpm
