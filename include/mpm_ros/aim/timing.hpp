// Costs of the steps of copies of a scene on this machine, found in the file of kept costs or timed. Over several ranks
// all of them time a copy together, each with its part of it, by the first one's clock: that one chooses, and tells the
// others what to time (lead/order.hpp).
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "mpm/pace/forecast.hpp"
#include "mpm/pace/kept_costs.hpp"
#include "mpm/scene/scene.hpp"
#include "mpm_ros/lead/order.hpp"

namespace mpm_ros {

class Timing {
 public:
  /// `ranks`: null for a process that is alone; else this is the first of them. Both must outlive it.
  Timing(int threads, mpm::Isa isa, const std::function<bool()>& stop, mpm::Communicator* ranks);

  /// Nothing where the scene cannot be run, or not one step was made. `budget` [s]: as time_copy() has it.
  /// @throws mpm::StoppedError
  std::optional<mpm::pace::Forecast> of(const mpm::Scene& scene, double budget);

 private:
  std::optional<mpm::pace::Forecast> time(const mpm::Scene& scene, double budget);

  const mpm::pace::KeptCosts costs_;
  const int threads_;
  const mpm::Isa isa_;
  const std::function<bool()>& stop_;
  mpm::Communicator* const ranks_;
};

/// On the other ranks: follows an order of Timing, whose "do" is "time".
void time_as_told(mpm::Communicator& ranks, const Order& order);

}  // namespace mpm_ros
