#include "mpm_ros/record/run_outputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "mpm/checkpoint/checkpoint.hpp"
#include "mpm/math/build_info.hpp"
#include "mpm_ros/message/conversions.hpp"
#include "mpm_ros/message/quantities.hpp"
#include "mpm_ros/message/topics.hpp"
#include "mpm_ros/record/output_names.hpp"
#include "mpm_ros/record/scene_files.hpp"

namespace mpm_ros {

namespace {

/// A period [s] as whole sync periods, at least one [ns].
std::int64_t in_syncs(double period, std::int64_t sync) {
  return sync * std::max<std::int64_t>(1, std::llround(period * mpm::kNanosecondsOfSecond / static_cast<double>(sync)));
}

ParticleSelection from_origin(ParticleSelection selection, const LocalFrame& frame) {
  selection.origin = frame.origin;
  return selection;
}

}  // namespace

OutputOptions output_options(const mpm::Scene& scene) {
  OutputOptions options;
  options.particles.fields = scene.output.particle_fields;
  options.particles.choice = {scene.output.particle_stride, scene.output.particle_region};
  options.global = scene.output.global;
  options.global_period = scene.output.global_period;
  options.ground = scene.output.ground;
  options.particle_period = scene.output.period;
  options.particle_first = scene.output.first;
  return options;
}

RunInfo run_info(const mpm::Scene& scene, const mpm::Simulation& simulation, const Stamps& stamps,
                 const std::string& parameters) {
  RunInfo info;
  info.header.stamp = stamps.at(simulation.time());
  info.scene = scene.definition.name;
  info.scene_text = scene.text;
  info.scene_path = absolute_path(scene.path);
  info.files = scene_files(scene.text, scene.path);
  info.isa = simulation.isa();
  info.sync_period = mpm::seconds_of(simulation.sync_period());
  info.start = stamps.origin();
  info.version = mpm::build_version();
  info.parameters = parameters;
  return info;
}

RunOutputs::RunOutputs(mpm::Simulation& simulation, const Stamps& stamps, OutputOptions options)
    : simulation_(simulation),
      stamps_(stamps),
      options_(std::move(options)),
      particle_period_(in_syncs(options_.particle_period, simulation.sync_period())),
      particle_first_(options_.particle_first > 0.0 ? in_syncs(options_.particle_first, simulation.sync_period()) : 0),
      wrench_period_(in_syncs(options_.wrench_period, simulation.sync_period())),
      global_period_(in_syncs(options_.global_period, simulation.sync_period())),
      sinks_(simulation, stamps, options_.world_frame),
      local_(mpm_ros::local_frame(simulation.definition().grid, options_.world_frame)),
      cloud_(from_origin(options_.particles, local_)),
      global_(simulation, options_.global),
      contacts_(simulation, sinks_, local_, options_.wrench_cutoff, options_.force_scale),
      cracks_(simulation, sinks_, local_),
      robots_(simulation, sinks_),
      volumes_(simulation, sinks_),
      ground_(simulation, sinks_, local_, options_.ground) {
  if (mpm::Simulation::needs_start(options_.particles.fields)) simulation.keep_start();
  global_message_.names = global_.names();
  global_message_.units = global_.units();
}

void RunOutputs::write_static() {
  if (local_.apart() && sinks_.wanted(topics::kTfStatic))
    sinks_.put(topics::kTfStatic, static_transform(local_, sinks_.stamp()));
  if (sinks_.wanted(topics::kMarkers)) sinks_.put(topics::kMarkers, shape_markers(simulation_));
}

void RunOutputs::check_fields(const std::string& checkpoint) const {
  std::vector<std::string> fields = options_.particles.fields;
  fields.insert(fields.end(), global_.fields().begin(), global_.fields().end());
  if (!mpm::Simulation::needs_start(fields)) return;
  mpm::ParticleColumns columns;
  try {
    simulation_.read_particles(fields, {std::numeric_limits<int>::max(), {}}, columns);
  } catch (const mpm::DefinitionError& error) {
    throw mpm::CheckpointError(fmt::format("checkpoint {}: {}", checkpoint, error.what()));
  }
}

void RunOutputs::begin(const RunInfo& info) {
  sinks_.put(topics::kRunInfo, info);
  write_static();
  contacts_.read();
  write_bodies();
  contacts_.write();
  write_state(options_.state_hash, 0.0);
  cracks_.write();
  robots_.write();
  volumes_.write();
  write_particles();
  write_global();
  ground_.write(true);
  sinks_.end_writing();
}

void RunOutputs::begin_again(const RunInfo& info) {
  sinks_.put(topics::kRunInfo, info);
  write_static();
  write_bodies();
  write_state(options_.state_hash, 0.0);
  cracks_.write();
  robots_.write_present();
  volumes_.write();
  write_particles();
  if (!global_.empty() && !global_kept_) global_.read();  // contact forces are means from here
  ground_.write(true);
  sinks_.end_writing();
}

void RunOutputs::serialise(mpm::StateArchive& archive) {
  contacts_.serialise(archive);
  robots_.serialise(archive);
  {
    const mpm::StateArchive::Group group(archive, "global");
    const std::string own = fmt::format("{}", fmt::join(global_.names(), "\n"));
    std::string names = own;
    archive.value("names", names);
    // A scene's may be others in a run that watches otherwise: those begin.
    global_kept_ = names == own;
    if (global_kept_) global_.serialise(archive);
  }
  ground_.serialise(archive);
  if (simulation_.budget() != nullptr) {
    archive.rows("cuts", cuts_);
    archive.column("cuts/step", cuts_, &mpm::CutStep::step);
    archive.column("cuts/sweeps", cuts_, &mpm::CutStep::sweeps);
  }
  archive.value("applied", applied_);
  archive.value("late", late_);
  archive.value("refused", refused_);
}

void RunOutputs::command(const AppliedCommand& command) {
  ++applied_;
  sinks_.put(topics::kCommands,
             to_message(command, simulation_.rigid_body(command.body).name(), options_.world_frame, stamps_));
}

void RunOutputs::command(const JointOrder& order) {
  ++applied_;
  const std::string& robot = simulation_.definition().robots.at(static_cast<std::size_t>(order.robot)).name;
  sinks_.put(topics::kJointCommands, to_message(order, robot, stamps_));
}

void RunOutputs::state_set(const mpm::StateSet& state) {
  sinks_.put(topics::kStatesSet, to_message(state, simulation_.time(), options_.world_frame, stamps_));
}

void RunOutputs::sync(bool last, double real_time_factor) {
  contacts_.read();
  read_cuts();
  const std::int64_t time = simulation_.time();
  if (last || time % wrench_period_ == 0) {
    write_bodies();
    contacts_.write();
    write_state(last || options_.state_hash, real_time_factor);
    cracks_.write();
    robots_.write();
    volumes_.write();
  }
  if (last || time % global_period_ == 0) write_global();
  if (last || ground_.due()) ground_.write(last);
  if (last || particles_due()) write_particles();
  finished_ = last;
  sinks_.end_writing();
}

bool RunOutputs::particles_due() const {
  const std::int64_t since = simulation_.time() - particle_first_;
  return since >= 0 && since % particle_period_ == 0;
}

void RunOutputs::finish(double real_time_factor, const std::string& failure) {
  if (finished_) return;
  finished_ = true;
  const bool failed = !failure.empty();
  state_.failed = failed ? 1 : 0;
  state_.failure = failure;
  const std::int64_t time = simulation_.time();
  if (failed || contacts_.written_at() != time) {
    if (contacts_.read_at() != time) contacts_.read();
    if (failed) read_cuts();
    write_bodies();
    if (!contacts_.nothing_new()) contacts_.write();  // writes none if a run that failed within a period has
  }
  write_state(true, real_time_factor);
  if (failed || cracks_.written_at() != time) {
    cracks_.write();
    failed ? robots_.write_present() : robots_.write();
    volumes_.write();
  }
  if (failed || particles_at_ != time) write_particles();
  if (failed || global_at_ != time) write_global();
  if (failed || ground_.written_at() != time) ground_.write(true);
  sinks_.end_writing();
}

void RunOutputs::fail_unread(const std::string& failure) {
  if (finished_) return;
  finished_ = true;
  state_.failed = 1;
  state_.failure = failure;
  if (sinks_.wanted_anywhere(topics::kSolverState)) sinks_.put(topics::kSolverState, state_);
  sinks_.end_writing();
}

void RunOutputs::count_commands(std::uint64_t late, std::uint64_t refused, std::uint64_t dropped) {
  late_ = late;
  refused_ = refused;
  dropped_ = dropped;
}

void RunOutputs::read_cuts() {
  if (simulation_.budget() == nullptr) return;
  const std::vector<mpm::CutStep>& cut = simulation_.budget()->cut();
  cuts_.insert(cuts_.end(), cut.begin(), cut.end());
}

BodyStates RunOutputs::body_states() const {
  BodyStates message;
  message.header = sinks_.header();
  for (const mpm::BodyState& body : simulation_.bodies()) message.bodies.push_back(to_message(body));
  return message;
}

void RunOutputs::write_bodies() {
  if (sinks_.wanted(topics::kTf)) {
    std::vector<mpm::BodyState> own = simulation_.bodies();
    const auto elsewhere = [this](const mpm::BodyState& body) {
      return std::find(options_.others.begin(), options_.others.end(), body.name) != options_.others.end();
    };
    own.erase(std::remove_if(own.begin(), own.end(), elsewhere), own.end());
    for (mpm::BodyState& base : robots_.bases(options_.world_frame)) own.push_back(std::move(base));
    sinks_.put(topics::kTf, to_transforms(own, options_.world_frame, sinks_.stamp()));
  }
  if (sinks_.wanted(topics::kBodies)) sinks_.put(topics::kBodies, body_states());
}

void RunOutputs::write_state(bool with_hash, double real_time_factor) {
  if (!sinks_.wanted_anywhere(topics::kSolverState)) return cuts_.clear();
  SolverState message = to_message(simulation_.state());
  message.header = sinks_.header();
  message.real_time_factor = real_time_factor;
  message.overruns = overruns_;
  message.commands_applied = applied_;
  message.commands_late = late_;
  message.commands_refused = refused_;
  if (dropped_ > 0) {
    NamedValue& dropped = message.values.emplace_back();
    dropped.name = kCommandsDropped;
    dropped.unit = "1";
    dropped.value = {static_cast<double>(dropped_)};
  }
  for (const mpm::CutStep& cut : cuts_) {
    message.cut_steps.push_back(cut.step);
    message.cut_sweeps.push_back(static_cast<std::uint32_t>(cut.sweeps));
  }
  cuts_.clear();
  message.failed = state_.failed;
  message.failure = state_.failure;
  if (with_hash) message.state_hash = hash_text(simulation_.state_hash());
  sinks_.put(topics::kSolverState, message);
  state_ = std::move(message);
}

void RunOutputs::write_particles() {
  particles_at_ = simulation_.time();
  write_particles(false);
  if (simulation_.ranks() != nullptr) write_particles(true);
}

void RunOutputs::write_particles(bool own) {
  const auto meant = [own](const MessageSink* sink) { return sink->takes_own_particles() == own; };
  if (!simulation_.on_any_rank(sinks_.wanted(topics::kParticles, meant))) return;
  own ? cloud_.read_own(simulation_) : cloud_.read(simulation_);
  cloud_.message().header = sinks_.header(local_.name);
  sinks_.put_to(topics::kParticles, cloud_.message(), meant);
}

void RunOutputs::write_global() {
  global_at_ = simulation_.time();
  if (global_.empty() || !sinks_.wanted_anywhere(topics::kGlobalQuantities)) return;
  global_message_.header = sinks_.header();
  global_message_.values = global_.read();
  sinks_.put(topics::kGlobalQuantities, global_message_);
}

}  // namespace mpm_ros
