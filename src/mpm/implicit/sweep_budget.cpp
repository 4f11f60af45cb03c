#include "mpm/implicit/sweep_budget.hpp"

#include <algorithm>
#include <cmath>

namespace mpm {
namespace {

constexpr double kForget = 0.1;        ///< part of what was foreseen too long, a time
constexpr double kMostAtOnce = 2.0;    ///< growth at once of what was foreseen: a machine that was away comes back
constexpr int kKnown = 20;             ///< sync periods until least() is known; the first ones fill memory
constexpr double kRecent = 0.05;       ///< weight of the last sync period in least(), when many are known
constexpr double kOfChange = 0.9;      ///< error of the force over its change, with
constexpr double kUsual = 1000.0;      ///< sweeps a second of simulated time
constexpr double kOfLargest = 0.1;     ///< part of the largest force met: errors of less are measured by that
constexpr double kLastSteps = 0.2;     ///< weight of the last step in the error
constexpr std::size_t kOfPeriod = 64;  ///< cut steps of a sync period that have their place from the start

double seconds_of(SweepBudget::Clock::duration time) { return std::chrono::duration<double>(time).count(); }

SweepBudget::Clock::duration duration_of(double seconds) {
  return std::chrono::duration_cast<SweepBudget::Clock::duration>(std::chrono::duration<double>(seconds));
}

void learn(double taken, double& foreseen) {
  if (foreseen == 0.0) {
    foreseen = taken;
  } else if (taken > foreseen) {
    foreseen = std::min(taken, kMostAtOnce * foreseen);
  } else {
    foreseen += kForget * (taken - foreseen);
  }
}

}  // namespace

SweepBudget::SweepBudget(double seconds) : seconds_(seconds) { cut_.reserve(kOfPeriod); }

void SweepBudget::begin_period(std::uint64_t steps, double end, Clock::duration late) {
  step_ = steps;
  end_ = end;
  swept_ = false;
  more_ = 0.0;
  cut_.clear();
  cut_error_ = 0.0;
  begun_ = Clock::now();
  deadline_ = begun_ + duration_of(seconds_) - late;
}

void SweepBudget::end_period() {
  if (repeats() || !swept_) return;
  const Clock::time_point now = Clock::now();
  learn(seconds_of(now - done_at_), after_);
  const double taken = seconds_of(now - begun_) - more_;
  ++periods_;
  least_ += (taken - least_) * std::max(1.0 / periods_, kRecent);
}

void SweepBudget::begin_sweeps(double start, double dt) {
  ++step_;
  dt_ = dt;
  ended_here_ = false;
  if (repeats()) return;
  sweeps_at_ = Clock::now();
  if (swept_) {
    learn(seconds_of(sweeps_at_ - done_at_), between_);
  } else {
    learn(seconds_of(sweeps_at_ - begun_), before_);
  }
  // Until it is known, a step is taken to do as much before its sweeps as after them.
  const double after = after_ > 0.0 ? after_ : before_;
  const double between = between_ > 0.0 ? between_ : 2.0 * before_;
  const double steps = std::max(1.0, std::round((end_ - start) / dt));
  for_sweeps_ = (seconds_of(deadline_ - sweeps_at_) - after - (steps - 1.0) * between) / steps;
}

bool SweepBudget::ends_after(int sweeps) {
  if (sweeps < kLeastSweeps) return false;
  if (repeats()) {
    ended_here_ = recorded_ends_after(sweeps);
  } else {
    const double taken = seconds_of(Clock::now() - sweeps_at_);
    ended_here_ = taken + taken / sweeps > for_sweeps_;  // with one more of the same length
  }
  return ended_here_;
}

bool SweepBudget::recorded_ends_after(int sweeps) const {
  const auto before = [](const CutStep& one, std::uint64_t step) { return one.step < step; };
  const auto found = std::lower_bound(recorded_->begin(), recorded_->end(), step_, before);
  return found != recorded_->end() && found->step == step_ && sweeps >= found->sweeps;
}

void SweepBudget::end_sweeps(const SweepsMade& made) {
  const double of_change = std::max(kOfChange * kUsual * dt_ / made.sweeps, 1.0);
  open_ += kLastSteps * (of_change * made.change - open_);
  force_ += kLastSteps * (made.force - force_);
  largest_ = std::max(largest_, force_);
  if (ended_here_) {
    ++all_cut_;
    cut_.push_back({step_, made.sweeps});
    cut_error_ = std::max(cut_error_, error());
  }
  if (repeats()) return;
  swept_ = true;
  done_at_ = Clock::now();
  const double beyond = std::max(made.sweeps - kLeastSweeps, 0);
  more_ += seconds_of(done_at_ - sweeps_at_) * beyond / made.sweeps;
}

double SweepBudget::error() const {
  const double force = std::max(force_, kOfLargest * largest_);
  return force > 0.0 ? std::min(open_ / force, 1.0) : 0.0;
}

void SweepBudget::numbers(std::vector<NamedNumber>& list) const {
  list.push_back({"sweeps_cut", "1", static_cast<double>(all_cut_)});
  list.push_back({"sweep_error", "1", error()});
}

void SweepBudget::serialise(StateArchive& archive) {
  archive.value("cut", all_cut_);
  archive.value("open", open_);
  archive.value("force", force_);
  archive.value("largest", largest_);
}

std::optional<double> SweepBudget::least() const {
  if (periods_ < kKnown) return std::nullopt;
  return least_;
}

}  // namespace mpm
