#include "mpm/implicit/implicit_step.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "host_field.hpp"
#include "mpm/boundary/axis.hpp"
#include "mpm/implicit/sweep_momentum.hpp"
#include "mpm/kernel/select.hpp"
#include "mpm/shape/ring.hpp"

namespace mpm {
namespace {

constexpr double kStiffer = 240.0;  ///< modulus that sweeps resolve over the mean pressure on tools
constexpr double kOwn = 4.0;        ///< the same over the soil's own modulus, more than which is of no use
/// The same over the yield stress of metal, whose strain before it yields counts: of it some 1 / kStrains is lost.
constexpr double kStrains = 300.0;
constexpr double kSettled = 3e-3;  ///< change of all stresses in a sweep, over the stresses
// Change of the forces on tools in the second half of the sweeps: over the forces, and over what the step has changed
// them by, since of a force that grows slowly an error in each step adds up.
constexpr double kForceError = 0.02, kLeastForceError = 0.005, kOfGain = 0.25;
constexpr double kHeld = 6.0;        ///< pressure on a tool over rho (h / dt)^2, at the most
constexpr int kWholeSweeps = 2;      ///< that take all blocks, whether they need it or not
constexpr double kQuiet = 0.1;       ///< part of a block's share of what is left to settle: with less it is not swept
constexpr int kSweepsToSettle = 16;  ///< after which the joints of robots are looked at
constexpr double kKept = 0.9;        ///< part of the sweeps of the step before, at the least
constexpr double kLightest = 1e-6;   ///< part of a cell full of soil: what is added to a node's mass in the solve

template <class T>
class ImplicitStep final : public Stage, public ContactReporter, public ImplicitSolve<T> {
 public:
  ImplicitStep(ImplicitParts parts, const ImplicitSettings& settings)
      : table_(sweep_table<T>(settings.isa, settings.geometry)),
        settings_(settings),
        grid_(*parts.grid),
        sets_(*parts.sets),
        soil_grid_(grid_, settings.walls, axisymmetric(settings.geometry), settings.threads),
        bodies_(std::move(parts.bodies)),
        range_(bodies_.soils),
        out_(parts.tools, grid_.layout),
        tools_(std::move(parts.tools), std::move(parts.laws), soil_grid_,
               {settings.geometry, settings.across, range_.least_density, settings.threads, settings.gravity,
                settings.meeting}),
        walls_(settings.walls, soil_grid_),
        held_(grid_) {
    double volume = soil_grid_.rings() ? kTurn * grid_.layout.cell(0) : settings.across;
    for (int k = 0; k < grid_.layout.dim(); ++k) volume *= grid_.layout.cell(k);
    lightest_ = kLightest * range_.least_density * volume;
    own_field_ = std::make_unique<HostField<T>>(FieldParts<T>{table_, grid_, sets_, soil_grid_, tools_, walls_, out_},
                                                bodies_, settings.threads, lightest_, settings.loads);
    field_ = own_field_.get();
    light_.name = "implicit/light_nodes";
    axis_.name = "axis";
    hoops_.name = "hoop stress";
    pressed_.reserve(settings.sweeps.value_or(kMostSweeps) + 1);
  }

  std::string name() const override { return kImplicitName; }
  /// Under pressure that is many times rho (h / dt)^2 a step is shorter: to the motion of a cell's nodes against each
  /// other that leaves its mean strain at none, no stress of the cell answers, and where soil is not spread evenly it
  /// drives that motion.
  void limit_step(const PeriodAhead& period, StepLimit& limit) const override {
    const ToolPressure& pressed = tools_.pressure();
    if (!(pressed.mean > 0.0)) return;
    StepLimit own;
    own.by = this;
    own.part = static_cast<int>(sets_.size()) + pressed.body;
    own.speed = pressed.mean;
    // The mean over a sliver may be more than soil can bear.
    const double most = std::min(pressed.mean, kOwn * range_.modulus);
    own.dt = period.cell * std::sqrt(kHeld * range_.least_density / most);
    limit.tighten(own);
  }
  std::string limit_text(const StepLimit& limit) const override {
    const int tool = limit.part - static_cast<int>(sets_.size());
    if (tool >= 0) return fmt::format("pressure on '{}' ({:.3g} kPa)", tools_.name(tool), 1e-3 * limit.speed);
    return fmt::format("motion of '{}' (up to {:.4g} m/s)", sets_[limit.part].name, limit.speed);
  }
  Ranks ranks(Hook) const override { return {Rank::implicit}; }
  std::optional<OutsideReason> why_outside(const GridLayout& layout, const ParticleSet& set,
                                           int particle) const override {
    std::optional<OutsideReason> reason;
    if (soil_grid_.axis()) reason = outside_at_axis(layout, set, particle);
    if (reason) reason->remedy = "lower time.step, or use method.update: usavg";
    return reason;
  }

