#include "mpm_ros/aim/aim.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "mpm/advice/feasible.hpp"
#include "mpm/advice/target_choice.hpp"
#include "mpm/advice/target_half.hpp"
#include "mpm/advice/target_record.hpp"
#include "mpm/advice/tool_motion.hpp"
#include "mpm/pace/forecast.hpp"
#include "mpm/pace/target.hpp"
#include "mpm/simulation/rank_failure.hpp"
#include "mpm_ros/aim/judged_tools.hpp"
#include "mpm_ros/aim/scene_rehearsal.hpp"
#include "mpm_ros/aim/timing.hpp"

namespace mpm_ros {

namespace {

using mpm::pace::Candidate;
using mpm::pace::Discretisation;
using mpm::pace::Forecast;
using mpm::pace::Target;

constexpr double kFewParticles = 200'000.0;  ///< that a copy which is timed has at most
constexpr double kShort = 0.12;              ///< [s] of timing each copy
constexpr double kLong = 0.6;                ///< [s] of the rehearsal
constexpr int kMostTries = 5;                ///< candidates that are timed before one is taken as it is

constexpr int kMostAlong = 5;       ///< particles along a cell's edge that a table may have figures for
constexpr double kManyCells = 1e9;  ///< across a tool, for which there are figures if there are any

std::string percent_text(double part) { return fmt::format("{:.2g} %", 100.0 * part); }

/// Advice on how to run with `lines` in place of a target.
std::string repeat_text(const std::vector<std::string>& lines) {
  std::string text = "leave 'target' out of the scene";
  if (!lines.empty()) text += " and write";
  for (const std::string& line : lines) text += fmt::format(" --set \"{}\"", line);
  return text;
}

/// The choice of one scene.
class Chooser {
 public:
  /// @param before lines that are set in the scene already
  Chooser(const mpm::Scene& scene, std::vector<std::string> before, int threads, mpm::Isa isa,
          const std::function<bool()>& stop, mpm::Communicator* ranks)
      : scene_(scene),
        before_(std::move(before)),
        target_(*scene.target),
        geometry_(scene.definition.geometry),
        own_(mpm::pace::discretisation_of(scene.definition)),
        errors_(mpm::load_force_errors(scene)),
        fitting_(mpm::fitting_cells(scene)),
        isa_(isa),
        stop_(stop),
        timing_(threads, isa, stop, ranks) {}

  Aim aim() {
    calibrate();
    tools_ = judged_tools(scene_, rehearsal_, errors_);
    if (!tools_.unknown.empty()) target_.most_error = std::numeric_limits<double>::infinity();
    candidates_ = mpm::pace::candidates(target_, tools_.all, fitting_, scene_.definition, errors_, costs_);
    std::size_t chosen = 0;
    for (int tries = 0;; ++tries) {
      if (candidates_.empty()) fail();
      chosen = mpm::pace::choose(target_, candidates_);
      if (candidates_[chosen].timed || tries == kMostTries) break;
      time(chosen);
    }
    return tell(candidates_[chosen]);
  }

 private:
  /// Throws, with the reason why there is no candidate.
  [[noreturn]] void fail() const {
    if (left_out_) {
      throw mpm::SceneError(fmt::format(
          "{}: target: no choice that there are figures for could be run; run the scene without target to see why",
          scene_.path));
    }
    std::vector<int> known;
    for (int along = 1; along <= kMostAlong; ++along) {
      Discretisation fine = own_;
      fine.along = along;
      mpm::pace::ToolInGround wide = tools_.all.front();
      wide.length = kManyCells * own_.cell.maxCoeff();
      if (errors_.of(fine, wide, geometry_)) known.push_back(along);
    }
    const bool has_figures = std::any_of(fitting_.begin(), fitting_.end(), [&](const auto& pair) {
      if (target_.keeps("grid.cell") && pair.first != own_.cell) return false;
      if (target_.keeps("method.particles_per_cell") && pair.second != own_.along) return false;
      return std::find(known.begin(), known.end(), pair.second) != known.end();
    });
    if (!has_figures) {
      std::vector<std::string> numbers;
      for (const int along : known) numbers.push_back(std::to_string(in_a_cell(along)));
      throw mpm::SceneError(
          fmt::format("{}: target: there are no figures for {} particles a cell, only for {}; write such a number as "
                      "method.particles_per_cell{}, or leave target out",
                      scene_.path, in_a_cell(own_.along), fmt::join(numbers, " and "),
                      target_.keep.empty() ? "" : ", or take keys out of target.keep"));
    }
    double least = tools_.all.front().length;
    for (const mpm::pace::ToolInGround& tool : tools_.all) least = std::min(least, tool.length);
    throw mpm::SceneError(
        fmt::format("{}: target: there are no figures for {:.2g} cells across {:.3g} m of tool, with a cell that fits "
                    "the grid and the bodies; leave target out, use a smaller grid.cell, or write target.length",
                    scene_.path, least / own_.cell.maxCoeff(), least));
  }

