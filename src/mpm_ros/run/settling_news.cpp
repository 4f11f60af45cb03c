#include "mpm_ros/run/settling_news.hpp"

#include <fmt/format.h>

#include <chrono>
#include <utility>

namespace mpm_ros {

std::function<void(const mpm::Settling&)> settling_news(std::function<void(const std::string&)> say) {
  using Clock = std::chrono::steady_clock;
  return [say = std::move(say), last = Clock::now()](const mpm::Settling& now) mutable {
    if (Clock::now() - last < std::chrono::seconds(kNewsPeriod)) return;
    last = Clock::now();
    say(
        fmt::format("geostatic start: after {} steps of settling the unbalanced force is {:.2g} of the weight; it "
                    "begins at {:.2g}",
                    now.steps, now.unbalanced, now.wanted));
  };
}

}  // namespace mpm_ros