  void step_ended() override { sorts_ = field_ != nullptr && field_->put_out(); }
  bool needs_sort() const override { return sorts_; }
  void check_put(const RigidBody& body) const override { tools_.check_overlaps(body); }
  void body_put(const RigidBody& body) override { tools_.forget(body); }

  void momentum_updated(StepContext& context) override { solve_step(context.start, context.dt); }

  // Functions of ImplicitSolve.
  Grid& grid() override { return grid_; }
  const SoilGrid& soil_grid() const override { return soil_grid_; }
  const SoilBodies& bodies() const override { return bodies_; }
  ToolRows<T>& tools() override { return tools_; }
  WallRows<T>& walls() override { return walls_; }
  const OutOfTools& out_of_tools() const override { return out_; }
  double lightest() const override { return lightest_; }
  bool loads() const override { return settings_.loads; }
  void use(SoilField<T>* field) override {
    own_field_.reset();
    field_ = field;
  }
  void solve_step(double start, double dt) override {
    const bool other_blocks = soil_grid_.rebuild();
    tools_.clear();
    walls_.clear();
    field_->begin(dt, other_blocks);
    timed("implicit: contact", [&] {
      tools_.find(field_->nodes(), start, dt);
      walls_.find(field_->nodes(), dt);
      field_->take_rows();
    });
    timed("implicit: sweeps", [&] {
      solve(start, dt);
      field_->end_sweeps();
    });
    timed("implicit: cells to particles", [&] { store(dt); });
  }

  void accounts(std::vector<ImpulseAccount>& list) const override {
    for (const ContactLedger& ledger : tools_.ledgers()) list.push_back(ledger.account());
    walls_.accounts(list);
    list.push_back(light_);
    if (!soil_grid_.rings()) return;
    list.push_back(axis_);
    list.push_back(hoops_);
  }
  void energies(EnergyReport& report) const override {
    report.leave_open();  // particles lose a part of the change of velocity to the grid
    for (const ContactLedger& ledger : tools_.ledgers()) ledger.energies(report);
    tools_.energies(report);
    walls_.energies(report);
    report.add("implicit_step", NamedEnergy::Kind::dissipated, taken_);
  }
  void numbers(std::vector<NamedNumber>& list) const override {
    list.push_back({"sweeps", "1", static_cast<double>(sweeps_)});
    list.push_back({"sweep_change", "1", change_});
    list.push_back({"sweep_modulus", "Pa", modulus_});
    list.push_back({"sweep_load", "1", load_});
    if (settings_.budget != nullptr) settings_.budget->numbers(list);
  }
  ContactLedger* ledger_of(const RigidBody& body) override {
    for (ContactLedger& ledger : tools_.ledgers()) {
      if (&ledger.body() == &body) return &ledger;
    }
    return nullptr;
  }
  void serialise(StateArchive& archive) override {
    tools_.serialise(archive);
    walls_.serialise(archive);
    light_.serialise(archive);
    if (soil_grid_.rings()) {
      for (ImpulseAccount* account : {&axis_, &hoops_}) {
        const StateArchive::Group group(archive, account->name);
        account->serialise(archive);
      }
    }
    archive.sum("taken", taken_);
    archive.value("least", least_);
    archive.value("sweeps", sweeps_);
    archive.value("change", change_);
    archive.value("modulus", modulus_);
    archive.value("load", load_);
    if (settings_.budget == nullptr) return;
    const StateArchive::Group group(archive, "budget");
    settings_.budget->serialise(archive);
  }

