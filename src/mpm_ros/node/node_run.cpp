#include "mpm_ros/node/node_run.hpp"

#include <fmt/format.h>
#include <ros/time.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "mpm/math/json_text.hpp"
#include "mpm_ros/record/output_names.hpp"
#include "mpm_ros/run/run_files.hpp"

namespace mpm_ros {

namespace {

constexpr double kLivePeriod = 0.02;  ///< longest time between two clouds that nobody chose [s]: motion looks smooth

}  // namespace

RunOptions run_options(const mpm::Scene& scene, const NodeParameters& parameters, int number,
                       const std::string& topics_below, const std::vector<std::string>& set) {
  RunOptions options;
  options.threads = parameters.threads;
  options.isa = parameters.isa;
  options.device = parameters.device;
  options.output = output_options(scene);
  if (parameters.particle_rate) {
    options.output.particle_period = 1.0 / *parameters.particle_rate;
  } else if (scene.output.period_chosen) {  // by the length of the run, which says nothing about who watches it
    options.output.particle_period = std::min(options.output.particle_period, kLivePeriod);
  }
  if (parameters.particle_first) options.output.particle_first = *parameters.particle_first;
  if (parameters.particle_fields) options.output.particles.fields = *parameters.particle_fields;
  if (parameters.particle_stride) options.output.particles.choice.stride = *parameters.particle_stride;
  if (parameters.particle_region) options.output.particles.choice.region = *parameters.particle_region;
  if (parameters.wrench_rate > 0.0) options.output.wrench_period = 1.0 / parameters.wrench_rate;
  options.output.wrench_cutoff = parameters.wrench_cutoff;
  options.output.world_frame = parameters.world_frame;
  for (const mpm::CommandDefinition& commanded : scene.commands) options.output.others.push_back(commanded.frame);
  options.output.force_scale = parameters.force_scale;
  options.output.state_hash = parameters.state_hash;
  if (!parameters.record.empty())
    options.bag = bag_path(parameters.record, scene.definition.name, number, parameters.record_folder);
  options.bag_options.topics_below = topics_below;
  options.bag_options.compression = parameters.record_compression;
  constexpr double kMegabyte = 1e6;
  options.bag_options.split_size = static_cast<std::uint64_t>(std::min(parameters.record_split_size * kMegabyte, 1e15));
  options.bag_options.split_duration = mpm::nanoseconds_of(std::min(parameters.record_split_duration, 1e9));
  options.bag_options.required = parameters.record_required;
  options.parameters = parameters.text;
  if (!set.empty()) options.parameters += fmt::format("\nreset_with: {}", mpm::json_text(nlohmann::json(set)));
  return options;
}

mpm::FilesInUse files_of(const NodeParameters& parameters, const mpm::Scene& scene, const std::string& record) {
  mpm::FilesInUse files;
  reads_scene(scene, files);
  reads_bag("the bag of ~commands", parameters.commands, files);
  writes_bag("~record", record, files);
  return files;
}

void check(const NodeParameters& parameters, const RunOptions& options, const mpm::Scene& scene) {
  if (const std::string problem = problem_of(options.output.particles); !problem.empty()) {
    throw ParameterError(fmt::format("parameter ~particle_fields, ~particle_stride or ~particle_region: {}", problem));
  }
  try {
    mpm::FilesInUse files = files_of(parameters, scene, options.bag);
    files.writes("~resume", parameters.resume);  // as it may be, by save_checkpoint
  } catch (const mpm::FileInUse& error) {
    throw ParameterError(fmt::format("parameter {}", error.what()));
  }
  std::error_code ignored;
  if (!parameters.resume.empty() && std::filesystem::exists(options.bag, ignored))
    throw ParameterError(fmt::format("parameter ~record: {} holds the run so far; choose another name", options.bag));
  if (parameters.reset_time == ResetTime::zero && !ros::Time::isSimTime()) {
    throw ParameterError(
        "parameter ~reset_time is zero, but /use_sim_time is not set: the wall's clock cannot be set back");
  }
}

}  // namespace mpm_ros
