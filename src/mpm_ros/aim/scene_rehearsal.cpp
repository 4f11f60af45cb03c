#include "mpm_ros/aim/scene_rehearsal.hpp"

#include <algorithm>
#include <new>

#include "mpm/advice/coarser_scene.hpp"

namespace mpm_ros {

namespace {

using mpm::pace::Forecast;
using mpm::pace::Rehearsal;

constexpr double kLeastCoarser = 2.0, kMostCoarser = 4.0;  ///< times the cell
constexpr double kOfFirst = 0.4;                           ///< part of the budget
constexpr double kEnough = 0.5;  ///< part of the run that a rehearsal on finer cells has to reach
constexpr double kFiner = 0.8;   ///< times the cell before, at most, for another one

std::optional<Rehearsal> on_cells(const mpm::Scene& scene, double times, int threads, mpm::Isa isa, double budget,
                                  const std::function<bool()>& stop, bool with_tools) {
  const auto coarse = mpm::coarser_scene(scene, times);
  if (!coarse) return std::nullopt;
  try {
    return mpm::pace::rehearse(mpm::build(coarse->scene, nullptr, stop), coarse->times, threads, isa, budget, stop,
                               mpm::pace::steady_seconds, with_tools);
  } catch (const mpm::StoppedError&) {
    throw;
  } catch (const mpm::Error&) {
    return std::nullopt;  // a grid that this scene cannot have
  } catch (const std::bad_alloc&) {
    return std::nullopt;
  }
}

}  // namespace

std::optional<Rehearsal> rehearse_scene(const mpm::Scene& scene, const Forecast& timed, mpm::Isa isa, double budget,
                                        const std::function<bool()>& stop, bool with_tools) {
  if (!(timed.simulated > 0.0)) return std::nullopt;
  const int axes = mpm::dimensions(scene.definition.geometry);
  const double seconds = timed.wall_seconds() / std::max(timed.cost.awake, 1e-3);  // all of it may wake
  double times = std::clamp(mpm::pace::cell_factor(seconds, budget, axes), kLeastCoarser, kMostCoarser);
  auto first =
      on_cells(scene, times, timed.threads, isa, (times > kLeastCoarser ? kOfFirst : 1.0) * budget, stop, with_tools);
  while (!first && times > kLeastCoarser) {  // bodies may be too small for so wide cells
    times = std::max(kLeastCoarser, kFiner * times);
    first = on_cells(scene, times, timed.threads, isa, budget, stop, with_tools);
  }
  if (!first || times == kLeastCoarser || first->reached < 1.0) return first;
  const double left = (budget - first->wall) / kEnough;
  const double finer = std::max(kLeastCoarser, times * mpm::pace::cell_factor(first->wall, left, axes));
  if (finer > kFiner * times) return first;
  auto second = on_cells(scene, finer, timed.threads, isa, budget - first->wall, stop, with_tools);
  if (!second || second->reached < kEnough) return first;
  second->awake = mpm::pace::awake_by(*first, *second, axes);
  return second;
}

}  // namespace mpm_ros
