// Work that can take long, before a run begins and within a step, asks now and then whether it is to stop.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>

#include "mpm/math/error.hpp"

namespace mpm {

/// The run was asked to stop (SimulationOptions::stop or interrupt) while it was built or settled, or within a sync
/// period: it cannot go on.
class StoppedError : public Error {
 public:
  using Error::Error;
};

/// Asks in every so many calls, since a question costs more than the work of most of them.
class StopCheck {
 public:
  /// `stop` may be empty. `during`: what is stopped, as in "while {}".
  StopCheck(std::function<bool()> stop, std::string during, std::uint32_t every = 1024)
      : stop_(std::move(stop)), during_(std::move(during)), every_(every) {}
  /// @throws StoppedError
  void operator()() {
    if (++calls_ % every_ == 0 && stop_ && stop_()) throw StoppedError("stopped while " + during_);
  }

 private:
  std::function<bool()> stop_;
  std::string during_;
  std::uint32_t every_, calls_ = 0;
};

}  // namespace mpm
