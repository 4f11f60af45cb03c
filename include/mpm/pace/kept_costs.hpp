// Costs of steps that were timed on this machine, kept in a file for a day, so that a program which starts the same
// scene again need not time it again.
//
// The file is a convenience: one that is not there, cannot be read or written, or holds something else, is as good as
// none. A cost belongs to a text, made of all that it depends on (cost_key()).
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "mpm/pace/step_cost.hpp"

namespace mpm::pace {

struct KeptCost {
  StepCost cost;
  int threads = 1;
  std::uint64_t particles = 0;
  std::int64_t when = 0;  ///< [s] since 1970, when it was timed
};

class KeptCosts {
 public:
  static constexpr std::int64_t kLifetime = 86'400;  ///< [s]
  static constexpr std::size_t kMost = 200;          ///< costs kept; the oldest make room

  /// `path`: of the file; empty: nothing is found or kept.
  explicit KeptCosts(std::string path) : path_(std::move(path)) {}
  /// `now`: [s] since 1970. Costs that are older than kLifetime, or from the future, are not found.
  std::optional<KeptCost> find(const std::string& key, std::int64_t now) const;
  /// Returns whether it is kept. Programs that keep at the same time do not damage the file; one may be lost.
  bool keep(const std::string& key, const KeptCost& kept) const;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// $XDG_CACHE_HOME/mpm_ros/step_costs.csv, or the same below ~/.cache; empty when neither is set.
std::string kept_costs_path();
/// Key of a scene's text with all that was set in it, an instruction set and a number of threads (0: chosen by the
/// run), on this machine and with this build.
std::string cost_key(const std::string& scene_text, Isa isa, int threads);
/// Seconds since 1970.
std::int64_t wall_time();

}  // namespace mpm::pace
