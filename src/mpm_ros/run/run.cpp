#include "mpm_ros/run/run.hpp"

#include <fmt/format.h>

#include <cmath>

namespace mpm_ros {

Run::Run(const mpm::Scene& scene, const RunOptions& options, const Stamps& stamps, MessageSink* live)
    : scene_(scene),
      parameters_(options.parameters),
      stamps_(stamps),
      simulation_(mpm::build(scene), mpm::SimulationOptions{options.threads, mpm::choose_isa(options.isa)}),
      end_(std::llround(scene.definition.time.end * 1e9)),
      recorder_(options.bag.empty() ? nullptr : std::make_unique<BagRecorder>(options.bag, options.bag_options)),
      outputs_(simulation_, stamps_, options.output) {
  if (recorder_) outputs_.add(*recorder_);
  if (live != nullptr) outputs_.add(*live);
}

void Run::begin() {
  outputs_.begin(run_info(scene_, simulation_, stamps_, parameters_));
  if (recorder_) recorder_->sync_point();
  resume_clock();
}

void Run::apply(const AppliedCommand& command) {
  mpm_ros::apply(command, simulation_);
  outputs_.command(command);
}

void Run::advance() {
  simulation_.advance();
  const auto now = std::chrono::steady_clock::now();
  wall_ += now - clock_;
  clock_ = now;
  outputs_.sync(ended(), real_time_factor());
  if (recorder_) recorder_->sync_point();
}

double Run::real_time_factor() const {
  const double wall = std::chrono::duration<double>(wall_).count();
  return wall > 0.0 ? static_cast<double>(simulation_.time()) * 1e-9 / wall : 0.0;
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
  outputs_.finish(real_time_factor(), failure);
  if (recorder_) recorder_->close();
}

}  // namespace mpm_ros