 private:
  /// Modulus that one sweep resolves [Pa].
  double unit(double dt) const {
    const double cell = grid_.layout.smallest_cell();
    return range_.least_density * cell * cell / (dt * dt);
  }
  /// As many as resolve the pressure that tools met in the last step and what metal bears, and not many less than in
  /// that step, so that the force does not jump with their number.
  int sweeps_needed(double dt) const {
    if (settings_.sweeps) return *settings_.sweeps;
    const double by_tools = std::min(kStiffer * tools_.pressure_to_resolve(), kOwn * range_.modulus);
    const double by_metal = std::min(kStrains * range_.yield_stress, kOwn * range_.metal_modulus);
    const double needed = std::max(by_tools, by_metal) / unit(dt);
    const int wanted = std::isfinite(needed) ? sweeps_for(needed, kMostSweeps) : 0;
    return std::max({static_cast<int>(kKept * least_), wanted, kLeastSweeps});
  }

  /// Before a pair of sweeps: all unknowns go on (sweep_momentum.hpp).
  void go_on(double factor) {
    field_->go_on(static_cast<T>(factor));
    tools_.extrapolate_free(factor);
  }

  void meet() {
    field_->meet();
    field_->show();
    tools_.meet_free(table_, field_->nodes());
    field_->take_back();
  }

  /// Sweeps the blocks that need it, then all contacts.
  void sweep(bool backwards) {
    field_->sweep(backwards, stirred_, changes_);
    meet();
  }

  void solve(double start, double dt) {
    least_ = sweeps_needed(dt);
    const int most = settings_.sweeps.value_or(kMostSweeps);
    meet();  // else what rests on friction would begin to creep
    change_ = 0.0;
    changes_.assign(grid_.blocks.size(), {0.0, 0.0});
    stirred_.assign(grid_.blocks.size(), 1);
    mpm_kernel::SweepChange sum{0.0, 0.0};  // change in the last sweep
    bool settled = false, cut = false;
    restart_.begin();
    pressed_.clear();
    pressed_.push_back(tools_.pressed());
    SweepBudget* budget = settings_.budget;
    if (budget != nullptr) budget->begin_sweeps(start, dt);
    for (sweeps_ = 0; sweeps_ < least_ || (sweeps_ < most && !settled);) {
      cut = budget != nullptr && budget->ends_after(sweeps_);
      if (cut) break;
      const bool backwards = sweeps_ % 2 == 1;
      if (sweeps_ % kSweepsToSettle == 0) tools_.settle();
      if (!backwards) go_on(restart_.factor(sum.change));
      if (sweeps_ + 1 == most) {
        stirred_.assign(stirred_.size(), 1);
      } else if (sweeps_ >= kWholeSweeps) {
        find_stirred(kQuiet * std::min(kSettled * kSettled * sum.size, sum.change));
      }
      sweep(backwards);
      ++sweeps_;
      const double now = tools_.pressed();
      pressed_.push_back(now);
      change_ = now > 0.0 ? std::abs(now - pressed_[sweeps_ / 2]) / now : 0.0;
      sum = {0.0, 0.0};
      for (const mpm_kernel::SweepChange& one : changes_) {
        sum.size += one.size;
        sum.change += one.change;
      }
      const double gained = now > 0.0 ? std::abs(now - pressed_.front()) / now : 0.0;
      const double allowed = std::clamp(kOfGain * gained, kLeastForceError, kForceError);
      settled = sum.change <= kSettled * kSettled * sum.size && change_ <= allowed && !tools_.settle();
    }
    if (tools_.settle()) meet();
    if (!cut) sweep_left_out(budget);
    if (budget != nullptr) budget->end_sweeps({sweeps_, pressed_.back(), change_ * pressed_.back()});
  }

