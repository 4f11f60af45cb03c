#include "mpm_ros/node/start_line.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "mpm_ros/message/topics.hpp"

namespace mpm_ros {

namespace {

std::string pacing_text(const StartFacts& facts) {
  if (facts.pacing == Pacing::lockstep) return "lockstep";
  if (facts.pacing == Pacing::free) return "as fast as it goes";
  return facts.real_time_factor == 1.0 ? "real time" : fmt::format("{:g} of real time", facts.real_time_factor);
}

}  // namespace

std::string start_line(const StartFacts& facts) {
  const std::string below = facts.name_space == "/" ? "/" : facts.name_space + "/";
  std::vector<std::string> next;
  for (const auto& [body, topic] : facts.heights)
    next.push_back(fmt::format("has the heights of '{}' from {}", body, topic));
  if (facts.paused) next.push_back(fmt::format("waits for the service {}{} with false", below, topics::kPause));
  if (facts.pacing == Pacing::lockstep) {
    next.push_back(fmt::format("{} for the service {}{}", facts.paused ? "then" : "waits", below, topics::kStep));
  } else if (!facts.paused) {
    next.push_back(facts.end > 0.0 ? fmt::format("runs to {:g} s", facts.end) : "runs until it is stopped");
  }
  if (!facts.commands.empty()) {
    next.push_back(fmt::format("commands come from {}", facts.commands));
  } else {
    for (const auto& [body, frame] : facts.frames)
      next.push_back(fmt::format("'{}' waits for the tf frame '{}'", body, frame));
  }
  if (facts.clock) next.emplace_back("publishes /clock");
  const std::string ranks = facts.ranks == 1 ? "" : fmt::format("{} ranks of ", facts.ranks);
  return fmt::format("{}: {} particles, {}, {}{} thread{}, in {}; {}", facts.scene, facts.particles, pacing_text(facts),
                     ranks, facts.threads, facts.threads == 1 ? "" : "s", facts.name_space, fmt::join(next, "; "));
}

}  // namespace mpm_ros