  int in_a_cell(int along) const {
    int count = 1;
    for (int axis = 0; axis < mpm::dimensions(geometry_); ++axis) count *= along;
    return count;
  }

  std::vector<std::string> lines_of(const Discretisation& one) const {
    std::vector<std::string> lines = before_;
    const std::vector<std::string> more = mpm::pace::set_lines(one, own_, geometry_);
    lines.insert(lines.end(), more.begin(), more.end());
    return lines;
  }

  mpm::Scene with(const Discretisation& one) const { return mpm::with_chosen(scene_, lines_of(one), 1.0, 1.0); }

  double particles(const Discretisation& one) const {
    double count = mpm::expected_particles(scene_);
    for (const int axis : mpm::axes_of(geometry_)) {
      count *= own_.cell[axis] / one.cell[axis] * static_cast<double>(one.along) / static_cast<double>(own_.along);
    }
    return count;
  }

  /// Own particles a cell, the finest cell that has few enough particles, or the coarsest there is.
  Discretisation affordable() const {
    Discretisation best = own_;
    if (particles(best) <= kFewParticles) return best;
    for (const auto& [cell, along] : fitting_) {
      Discretisation one = own_;
      one.cell = cell;
      if (along == own_.along && particles(one) < particles(best) &&
          (particles(best) > kFewParticles || particles(one) > particles(best)))
        best = one;
    }
    return best;
  }

  void calibrate() {
    costs_.base = affordable();
    costs_.geometry = geometry_;
    const mpm::Scene scene = with(costs_.base);
    const auto usual = timing_.of(scene, kShort);
    if (!usual) {
      throw mpm::SceneError(fmt::format(
          "{}: target: not one step of the scene could be timed; run it without target to see why", scene_.path));
    }
    costs_.particles = static_cast<double>(usual->particles);
    costs_.sync = mpm::seconds_of(scene.definition.time.sync);
    costs_.step = scene.definition.time.step;
    for (const mpm::RigidBodyDefinition& body : scene.definition.rigid_bodies)
      costs_.fastest = std::max(costs_.fastest, mpm::tool_motion(body, scene.definition).fastest);
    costs_.wave_time = mpm::wave_step(scene).dt / scene.definition.time.cfl;  // infinite with implicit steps
    rehearsal_ = rehearse_scene(scene, *usual, isa_, kLong, stop_, true);
    const double own = seconds_of(*usual);
    const Discretisation base = costs_.base;
    const mpm::pace::ForceErrors& errors = errors_;
    std::map<std::pair<int, int>, double> timed;
    const auto place = [](mpm::Precision precision, mpm::UpdateScheme update) {
      return std::pair(static_cast<int>(precision), static_cast<int>(update));
    };
    timed[place(base.precision, base.update)] = own;
    std::vector<mpm::UpdateScheme> updates = {mpm::UpdateScheme::usavg, mpm::UpdateScheme::usf};
    if (own_.implicit()) updates = {own_.update};
    for (const mpm::Precision precision : {mpm::Precision::float64, mpm::Precision::float32}) {
      for (const mpm::UpdateScheme update : updates) {
        if (target_.keeps("method.precision") && precision != own_.precision) continue;
        if (target_.keeps("method.update") && update != own_.update) continue;
        if (timed.count(place(precision, update)) > 0) continue;
        Discretisation other = base;
        other.precision = precision;
        other.update = update;
        if (const auto forecast = time_variant(other)) timed[place(precision, update)] = seconds_of(*forecast);
      }
    }
    costs_.particle_step = [=](mpm::Precision precision, mpm::UpdateScheme update) {
      const auto found = timed.find(place(precision, update));
      if (found != timed.end()) return found->second;
      return own * errors.cost_factor(precision, update) / errors.cost_factor(base.precision, base.update);
    };
  }

