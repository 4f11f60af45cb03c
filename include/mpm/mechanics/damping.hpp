// Damping of a run: what it is in each step, and the account of what it took. A step with it:
//
//   momentum_gathered   rates of this step, per particle where they are functions of place
//   forces_gathered     f -= alpha_g p on the nodes, when the scene places it there; method reference 6.3
//   (move)              reads rates() and flip(), and hands end_step() what it took; method reference 6.1
//   end_step            the feedback's alpha for the next step; method reference 6.5
//
// When and where rates are read: at the middle of the step, t + dt/2, and at the place of the particle at its start
// (GIMP notes (2.45)). The update takes (1 - alpha dt) a step, which is first order; the middle costs nothing and makes
// the impulse of a rate that changes with time, not with place, second order.
// Feedback is integrated once a step, alpha += dt d alpha/dt, with the energy at the start of the step: first order.
// PIC of time alone is a FLIP fraction; as a function of place it becomes rates, -(1-beta)/dt of the grid and
// +(1-beta)/dt of the particle (method reference 6.2), which then exchange momentum with the outside: it is in the
// account. Over several ranks alpha is the same on all: it grows with the energy of all of them.
// A rate below 0, or one that would turn a velocity round in a step, ends the run.
// Source: Nairn, GIMP notes (2.15)-(2.45).
#pragma once

#include <vector>

#include "mpm/grid/fields.hpp"
#include "mpm/mechanics/first_fault.hpp"
#include "mpm/particles/particle_set.hpp"
#include "mpm/ranks/of_all.hpp"
#include "mpm/step/damping.hpp"
#include "mpm/step/stage.hpp"

namespace mpm {

/// Damping that has no value somewhere, or one that cannot be. what() names the key, the time and the remedy.
class DampingError : public ModuleError {
 public:
  using ModuleError::ModuleError;
};

/// Damping rates for the update of one set's particles [1/s]: two numbers, or instead of them two arrays with the whole
/// rates of each particle, in the order of this step.
struct DampingRates {
  double grid = 0.0, particle = 0.0;
  const double* grid_of_particle = nullptr;
  const double* particle_of_particle = nullptr;
};

/// Sums over the update of all particles.
struct Damped {
  Vec3 momentum = Vec3::Zero();  ///< taken: sum of m (alpha_g v0 + alpha_p v) dt, world axes [N s]
  double grid_energy = 0.0;  ///< sum of m |v0|^2 / 2, of the grid's velocity: the step's start, or what is adopted [J]
  double particle_energy = 0.0;  ///< sum of m |v|^2 / 2, v before the update [J]
};

/// Audit: "damping", on the nodes and on the particles together.
class DampingControl final : public Stage {
 public:
  /// `flip`: the transfer's fraction, for a scene without a part of PIC of its own. `fields`, `sets` and `ranks`, which
  /// is null on one process, outlive it.
  DampingControl(const DampingDefinition& definition, double flip, Fields& fields, const std::vector<ParticleSet>& sets,
                 int threads, Communicator* ranks = nullptr);

  /// True if move has to damp, and true if it has to find the energies; end_step() goes with either.
  bool in_update() const { return definition().in_update(); }
  bool needs_energy() const { return definition().feedback.has_value(); }

  /// Rates of the step that begins. @throws DampingError
  void begin_step(const StepContext& context);
  /// The same for a device (step/device.hpp), where no rate is a function of place.
  void begin_step(double start, double dt);
  DampingRates rates(int set) const;
  /// FLIP fraction of this step.
  double flip() const { return flip_; }
  /// True if that is by a part of PIC of this scene's damping.
  bool has_part_of_pic() const { return !definition().pic.is_zero(); }
  /// Rate of the force on the nodes in this step [1/s].
  double force_rate() const { return force_rate_; }
  /// The step began at `start` [s]; `damped`: what the update of particles took.
  void end_step(double start, double dt, const Damped& damped);
  void end_step(const StepContext& context, const Damped& damped) { end_step(context.start, context.dt, damped); }
  /// Books what the force on the nodes gave where a device takes the steps.
  void count(const ImpulseAccount& given) {
    account_.impulse += given.impulse;
    account_.exchanged += given.exchanged;
  }

  std::string name() const override { return account_.name; }
  Ranks ranks(Hook) const override { return {Rank::damping}; }

  void run_begun(StepContext&) override {
    if (ranks_ != nullptr) total_mass_ = ranks_->sum(mass());
  }
  void momentum_gathered(StepContext& context) override { begin_step(context); }
  void forces_gathered(StepContext& context) override;
  void accounts(std::vector<ImpulseAccount>& list) const override { list.push_back(account_); }
  /// "alpha", of the feedback.
  void numbers(std::vector<NamedNumber>& list) const override {
    list.push_back({"alpha", "1/s", is_first(ranks_) ? alpha_ : 0.0});
  }
  /// @throws DampingError
  void limit_step(const PeriodAhead& period, StepLimit& limit) const override;
  std::string limit_text(const StepLimit&) const override { return "method.damping"; }
  void hashed(std::vector<double>& numbers) const override {
    if (needs_energy()) numbers.push_back(alpha_);
  }
  void serialise(StateArchive& archive) override {
    archive.value("alpha", alpha_);
    account_.serialise(archive);
  }

  /// Rate of the feedback, now [1/s].
  double alpha() const { return alpha_; }
  /// The largest rate between `start` and `start` + `period` [s], as far as it can be foreseen: functions at the
  /// beginning, the middle and the end, where the particles are now, and feedback as it grows with the kinetic `energy`
  /// of now [J]. Grid's and particles' together [1/s]. @throws DampingError
  double largest_rate(double start, double period, double energy, const GridLayout& layout) const;

 private:
  const DampingDefinition& definition() const { return of_thread_.front(); }
  /// Values that are read at a time and a place.
  struct Sample {
    double grid = 0.0, particle = 0.0;  ///< [1/s]
    double pic = 0.0;
  };
  /// @throws DampingError for a rate that is too large for a step
  static void check(const Sample& sample, double dt);
  /// Without a place functions of place are left out. `alpha`: of the feedback. @throws DampingError, FunctionError
  Sample sample(int thread, double t, double alpha, const Vec3* place) const;
  /// visit(sample) of what is the same everywhere. @throws DampingError
  template <class Visit>
  void everywhere(double t, double alpha, Visit&& visit) const;
  /// visit(thread, set, particle, sample) for all particles. @throws DampingError, that of the smallest id
  template <class Visit>
  void each_particle(double t, double alpha, const GridLayout& layout, Visit&& visit) const;
  /// Adds the force of this step to the nodes of a field; returns its impulse [N s].
  Vec3 damp_nodes(Grid& grid, double dt);
  /// Mass of this rank's particles [kg].
  double mass() const;
  /// d alpha/dt [1/s^2]. @throws DampingError
  double growth(double energy, double t) const;

  std::vector<DampingDefinition> of_thread_;  ///< an expression holds one evaluation at a time
  Fields& fields_;
  const std::vector<ParticleSet>& sets_;
  int threads_;
  Communicator* ranks_;
  double total_mass_ = 0.0;
  bool of_place_;

  double force_rate_ = 0.0;
  DampingRates rates_;  ///< rates of all particles in this step
  double given_flip_, flip_;
  std::vector<PaddedArray<double>> grid_values_, particle_values_;  ///< rates of each set's particles [1/s]
  mutable FirstFault fault_;
  std::vector<Vec3> block_sums_;  ///< force on the nodes of each block [N]

  double alpha_ = 0.0;  ///< [1/s]
  ImpulseAccount account_;
};

}  // namespace mpm
