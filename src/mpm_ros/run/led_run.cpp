#include "mpm_ros/run/led_run.hpp"

#include <fmt/format.h>

#include <utility>

#include "mpm/simulation/rank_failure.hpp"
#include "mpm_ranks/make_ranks.hpp"
#include "mpm_ros/record/output_names.hpp"
#include "mpm_ros/run/follow.hpp"

namespace mpm_ros {

bool is_alike(const std::exception& error) {
  return dynamic_cast<const mpm::StoppedError*>(&error) != nullptr ||
         dynamic_cast<const mpm::PhysicsError*>(&error) != nullptr ||
         dynamic_cast<const mpm::CheckpointError*>(&error) != nullptr ||
         dynamic_cast<const mpm::RigidError*>(&error) != nullptr || dynamic_cast<const BagError*>(&error) != nullptr;
}

std::unique_ptr<Run> make_run(const mpm::Scene& scene, const RunOptions& options, const Stamps& stamps,
                              MessageSink* live) {
  if (!options.ranks) return std::make_unique<Run>(scene, options, stamps, live);
  static int led = 0;
  const int number = ++led;
  mpm_ros::tell(*options.ranks, order_to_make(scene, options, stamps, number));
  try {
    return std::unique_ptr<Run>(new LedRun(scene, options, stamps, live, number));
  } catch (const std::exception& error) {
    mpm::fail_alike(*options.ranks, error.what(), exit_code_of(error));
    throw;
  }
}

LedRun::LedRun(const mpm::Scene& scene, const RunOptions& options, const Stamps& stamps, MessageSink* live, int number)
    : Run(scene, options, stamps, live), number_(number) {}

void LedRun::tell(const std::string& what, Order order) {
  if (parted_) throw mpm::RankFailure("the ranks have parted, and can do nothing more together");
  order["do"] = what;
  order["run"] = number_;
  if (!commands_.empty()) order["commands"] = packed(std::exchange(commands_, {}));
  mpm_ros::tell(*simulation().ranks(), order);
}

template <class Work>
void LedRun::with_others(const Work& work) {
  try {
    work();
  } catch (const std::exception& error) {
    if (is_alike(error)) throw;
    parted_ = true;
    throw mpm::RankFailure(error.what());
  }
}

void LedRun::begin() {
  tell("begin");
  with_others([this] { Run::begin(); });
}

mpm::CheckpointAbout LedRun::save(const std::string& path, const mpm::SerialiseMore& more, const std::string& failure) {
  tell("save", {{"path", absolute_path(path)}, {"failure", failure}});
  mpm::CheckpointAbout about;
  with_others([&] { about = Run::save(path, more, failure); });
  return about;
}

void LedRun::apply(const AppliedCommand& command) {
  Run::apply(command);
  const std::string& body = simulation().rigid_body(command.body).name();
  commands_.push_back(to_message(command, body, {}, stamps()));
}

void LedRun::set_state(const mpm::StateSet& state) {
  tell("set_state", {{"state", packed(to_message(state, simulation().time(), {}, stamps()))}});
  with_others([&] { Run::set_state(state); });
}

// Without the delay: the budget of sweeps that it shortens belongs to implicit steps, which one process makes.
void LedRun::advance(std::chrono::steady_clock::duration) {
  tell("advance");
  with_others([this] { Run::advance({}); });
}

void LedRun::finish() {
  if (closed()) return;
  if (parted_) return close_record();
  tell("finish");
  with_others([this] { Run::finish(); });
}

void LedRun::fail(const std::string& reason) {
  if (closed()) return;
  if (parted_) return close_record();
  tell("fail", {{"reason", reason}});
  with_others([&] { Run::fail(reason); });
}

}  // namespace mpm_ros
