#include "mpm_ros/run/run.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

namespace mpm_ros {

Run::Run(const mpm::Scene& scene, const RunOptions& options, const Stamps& stamps, MessageSink* live)
    : scene_(scene),
      parameters_(options.parameters),
      stamps_(stamps),
      simulation_(mpm::build(scene), mpm::SimulationOptions{options.threads,
                                                            mpm::choose_isa(options.isa),
                                                            options.resume.empty(),
                                                            {},
                                                            options.stop,
                                                            options.settling}),
      end_(std::llround(scene.definition.time.end * 1e9)),
      outputs_(simulation_, stamps_, options.output) {
  if (!options.resume.empty()) {
    const mpm::SerialiseMore both = [&](mpm::StateArchive& archive) { serialise(archive, options.more); };
    from_ = mpm::load_checkpoint(options.resume, simulation_, scene.text, both).time;
    resumed_ = true;
  }
  // After it: a checkpoint that does not fit leaves no bag behind.
  if (!options.bag.empty()) recorder_ = std::make_unique<BagRecorder>(options.bag, options.bag_options);
  if (recorder_) outputs_.add(*recorder_);
  if (live != nullptr) outputs_.add(*live);
}

void Run::begin() {
  const RunInfo info = run_info(scene_, simulation_, stamps_, parameters_);
  if (resumed_) {
    outputs_.begin_again(info);
  } else {
    outputs_.begin(info);
  }
  if (recorder_) recorder_->sync_point();
  resume_clock();
}

// What the node keeps beside is there when the node has saved; run_scene has no commands that could wait.
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
  std::uint64_t waiting = 0, goals = 0;
  archive.value("queue/waiting/rows", waiting);
  archive.value("limiter/goals/rows", goals);
  if (waiting + goals > 0) {
    throw mpm::CheckpointError(
        fmt::format("the checkpoint has {} commands that wait for their time or are under way within limits, which the "
                    "node alone can give: resume it there, _resume:=FILE",
                    waiting + goals));
  }
}

mpm::CheckpointAbout Run::save(const std::string& path, const mpm::SerialiseMore& more, const std::string& failure) {
  return mpm::save_checkpoint(path, simulation_,
                              {std::filesystem::absolute(scene_.path).string(), scene_.text, failure},
                              [&](mpm::StateArchive& archive) { serialise(archive, more); });
}

void Run::apply(const AppliedCommand& command) {
  mpm_ros::apply(command, simulation_);
  outputs_.command(command);
}

void Run::advance() {
  try {
    simulation_.advance();
  } catch (const mpm::StoppedError&) {
    cut_short_ = true;
    throw;
  }
  const auto now = std::chrono::steady_clock::now();
  wall_ += now - clock_;
  clock_ = now;
  outputs_.sync(ended(), real_time_factor());
  if (recorder_) recorder_->sync_point();
}

double Run::real_time_factor() const {
  const double wall = std::chrono::duration<double>(wall_).count();
  return wall > 0.0 ? static_cast<double>(simulation_.time() - from_) * 1e-9 / wall : 0.0;
}

std::string Run::bag() const {
  if (!recorder_) return {};
  return recorder_->parts() == 1 ? recorder_->path()
                                 : fmt::format("{} and {} more parts", recorder_->path(), recorder_->parts() - 1);
}

void Run::finish() { close({}); }

void Run::fail(const std::string& reason) { close(reason); }

void Run::close(const std::string& failure) {
  if (closed_) return;
  closed_ = true;
  // Between two sync points there is no state that could be written.
  if (!cut_short_) outputs_.finish(real_time_factor(), failure);
  if (recorder_) recorder_->close();
}

}  // namespace mpm_ros