  /// Ends the sweeps with one over all blocks where the last has left some out, which have gone on with the others.
  void sweep_left_out(SweepBudget* budget) {
    if (std::find(stirred_.begin(), stirred_.end(), 0) == stirred_.end()) return;
    if (budget != nullptr && budget->ends_after(sweeps_)) return;
    stirred_.assign(stirred_.size(), 1);
    sweep(sweeps_ % 2 == 1);
    ++sweeps_;
  }

  /// Finds blocks in which, or beside which, the last sweep has changed more than a block's share of `quiet`: the
  /// others need no sweep until their neighbours change.
  void find_stirred(double quiet) {
    const int blocks = static_cast<int>(changes_.size());
    const double share = quiet / blocks;
    for (int block = 0; block < blocks; ++block) {
      stirred_[block] = soil_grid_.any_around(block, [&](int near) { return changes_[near].change > share; }) ? 1 : 0;
    }
  }

  /// Gives the grid the velocities that were found, and books what walls took.
  void store(double dt) {
    held_.clear();
    field_->add_to_held(held_);
    tools_.add_to_held(held_);
    SoilDeeds deeds;
    for (int w = 0; w < 6; ++w) {
      for (int k = 0; k < 3; ++k) deeds.held[w][k] = -held_.walls()[w][k];
    }
    field_->finish(dt, deeds);
    light_.add(deeds.light);
    taken_ += deeds.taken;
    if (soil_grid_.axis()) axis_.add(deeds.held[SoilGrid::kAxis][0] * Vec3::UnitX());
    if (soil_grid_.rings()) hoops_.add(field_->of_hoops() * Vec3::UnitX());
    walls_.finish(field_->nodes(), deeds.held, dt);
    tools_.finish(field_->nodes(), dt);
    modulus_ = unit(dt) * modulus_of(sweeps_);
    // Sweeps that are stiffer than the soil by so much answer as the soil does.
    if (modulus_ < kOwn * range_.modulus) load_ = std::max(load_, tools_.pressure().mean / modulus_);
  }

  const mpm_kernel::SweepTable<T>& table_;
  ImplicitSettings settings_;
  Grid& grid_;
  std::vector<ParticleSet>& sets_;
  SoilGrid soil_grid_;
  SoilBodies bodies_;
  SoilRange range_;
  OutOfTools out_;
  ToolRows<T> tools_;
  WallRows<T> walls_;
  HeldImpulses held_;
  std::unique_ptr<HostField<T>> own_field_;  ///< null where a device has the soil
  SoilField<T>* field_;                      ///< soil that the steps move; null where a device has lost it
  MomentumRestart restart_;
  double lightest_ = 0.0;        ///< [kg]
  ImpulseAccount light_;         ///< impulse that light nodes were not given
  ImpulseAccount axis_, hoops_;  ///< along r, as boundary/axis.hpp has them
  double taken_ = 0.0;           ///< by the step itself [J]
  bool sorts_ = false;           ///< true if a particle was put back beyond the block that it is sorted into
  std::vector<mpm_kernel::SweepChange> changes_;  ///< change of each block in its last sweep
  std::vector<std::uint8_t> stirred_;             ///< for each block, 1 if the next sweep takes it
  std::vector<double> pressed_;                   ///< ToolRows::pressed() after each sweep of a step [N s]
  std::int32_t least_ = 0;                        ///< sweeps that the pressure on tools asked for
  std::int32_t sweeps_ = 0;
  double change_ = 0.0;
  double modulus_ = 0.0;  ///< that the sweeps of the last step resolve [Pa]
  double load_ = 0.0;     ///< largest pressure on a tool over it
};

}  // namespace

std::unique_ptr<Stage> make_implicit_step(ImplicitParts parts, const ImplicitSettings& settings, Precision precision) {
  if (precision == Precision::float64) return std::make_unique<ImplicitStep<double>>(std::move(parts), settings);
  return std::make_unique<ImplicitStep<float>>(std::move(parts), settings);
}

}  // namespace mpm
