#include "mpm_ros/aim/timing.hpp"

#include <fmt/format.h>

#include <new>

#include "mpm/advice/target_record.hpp"
#include "mpm/simulation/rank_failure.hpp"
#include "mpm_ranks/make_ranks.hpp"

namespace mpm_ros {
namespace {

using mpm::pace::Forecast;

/// Times a copy on all ranks; each of them calls it. What it fails at has to fail on all.
std::optional<Forecast> time_together(mpm::Communicator& ranks, const mpm::Scene& scene, int threads, mpm::Isa isa,
                                      double budget, const std::function<bool()>& stop) {
  try {
    return mpm::pace::time_copy(mpm::build(scene, &ranks), threads, isa, budget, stop, &ranks);
  } catch (const mpm::StoppedError&) {
    throw;
  } catch (const mpm::RankFailure&) {
    throw;
  } catch (const mpm::Error& error) {
    mpm::fail_alike(ranks, fmt::format("rank {}: target: {}", ranks.rank(), error.what()), 2);
    return std::nullopt;
  }
}

}  // namespace

Timing::Timing(int threads, mpm::Isa isa, const std::function<bool()>& stop, mpm::Communicator* ranks)
    : costs_(mpm::pace::kept_costs_path()), threads_(threads), isa_(isa), stop_(stop), ranks_(ranks) {}

std::optional<Forecast> Timing::of(const mpm::Scene& scene, double budget) {
  std::string text = mpm::text_without_target(scene);
  if (ranks_ != nullptr) text += fmt::format("\nranks: {}", ranks_->size());
  const std::string key = mpm::pace::cost_key(text, isa_, threads_);
  const std::int64_t now = mpm::pace::wall_time();
  if (const auto kept = costs_.find(key, now))
    return Forecast{kept->cost, kept->particles, kept->threads, scene.definition.time.end, false, false};
  const std::optional<Forecast> timed = time(scene, budget);
  if (timed) costs_.keep(key, {timed->cost, timed->threads, timed->particles, now});
  return timed;
}

std::optional<Forecast> Timing::time(const mpm::Scene& scene, double budget) {
  if (ranks_ != nullptr) {
    tell(*ranks_, {{"do", "time"},
                   {"scene", scene.text},
                   {"path", scene.path},
                   {"threads", threads_},
                   {"isa", mpm::isa_name(isa_)},
                   {"budget", budget}});
    return time_together(*ranks_, scene, threads_, isa_, budget, stop_);
  }
  try {
    return mpm::pace::time_copy(mpm::build(scene, nullptr, stop_), threads_, isa_, budget, stop_);
  } catch (const mpm::StoppedError&) {
    throw;
  } catch (const mpm::Error&) {
    return std::nullopt;
  } catch (const std::bad_alloc&) {
    return std::nullopt;
  }
}

void time_as_told(mpm::Communicator& ranks, const Order& order) {
  try {
    const mpm::Scene scene = mpm::parse_scene(order.at("scene"), order.at("path"));
    const mpm::Isa isa = mpm::choose_isa(order.at("isa").get<std::string>());
    time_together(ranks, scene, order.at("threads"), isa, order.at("budget"), [] { return false; });
  } catch (const mpm::StoppedError&) {
    // The first rank tells what follows.
  }
}

}  // namespace mpm_ros
