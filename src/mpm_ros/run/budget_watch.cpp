#include "mpm_ros/run/budget_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "mpm/math/nanoseconds.hpp"

namespace mpm_ros {
namespace {

constexpr double kRoom = 1.2;  ///< proposed over least: no two sync periods take the same time

}  // namespace

std::string milliseconds(double seconds) {
  return seconds < 1.0 ? fmt::format("{:.3g} ms", 1e3 * seconds) : fmt::format("{:.3g} s", seconds);
}

std::string short_budget(const mpm::SweepBudget& budget) {
  const std::optional<double> least = budget.least();
  if (!least || *least <= budget.seconds()) return {};
  return fmt::format(
      "time.budget: {} is too little: with {} sweeps in a step, the fewest, a sync period takes {} here; write {} or "
      "more, or a larger grid.cell",
      milliseconds(budget.seconds()), mpm::kLeastSweeps, milliseconds(*least),
      milliseconds(std::ceil(kRoom * 1e3 * *least) * 1e-3));
}

void BudgetWatch::look(const mpm::SweepBudget& budget, std::int64_t time, std::vector<std::string>& lines,
                       Clock::time_point now) {
  if (!told_short_) {
    if (const std::string line = short_budget(budget); !line.empty()) {
      lines.push_back(line);
      told_short_ = true;
    }
  }
  if (budget.cut_error() > mpm::kForceErrorBound) {
    cut_ += budget.cut().size();
    worst_ = std::max(worst_, budget.cut_error());
  }
  if (cut_ == 0 || (told_ && now < told_at_ + kAgain)) return;
  lines.push_back(fmt::format(
      "time.budget has ended the sweeps of {} step{} up to t = {:.6g} s where the force on tools was off by "
      "up to {:.0f} %; solver_state has its error (sweep_error) of each step",
      cut_, cut_ == 1 ? "" : "s", mpm::seconds_of(time), 100.0 * worst_));
  told_ = true;
  told_at_ = now;
  cut_ = 0;
  worst_ = 0.0;
}

}  // namespace mpm_ros
