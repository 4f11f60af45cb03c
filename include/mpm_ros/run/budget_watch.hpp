// Warnings about a run whose sweeps end by the clock (time.budget), a line each: that a sync period takes longer with
// the fewest sweeps, and that the forces on tools are worse for it.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "mpm/implicit/sweep_budget.hpp"

namespace mpm_ros {

/// "7.2 ms"; from a second on "1.5 s".
std::string milliseconds(double seconds);

/// That ten sweeps do not fit, with the numbers; empty where they do, or it is not known yet.
std::string short_budget(const mpm::SweepBudget& budget);

class BudgetWatch {
 public:
  using Clock = std::chrono::steady_clock;

  /// After each sync period, which ends at `time` [ns]. Adds what is to be told: the first once, the second at once,
  /// and while it goes on every kAgain.
  void look(const mpm::SweepBudget& budget, std::int64_t time, std::vector<std::string>& lines,
            Clock::time_point now = Clock::now());

  static constexpr std::chrono::seconds kAgain{10};

 private:
  bool told_short_ = false, told_ = false;
  Clock::time_point told_at_;
  std::uint64_t cut_ = 0;  ///< steps with such forces, since it was told last
  double worst_ = 0.0;     ///< their largest error, over the force
};

}  // namespace mpm_ros
