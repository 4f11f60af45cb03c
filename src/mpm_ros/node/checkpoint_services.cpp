// Checkpoints of the node: the services that save and load one, what the node has to remember beside the run, and the
// state that a failed run leaves.
#include <fmt/format.h>
#include <ros/console.h>

#include <algorithm>
#include <filesystem>

#include "mpm_ros/message/conversions.hpp"
#include "mpm_ros/node/node_run.hpp"
#include "mpm_ros/node/simulator_node.hpp"
#include "mpm_ros/record/output_names.hpp"
#include "mpm_ros/run/run_scene_checkpoint.hpp"

namespace mpm_ros {

namespace {

std::string from_root(const std::string& path) {
  return std::filesystem::path(absolute_path(path)).lexically_normal().string();
}

std::int64_t nanoseconds(const ros::Time& time) { return static_cast<std::int64_t>(time.toNSec()); }

}  // namespace

bool SimulatorNode::on_save_checkpoint(Checkpoint::Request& request, Checkpoint::Response& response) {
  hand_over([&] { save_checkpoint(request.path, response); }, response.message);
  return true;
}

bool SimulatorNode::on_load_checkpoint(Checkpoint::Request& request, Checkpoint::Response& response) {
  hand_over([&] { load_checkpoint(request.path, response); }, response.message);
  return true;
}

void SimulatorNode::save_checkpoint(const std::string& path, Checkpoint::Response& response) {
  response.success = 0;
  try {
    if (path.empty()) throw mpm::CheckpointError("path is empty; name a file, such as run.h5");
    if (!failure_.empty()) throw mpm::CheckpointError("the run has failed and cannot go on: " + failure_);
    files_of(parameters_, subject_->scene, run_->recorder() != nullptr ? run_->recorder()->path() : "")
        .writes("path", path);
    const mpm::CheckpointAbout about =
        run_->save(path, [this](mpm::StateArchive& archive) { commands_.serialise(archive); });
    response.state_hash = hash_text(about.state_hash);
    last_checkpoint_ = from_root(path);
  } catch (const std::exception& error) {
    response.message = refusal_of(error);
    return;
  }
  run_->resume_clock();
  pacer_->restart(Pacer::Clock::now());
  response.success = 1;
  response.path = from_root(path);
  response.stamp = run_->outputs().stamp();
  response.time = mpm::seconds_of(run_->simulation().time());
  response.message = fmt::format("saved at {:.6f} s (simulated)", response.time);
}

// Stamps go on from those of the run that is there, and without use_sim_time from the wall's.
Stamps SimulatorNode::stamps_from(std::int64_t time) const {
  std::int64_t origin = 0;
  if (run_) {
    const std::int64_t next = run_->simulation().time() + run_->simulation().sync_period();
    origin = std::max(nanoseconds(run_->stamps().origin()), nanoseconds(run_->stamps().at(next)) - time);
  }
  if (!ros::Time::isSimTime()) origin = std::max(origin, nanoseconds(first_stamps().origin()) - time);
  ros::Time stamp;
  stamp.fromNSec(static_cast<std::uint64_t>(origin));
  return Stamps(stamp);
}

void SimulatorNode::load_checkpoint(const std::string& path, Checkpoint::Response& response) {
  response.success = 0;
  try {
    const mpm::CheckpointAbout about = mpm::read_checkpoint(path);
    start_run(subject_of(path), stamps_from(about.time), path);
    response.state_hash = hash_text(about.state_hash);
  } catch (const std::exception& error) {
    // A file that does not fit, a bag that cannot be opened, or memory: the run goes on as it was.
    response.message = refusal_of(error);
    return;
  }
  begin_run();
  response.success = failure_.empty() ? 1 : 0;
  response.path = from_root(path);
  response.stamp = run_->outputs().stamp();
  response.time = mpm::seconds_of(run_->simulation().time());
  response.message = fmt::format("run {}: goes on from {:.6f} s (simulated), at stamp {}.{:09d}", runs_, response.time,
                                 response.stamp.sec, response.stamp.nsec);
  if (!failure_.empty()) response.message = failure_;
}

void SimulatorNode::leave_failed_state() {
  if (run_->state_lost()) ROS_ERROR_STREAM(after_loss(last_checkpoint_, "_resume:=FILE, or load_checkpoint"));
  if (!parameters_.checkpoint_on_failure || run_->state_lost()) return;
  try {
    const std::filesystem::path bag(run_->recorder() != nullptr ? run_->recorder()->path() : "");
    const std::filesystem::path folder = bag.parent_path();
    const std::string name = bag.empty() ? subject_->scene.definition.name : bag.stem().string();
    const std::string path = from_root((folder / (name + "_failed.h5")).string());
    run_->save(
        path, [this](mpm::StateArchive& archive) { commands_.serialise(archive); }, failure_);
    ROS_INFO_STREAM("the state of the failure is in " << path);
  } catch (const std::exception& error) {
    ROS_ERROR_STREAM("the state of the failure is not saved: " << error.what());
  }
}

}  // namespace mpm_ros