  std::optional<Forecast> time_variant(const Discretisation& one) {
    try {
      return timing_.of(with(one), kShort);
    } catch (const mpm::SceneError&) {
      return std::nullopt;  // a method that there is not
    }
  }

  /// Cost of a particle's step, such that StepCosts::pace() gives the pace that is expected of the whole run [s].
  double seconds_of(const Forecast& forecast) const {
    return costs_.sync / (costs_.steps(costs_.base) * static_cast<double>(forecast.particles) * pace_of(forecast));
  }

  /// The pace that is expected of the whole run.
  double pace_of(Forecast forecast) const {
    if (rehearsal_ && forecast.cost.rehearsed == 0.0 && !forecast.of_run())
      forecast.cost = mpm::pace::of_whole_run(forecast.cost, *rehearsal_, forecast.particles);
    return forecast.real_time_factor();
  }

  /// Times a candidate. Others on the same grid are expected to differ from the arithmetic as it does; one that cannot
  /// be run, or timed, is left out.
  void time(std::size_t chosen) {
    const Candidate one = candidates_[chosen];
    if (particles(one.what) > kFewParticles) {
      candidates_[chosen].timed = true;  // too large for a copy; its pace stays that of the arithmetic
      return;
    }
    const auto forecast = time_variant(one.what);
    if (!forecast) {
      candidates_.erase(candidates_.begin() + static_cast<std::ptrdiff_t>(chosen));
      left_out_ = true;
      return;
    }
    const double pace = pace_of(*forecast);
    for (Candidate& other : candidates_) {
      if (!other.timed && other.what.cell == one.what.cell && other.what.along == one.what.along)
        other.pace *= pace / one.pace;
    }
    candidates_[chosen].pace = pace;
    candidates_[chosen].timed = true;
  }

  Aim tell(const Candidate& chosen) const {
    const std::vector<std::string> lines = lines_of(chosen.what);
    const double error = chosen.error.total();
    Aim told;
    told.scene = mpm::with_chosen(scene_, lines, chosen.pace, tools_.unknown.empty() ? error : 0.0);
    told.scene.choices.emplace_back("target", fmt::format("{}: {}", mpm::pace::target_text(target_),
                                                          mpm::pace::discretisation_text(chosen.what, geometry_)));
    const auto part = [](const char* name, double value) { return fmt::format("{} {}", name, percent_text(value)); };
    const std::string parts =
        fmt::format("{}, {}, {}, {}", part("grid", chosen.error.grid), part("precision", chosen.error.precision),
                    part("update", chosen.error.update), part("step", chosen.error.step));
    told.news.push_back(fmt::format(
        "target {}: {}; {:.2g} of real time expected, with an error of the tool's force {}",
        mpm::pace::target_text(target_), mpm::pace::discretisation_text(chosen.what, geometry_), chosen.pace,
        tools_.unknown.empty()
            ? fmt::format("of {} at most ({}), counting cells across {}", percent_text(error), parts, tools_.text())
            : fmt::format("that is not known: none was measured for {}, and the choice is by those of "
                          "other tools",
                          tools_.unknown)));
    told.news.push_back(lines.empty() ? "the scene's own keys are the choice"
                                      : "to run the same without a target, " + repeat_text(lines));
    if (target_.symmetric)
      told.news.push_back("the half above the plane of symmetry is modelled: forces are those of the half");
    told.table = mpm::pace::candidates_table(candidates_, chosen, own_, geometry_);
    if (!mpm::pace::reaches(target_, chosen)) told.warnings.push_back(out_of_reach(chosen));
    return told;
  }

