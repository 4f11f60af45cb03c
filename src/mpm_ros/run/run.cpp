#include "mpm_ros/run/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <nlohmann/json.hpp>
#include <utility>

#include "mpm/advice/feasible.hpp"
#include "mpm/advice/resumed_scene.hpp"
#include "mpm/implicit/sweep_momentum.hpp"
#include "mpm/math/json_text.hpp"
#include "mpm_ros/record/output_names.hpp"
#include "mpm_ros/record/together.hpp"
#include "mpm_ros/run/expected_pace.hpp"

namespace mpm_ros {
namespace {

constexpr double kWorthKeeping = 1.0;                  ///< [s] of a run: the cost of its steps serves forecasts
constexpr std::int64_t kJumpRemembered = 100'000'000;  ///< [ns] after a jump: a failure is told with it

/// Parameters with what the run has beside them.
std::string with_kind(std::string parameters, const mpm::Communicator* ranks, const std::string& device) {
  if (ranks != nullptr) parameters += fmt::format("\nranks: {}\n", ranks->size());
  if (!device.empty()) parameters += fmt::format("\nsteps_by: {}\n", mpm::json_text(nlohmann::json(device)));
  return parameters;
}

}  // namespace

Run::Run(const mpm::Scene& scene, const RunOptions& options, const Stamps& stamps, MessageSink* live) try
    : scene_(scene),
      threads_asked_(options.threads),
      stamps_(stamps),
      profile_(options.profile),
      simulation_(mpm::make_simulation(
          options.device, [&] { return mpm::build(scene, options.ranks.get(), options.stop); },
          mpm::SimulationOptions{options.threads,
                                 mpm::choose_isa(options.isa),
                                 options.resume.empty(),
                                 {},
                                 options.stop,
                                 options.settling,
                                 options.ranks,
                                 options.stop,
                                 options.profile},
          steps_by_)),
      parameters_(with_kind(options.parameters, options.ranks.get(), steps_by_.device)),
      end_(mpm::nanoseconds_of(scene.definition.time.end)),
      outputs_(simulation_, stamps_, options.output),
      places_(scene.definition.rigid_bodies.size(), Place::outside_yet),
      slowest_wave_(mpm::slowest_wave(scene)),
      told_of_speed_(scene.definition.rigid_bodies.size(), false) {
  if (!options.resume.empty()) {
    const mpm::SerialiseMore both = [&](mpm::StateArchive& archive) { serialise(archive, options.more); };
    const auto difference = [&](const std::string& recorded) { return mpm::resumed_difference(scene, recorded); };
    from_ = mpm::load_checkpoint(options.resume, simulation_, scene.text, both, difference).time;
    outputs_.check_fields(options.resume);
    resumed_ = true;
    for (const mpm::CrackTipReport& tip : simulation_.crack_tips()) told_of_tips_.push_back({!tip.has_j, tip.stopped});
  }
  // After it: a checkpoint that does not fit leaves no bag behind.
  together<BagError>(options.ranks.get(), [&] {
    if (!options.bag.empty()) recorder_ = std::make_unique<BagRecorder>(options.bag, options.bag_options);
  });
  if (recorder_) outputs_.add(*recorder_);
  if (live != nullptr) outputs_.add(*live);
} catch (const std::bad_alloc&) {
  throw mpm::SceneError(mpm::lack_of_memory(scene));
}

void Run::begin() {
  const RunInfo info = run_info(scene_, simulation_, stamps_, parameters_);
  if (resumed_) {
    outputs_.begin_again(info);
  } else {
    outputs_.begin(info);
  }
  close_part();
  resume_clock();
}

// Data that the node keeps beside are there if the node has saved; run_scene has no commands that could wait.
void Run::serialise(mpm::StateArchive& archive, const mpm::SerialiseMore& more) {
  {
    const mpm::StateArchive::Group group(archive, "outputs");
    outputs_.serialise(archive);
  }
  bool commanded = static_cast<bool>(more);
  archive.value("commanded", commanded);
  if (!commanded) return;
  if (more) {
    more(archive);
    return;
  }
  std::uint64_t waiting = 0, goals = 0, turning = 0, joints = 0;
  archive.value("queue/waiting/rows", waiting);
  archive.value("limiter/goals/rows", goals);
  archive.value("turning/held/rows", turning);
  archive.value("joints/count", joints);
  if (const std::uint64_t commands = waiting + goals + turning + joints; commands > 0) {
    throw mpm::CheckpointError(
        fmt::format("the checkpoint has {} commands that wait for their time, are under way within limits or turn with "
                    "their body, which the node alone can give: resume it there, _resume:=FILE",
                    commands));
  }
}

mpm::CheckpointAbout Run::save(const std::string& path, const mpm::SerialiseMore& more, const std::string& failure) {
  if (cut_short_) {
    throw mpm::CheckpointError(fmt::format(
        "checkpoint {}: not written, since the run was stopped between two sync points, where no run can go "
        "on; save earlier, or shorten time.sync",
        path));
  }
  return mpm::save_checkpoint(path, simulation_, {absolute_path(scene_.path), scene_.text, failure},
                              [&](mpm::StateArchive& archive) { serialise(archive, more); });
}

void Run::apply(const AppliedCommand& command) {
  std::string jump = jump_of(command, simulation_);
  mpm_ros::apply(command, simulation_);
  if (!jump.empty()) jump_ = {std::move(jump), command.arrival};
  outputs_.command(command);
}

void Run::apply(const JointOrder& order, bool again) {
  if (again) {
    apply_again(order, simulation_);
    outputs_.command(order);
  } else {
    outputs_.command(mpm_ros::apply(order, simulation_));
  }
}

void Run::set_state(const mpm::StateSet& state) {
  simulation_.set_state(state);
  outputs_.state_set(state);
}

void Run::advance(std::chrono::steady_clock::duration late) {
  try {
    simulation_.advance(late);
  } catch (const mpm::StoppedError&) {
    cut_short_ = true;
    throw;
  } catch (const mpm::PhysicsError& error) {
    if (jump_.what.empty() || simulation_.time() > jump_.arrival + kJumpRemembered) throw;
    throw mpm::PhysicsError(fmt::format("{}; it follows a jump: {}", error.what(), jump_.what));
  }
  const mpm::TimeProfile::Use use(profile_);
  mpm::timed("run: looks for warnings", [this] {
    look_for_lost_bodies();
    look_for_fast_bodies();
    look_for_lost_tips();
    look_for_soft_sweeps();
  });
  if (simulation_.budget() != nullptr) budget_watch_.look(*simulation_.budget(), simulation_.time(), warnings_);
  const auto now = std::chrono::steady_clock::now();
  wall_ += now - clock_;
  clock_ = now;
  const mpm::TimeProfile::Part part("run: outputs");
  outputs_.sync(ended(), real_time_factor());
  close_part();
}

void Run::close_part() {
  together<BagError>(simulation_.ranks(), [this] {
    if (recorder_) recorder_->sync_point();
  });
}

bool Run::outside(const mpm::RigidBody& body) const {
  const mpm::GridDefinition& grid = simulation_.definition().grid;
  const mpm::Box bounds = body.surface().bounds();
  mpm::Vec3 corner = bounds.min.cwiseAbs().cwiseMax(bounds.max.cwiseAbs());
  std::array<bool, 3> counts{true, true, true};
  for (const int axis : mpm::axes_beside(simulation_.definition().geometry)) {
    counts[static_cast<std::size_t>(axis)] = false;
    corner[axis] = 0.0;
  }
  const double reach = corner.norm();
  if (!std::isfinite(reach)) return false;
  for (int axis = 0; axis < 3; ++axis) {
    const double at = body.pose().position[axis];
    if (counts[static_cast<std::size_t>(axis)] && (at + reach < grid.min[axis] || at - reach > grid.max[axis]))
      return true;
  }
  return false;
}

// Told once, and only of a body that was in the grid: others wait beside it for their time.
void Run::look_for_lost_bodies() {
  for (std::size_t b = 0; b < places_.size(); ++b) {
    if (places_[b] == Place::lost) continue;
    const mpm::RigidBody& body = simulation_.rigid_body(static_cast<int>(b));
    if (!outside(body)) {
      places_[b] = Place::inside;
    } else if (places_[b] == Place::inside) {
      places_[b] = Place::lost;
      const mpm::Vec3 at = body.pose().position;
      warnings_.push_back(
          fmt::format("rigid body '{}' has left the grid at t = {:.6g} s: it is at ({:.3g}, {:.3g}, {:.3g}) m, where "
                      "nothing touches it; end the run before, or enlarge grid.min/grid.max and what it rests on",
                      body.name(), mpm::seconds_of(simulation_.time()), at.x(), at.y(), at.z()));
    }
  }
}

// Each told once. Of what the scene prescribes the scene's own warnings tell.
void Run::look_for_fast_bodies() {
  for (std::size_t b = 0; b < told_of_speed_.size(); ++b) {
    if (told_of_speed_[b]) continue;
    const mpm::RigidBody& body = simulation_.rigid_body(static_cast<int>(b));
    const double speed = body.twist().linear.norm();
    if (body.drive() == mpm::Drive::functions || !(speed > slowest_wave_.speed)) continue;
    told_of_speed_[b] = true;
    warnings_.push_back(mpm::faster_than_waves(body.name(), speed, slowest_wave_));
  }
}

// Each told once.
void Run::look_for_lost_tips() {
  if (!simulation_.definition().cracks.any()) return;
  const std::vector<mpm::CrackTipReport> tips = simulation_.crack_tips();
  told_of_tips_.resize(tips.size());
  const double time = mpm::seconds_of(simulation_.time());
  for (std::size_t t = 0; t < tips.size(); ++t) {
    const mpm::CrackTipReport& tip = tips[t];
    ToldOfTip& told = told_of_tips_[t];
    const std::string which = fmt::format("crack '{}', {}: ", tip.crack, tip.end);
    if (tip.stopped && !std::exchange(told.stopped, true)) {
      warnings_.push_back(fmt::format("{}grows no more from t = {:.6g} s on, for {}", which, time, tip.growth));
    }
    if (!tip.stopped && !tip.has_j && !std::exchange(told.no_j, true)) {
      warnings_.push_back(fmt::format(
          "{}J cannot be found at t = {:.6g} s, for {}; a tip whose criterion needs J rests until it is found again: "
          "write a smaller cracks.contour: {{size}} or a finer grid",
          which, time, tip.state));
    }
  }
}

// Told once.
void Run::look_for_soft_sweeps() {
  if (told_of_sweeps_ || simulation_.definition().method.update != mpm::UpdateScheme::implicit) return;
  const std::vector<mpm::NamedNumber> numbers = simulation_.numbers();
  const auto load = std::find_if(numbers.begin(), numbers.end(), [](const auto& n) { return n.name == "sweep_load"; });
  if (load == numbers.end() || !(load->value > mpm::kMostSweepLoad)) return;
  told_of_sweeps_ = true;
  warnings_.push_back(fmt::format(
      "at t = {:.6g} s the pressure on a tool has come to 1/{:.2g} of the modulus that the sweeps of a step resolve; "
      "above 1/{:.2g} the force on it is too small: leave method.sweeps out, write a longer time.budget where that "
      "ends sweeps, or a shorter time.step",
      mpm::seconds_of(simulation_.time()), 1.0 / load->value, 1.0 / mpm::kMostSweepLoad));
}

std::vector<std::string> Run::take_warnings() { return std::exchange(warnings_, {}); }

double Run::real_time_factor() const {
  const double wall = std::chrono::duration<double>(wall_).count();
  return wall > 0.0 ? mpm::seconds_of(simulation_.time() - from_) / wall : 0.0;
}

std::string Run::bag() const {
  if (!recorder_) return {};
  return recorder_->parts() == 1 ? recorder_->path()
                                 : fmt::format("{} and {} more parts", recorder_->path(), recorder_->parts() - 1);
}

void Run::finish() {
  if (!closed_ && !cut_short_ && !steps_by_.device.empty()) simulation_.state();  // throws where it is lost
  close({});
}

void Run::fail(const std::string& reason) {
  try {
    if (!closed_ && !steps_by_.device.empty()) simulation_.state();
  } catch (const mpm::PhysicsError&) {
    state_lost_ = true;  // the reason is that, or what comes of it
  }
  close(reason);
}

void Run::close_record() {
  if (closed_) return;
  closed_ = true;
  if (recorder_) recorder_->close();
}

void Run::close(const std::string& failure) {
  if (closed_) return;
  closed_ = true;
  // Between two sync points there is no state that could be written.
  if (state_lost_) {
    outputs_.fail_unread(failure);
  } else if (!cut_short_) {
    outputs_.finish(real_time_factor(), failure);
  }
  together<BagError>(simulation_.ranks(), [this] {
    if (recorder_) recorder_->close();
  });
  const bool here = simulation_.ranks() == nullptr && steps_by_.device.empty();
  const bool whole = !resumed_ && !cut_short_ && failure.empty() && here;
  if (whole && wall_seconds() >= kWorthKeeping) keep_reached_pace(scene_, threads_asked_, simulation_);
}

}  // namespace mpm_ros