  std::string out_of_reach(const Candidate& chosen) const {
    const std::string begin =
        fmt::format("target {} is not in reach on this machine: {:.2g} of real time with an error {}",
                    mpm::pace::target_text(target_), chosen.pace,
                    tools_.unknown.empty() ? "of " + percent_text(chosen.error.total()) : "that is not known");
    if (!target_.real_time) {
      return begin + fmt::format(
                         " is the least that there are figures for; a smaller grid.cell that fits grid and bodies, or "
                         "a larger error, would be needed{}",
                         target_.keep.empty() ? "" : "; so would fewer keys in target.keep");
    }
    if (chosen.pace >= *target_.real_time)
      return begin + fmt::format(", without the {:.0f} % to spare that are asked of a choice",
                                 100.0 * (mpm::pace::kSpare - 1.0));
    // The least error among those that are fast enough.
    const Candidate* price = nullptr;
    for (const Candidate& one : candidates_) {
      const bool fast = one.pace >= mpm::pace::kSpare * *target_.real_time;
      if (fast && (price == nullptr || one.error.total() < price->error.total())) price = &one;
    }
    if (price == nullptr) {
      return begin +
             "; nothing that there are figures for is fast enough: give up a part of the pace, the grid or the "
             "bodies, or use more threads";
    }
    return begin + fmt::format("; {:.2g} would take an error of {}, more than the {} that a target accepts; for it, {}",
                               price->pace, percent_text(price->error.total()), percent_text(target_.most_error),
                               repeat_text(lines_of(price->what)));
  }

  const mpm::Scene& scene_;
  const std::vector<std::string> before_;
  Target target_;
  const mpm::GeometryKind geometry_;
  const Discretisation own_;
  const mpm::pace::ForceErrors errors_;
  const std::vector<std::pair<mpm::Vec3, int>> fitting_;
  const mpm::Isa isa_;
  const std::function<bool()>& stop_;
  Timing timing_;
  std::optional<mpm::pace::Rehearsal> rehearsal_;
  mpm::pace::StepCosts costs_;
  std::vector<Candidate> candidates_;
  JudgedTools tools_;
  bool left_out_ = false;  ///< true if a candidate could not be run
};

}  // namespace

Aim aim(mpm::Scene scene, int threads, mpm::Isa isa, const std::function<bool()>& stop, mpm::Communicator* ranks) {
  if (!scene.target) return {std::move(scene), {}, {}, {}};
  if (scene.target->chosen) {
    const Target& target = *scene.target;
    const std::string news = fmt::format(
        "target {}: as it was chosen before, {}", mpm::pace::target_text(target),
        target.chosen->empty() ? "the scene's own keys" : fmt::format("{}", fmt::join(*target.chosen, ", ")));
    return {std::move(scene), {news}, {}, {}};
  }
  std::vector<std::string> half;
  if (scene.target->symmetric) {
    half = mpm::half_lines(scene, *scene.target->symmetric);
    scene = mpm::with_chosen(scene, half, 1.0, 1.0);
  }
  return Chooser(scene, std::move(half), threads, isa, stop, ranks).aim();
}

Aim aim_together(mpm::Scene scene, int threads, mpm::Isa isa, const std::function<bool()>& stop,
                 mpm::Communicator* ranks) {
  if (ranks == nullptr || !scene.target || scene.target->chosen) return aim(std::move(scene), threads, isa, stop);
  if (!ranks->first()) {
    for (;;) {
      const Order order = hear(*ranks);
      const std::string what = order.at("do");
      if (what == "time") {
        time_as_told(*ranks, order);
        continue;
      }
      if (what == "stop") throw mpm::StoppedError(order.at("why").get<std::string>());
      if (what == "fail") throw mpm::SceneError(order.at("why").get<std::string>());
      Aim aim;
      aim.scene = mpm::parse_scene(order.at("scene"), order.at("path"));
      return aim;
    }
  }
  try {
    Aim chosen = aim(std::move(scene), threads, isa, stop, ranks);
    tell(*ranks, {{"do", "run"}, {"scene", chosen.scene.text}, {"path", chosen.scene.path}});
    return chosen;
  } catch (const mpm::RankFailure&) {
    throw;  // the others cannot be told
  } catch (const mpm::StoppedError& error) {
    tell(*ranks, {{"do", "stop"}, {"why", error.what()}});
    throw;
  } catch (const mpm::Error& error) {
    tell(*ranks, {{"do", "fail"}, {"why", error.what()}});
    throw;
  }
}

}  // namespace mpm_ros
