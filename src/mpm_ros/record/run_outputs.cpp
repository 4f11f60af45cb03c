#include "mpm_ros/record/run_outputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "mpm/checkpoint/checkpoint.hpp"
#include "mpm/math/build_info.hpp"
#include "mpm_ros/message/bag_error.hpp"
#include "mpm_ros/message/conversions.hpp"
#include "mpm_ros/message/ground_messages.hpp"
#include "mpm_ros/message/quantities.hpp"
#include "mpm_ros/message/topics.hpp"
#include "mpm_ros/record/output_names.hpp"
#include "mpm_ros/record/scene_files.hpp"
#include "mpm_ros/record/together.hpp"

namespace mpm_ros {

namespace {

/// A period [s] as whole sync periods, at least one [ns].
std::int64_t in_syncs(double period, std::int64_t sync) {
  return sync * std::max<std::int64_t>(1, std::llround(period * mpm::kNanosecondsOfSecond / static_cast<double>(sync)));
}

/// The longest contact arrow, as a part of the domain's longest edge.
constexpr double kArrowLength = 0.25;

/// Length of the longest contact arrow [m]; axes that the scene does not have, such as the turn about an axis, do not
/// count.
double arrow_length(const mpm::SimulationDefinition& scene) {
  mpm::Vec3 size = scene.grid.max - scene.grid.min;
  for (const int axis : mpm::axes_beside(scene.geometry)) size[axis] = 0.0;
  return kArrowLength * size.maxCoeff();
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
      local_(mpm_ros::local_frame(simulation.definition().grid, options_.world_frame)),
      cloud_(from_origin(options_.particles, local_)),
      global_(simulation, options_.global),
      force_markers_(options_.force_scale, arrow_length(simulation.definition()),
                     simulation.definition().grid.max.z()) {
  for (const mpm::BodyState& body : simulation.bodies()) {
    wrench_topics_.push_back(topics::of_body(body.name, topics::kWrench));
    filtered_topics_.push_back(topics::of_body(body.name, topics::kWrenchFiltered));
  }
  if (mpm::Simulation::needs_start(options_.particles.fields)) simulation.keep_start();
  if (options_.wrench_cutoff > 0.0) {
    const double period = mpm::seconds_of(simulation.sync_period());
    if (!(options_.wrench_cutoff < 0.5 / period)) {
      throw mpm::DefinitionError(fmt::format(
          "the cutoff of the filtered wrenches, {} Hz, is not below half of the rate of sync points, {} Hz; "
          "lower it, or time.sync",
          options_.wrench_cutoff, 0.5 / period));
    }
    filters_.assign(wrench_topics_.size(), WrenchFilter(options_.wrench_cutoff, period));
    filtered_.resize(wrench_topics_.size());
  }
  global_message_.names = global_.names();
  global_message_.units = global_.units();
  if (options_.ground) ground_ = std::make_unique<GroundRecord>(simulation, *options_.ground);
}

ros::Time RunOutputs::stamp() const { return stamps_.at(simulation_.time()); }

std_msgs::Header RunOutputs::header(const std::string& frame) const {
  std_msgs::Header header;
  header.stamp = stamp();
  header.frame_id = frame;
  return header;
}

template <typename Message>
void RunOutputs::put(const std::string& topic, const Message& message) {
  put_to(topic, message, [](const MessageSink*) { return true; });
}

template <typename Message, typename Meant>
void RunOutputs::put_to(const std::string& topic, const Message& message, const Meant& meant) {
  try {
    for (MessageSink* sink : sinks_) {
      if (sink->wants(topic) && meant(sink)) sink->put(topic, stamp(), message);
    }
  } catch (...) {
    if (simulation_.ranks() == nullptr) throw;
    failed_sink_ = std::current_exception();  // others go on reading for what comes next
  }
}

void RunOutputs::end_writing() {
  together<BagError>(simulation_.ranks(), [this] {
    if (failed_sink_) std::rethrow_exception(std::exchange(failed_sink_, nullptr));
  });
}

bool RunOutputs::wanted(const std::string& topic) const {
  return std::any_of(sinks_.begin(), sinks_.end(), [&](const MessageSink* sink) { return sink->wants(topic); });
}

void RunOutputs::write_static() {
  if (local_.apart() && wanted(topics::kTfStatic)) put(topics::kTfStatic, static_transform(local_, stamp()));
  if (wanted(topics::kMarkers)) put(topics::kMarkers, shape_markers(simulation_));
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
  put(topics::kRunInfo, info);
  write_static();
  read_contacts();
  write_bodies();
  write_contacts();
  write_state(options_.state_hash, 0.0);
  write_cracks();
  write_robots();
  write_volumes();
  write_particles();
  write_global();
  write_ground(true);
  end_writing();
}

void RunOutputs::begin_again(const RunInfo& info) {
  put(topics::kRunInfo, info);
  write_static();
  write_bodies();
  write_state(options_.state_hash, 0.0);
  write_cracks();
  write_volumes();
  write_particles();
  if (!global_.empty() && !global_kept_) global_.read();  // contact forces are means from here
  write_ground(true);
  end_writing();
}

void RunOutputs::serialise(mpm::StateArchive& archive) {
  {
    const mpm::StateArchive::Group group(archive, "contacts");
    contacts_.serialise(archive);
  }
  {
    const mpm::StateArchive::Group group(archive, "average");
    average_.serialise(archive);
  }
  std::uint64_t filters = filters_.size();
  archive.value("filters", filters);
  // Another cutoff than when it was saved is another filter, which begins.
  double cutoff = options_.wrench_cutoff;
  archive.value("wrench_cutoff", cutoff);
  for (std::size_t body = 0; filters == filters_.size() && cutoff == options_.wrench_cutoff && body < filters; ++body) {
    const mpm::StateArchive::Group group(archive, fmt::format("filter{}", body));
    filters_[body].serialise(archive);
  }
  if (!simulation_.definition().robots.empty()) {
    const mpm::StateArchive::Group group(archive, "robots");
    if (archive.reading()) robots_.take(simulation_.robots(), mpm::seconds_of(simulation_.time()));
    robots_.serialise(archive);
  }
  {
    const mpm::StateArchive::Group group(archive, "global");
    const std::string own = fmt::format("{}", fmt::join(global_.names(), "\n"));
    std::string names = own;
    archive.value("names", names);
    // A scene's may be others in a run that watches otherwise: those begin.
    global_kept_ = names == own;
    if (global_kept_) global_.serialise(archive);
  }
  std::uint64_t grounds = ground_ ? 1 : 0;
  archive.value("grounds", grounds);
  if (ground_ && grounds > 0) {
    const mpm::StateArchive::Group group(archive, "ground");
    ground_->serialise(archive);
  }
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
  put(topics::kCommands,
      to_message(command, simulation_.rigid_body(command.body).name(), options_.world_frame, stamps_));
  end_writing();
}

void RunOutputs::command(const JointOrder& order) {
  ++applied_;
  const std::string& robot = simulation_.definition().robots.at(static_cast<std::size_t>(order.robot)).name;
  put(topics::kJointCommands, to_message(order, robot, stamps_));
  end_writing();
}

void RunOutputs::sync(bool last, double real_time_factor) {
  read_contacts();
  read_cuts();
  const std::int64_t time = simulation_.time();
  if (last || time % wrench_period_ == 0) {
    write_bodies();
    write_contacts();
    write_state(last || options_.state_hash, real_time_factor);
    write_cracks();
    write_robots();
    write_volumes();
  }
  if (last || time % global_period_ == 0) write_global();
  if (ground_ && (last || ground_->due(time))) write_ground(last);
  if (last || particles_due()) write_particles();
  finished_ = last;
  end_writing();
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
  if (failed || contacts_at_ != simulation_.time()) {
    if (read_at_ != simulation_.time()) read_contacts();
    if (failed) read_cuts();
    write_bodies();
    if (!average_.empty()) write_contacts();  // writes none if a run that failed within a period has
  }
  write_state(true, real_time_factor);
  if (failed || cracks_at_ != simulation_.time()) write_cracks(), write_volumes();
  if (failed || particles_at_ != simulation_.time()) write_particles();
  if (failed || global_at_ != simulation_.time()) write_global();
  if (failed || ground_at_ != simulation_.time()) write_ground(true);
  end_writing();
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

void RunOutputs::read_contacts() {
  read_at_ = simulation_.time();
  contacts_.bodies.clear();
  for (int body = 0; body < static_cast<int>(wrench_topics_.size()); ++body) {
    contacts_.bodies.push_back(simulation_.take_contact(body));
  }
  contacts_.pairs = simulation_.take_pairs();
  average_.add(contacts_);
  if (filters_.empty()) return;
  const std::vector<mpm::BodyState> bodies = simulation_.bodies();
  for (std::size_t body = 0; body < filters_.size(); ++body) {
    filtered_[body] = filters_[body].filter(in_body_axes(contacts_.bodies[body].mean, bodies[body].pose.orientation));
  }
}

ContactForces RunOutputs::contact_forces(const Contacts& contacts) const {
  ContactForces message;
  message.header = header(options_.world_frame);
  for (const mpm::ContactReport& contact : contacts.bodies) message.bodies.push_back(to_message(contact));
  for (const mpm::PairReport& pair : contacts.pairs) message.pairs.push_back(to_message(pair));
  return message;
}

BodyStates RunOutputs::body_states() const {
  BodyStates message;
  message.header = header(options_.world_frame);
  for (const mpm::BodyState& body : simulation_.bodies()) message.bodies.push_back(to_message(body));
  return message;
}

void RunOutputs::write_contacts() {
  contacts_at_ = simulation_.time();
  const Contacts contacts = average_.take();
  const std::vector<mpm::BodyState> bodies = simulation_.bodies();
  if (wanted(topics::kContactForces)) put(topics::kContactForces, contact_forces(contacts));
  for (std::size_t body = 0; body < contacts.bodies.size(); ++body) {
    if (!wanted(wrench_topics_[body])) continue;
    geometry_msgs::WrenchStamped message;
    message.header = header(bodies[body].name);
    message.wrench = to_message(in_body_axes(contacts.bodies[body].mean, bodies[body].pose.orientation));
    put(wrench_topics_[body], message);
  }
  for (std::size_t body = 0; body < filters_.size(); ++body) {
    if (!wanted(filtered_topics_[body])) continue;
    geometry_msgs::WrenchStamped message;
    message.header = header(bodies[body].name);
    message.wrench = to_message(filtered_[body]);
    put(filtered_topics_[body], message);
  }
  if (wanted(topics::kForceMarkers)) {
    visualization_msgs::MarkerArray markers =
        force_markers_.markers(contacts.bodies, options_.world_frame, stamp(), tops_of(simulation_));
    move_to(local_, markers);
    put(topics::kForceMarkers, markers);
  }
}

void RunOutputs::write_bodies() {
  if (wanted(topics::kTf)) {
    std::vector<mpm::BodyState> own = simulation_.bodies();
    const auto elsewhere = [this](const mpm::BodyState& body) {
      return std::find(options_.others.begin(), options_.others.end(), body.name) != options_.others.end();
    };
    own.erase(std::remove_if(own.begin(), own.end(), elsewhere), own.end());
    for (mpm::BodyState& base :
         RobotOutputs::bases(simulation_.definition().robots, simulation_.robots(), options_.world_frame)) {
      own.push_back(std::move(base));
    }
    put(topics::kTf, to_transforms(own, options_.world_frame, stamp()));
  }
  if (wanted(topics::kBodies)) put(topics::kBodies, body_states());
}

void RunOutputs::write_state(bool with_hash, double real_time_factor) {
  if (!wanted_anywhere(topics::kSolverState)) return cuts_.clear();
  SolverState message = to_message(simulation_.state());
  message.header = header(options_.world_frame);
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
  put(topics::kSolverState, message);
  state_ = std::move(message);
}

void RunOutputs::write_particles() {
  particles_at_ = simulation_.time();
  write_particles(false);
  if (simulation_.ranks() != nullptr) write_particles(true);
}

void RunOutputs::write_particles(bool own) {
  const auto meant = [own](const MessageSink* sink) { return sink->takes_own_particles() == own; };
  const bool wanted_here = std::any_of(sinks_.begin(), sinks_.end(), [&](const MessageSink* sink) {
    return meant(sink) && sink->wants(topics::kParticles);
  });
  if (!simulation_.on_any_rank(wanted_here)) return;
  own ? cloud_.read_own(simulation_) : cloud_.read(simulation_);
  cloud_.message().header = header(local_.name);
  put_to(topics::kParticles, cloud_.message(), meant);
}

void RunOutputs::write_cracks() {
  cracks_at_ = simulation_.time();
  if (!simulation_.definition().cracks.any()) return;  // then nobody has a place for them
  if (!wanted_anywhere(topics::kCracks) && !wanted_anywhere(topics::kCrackMarkers)) return;
  const std::vector<mpm::CrackReport> cracks = simulation_.cracks();
  if (wanted(topics::kCracks)) {
    Cracks message = to_message(cracks, simulation_.crack_tips());
    message.header = header(options_.world_frame);
    put(topics::kCracks, message);
  }
  if (!wanted(topics::kCrackMarkers)) return;
  visualization_msgs::MarkerArray markers = crack_markers(cracks, options_.world_frame, stamp());
  move_to(local_, markers);
  put(topics::kCrackMarkers, markers);
}

void RunOutputs::write_robots() {
  if (simulation_.definition().robots.empty()) return;
  const RobotOutputs::Interval interval = robots_.take(simulation_.robots(), mpm::seconds_of(simulation_.time()));
  for (std::size_t r = 0; r < interval.now.size(); ++r) {
    const mpm::RobotReport &now = interval.now[r], &last = interval.last[r];
    const std::string topic = topics::of_robot(now.name, topics::kJointStates);
    if (wanted(topic)) {
      sensor_msgs::JointState message = RobotOutputs::joints(now, last, interval.length);
      message.header = header({});
      put(topic, message);
    }
    for (const SensorMessage& sensor : RobotOutputs::sensors(now, last, interval.length)) {
      if (!wanted(sensor.topic)) continue;
      geometry_msgs::WrenchStamped message;
      message.header = header(sensor.frame);
      message.wrench = sensor.wrench;
      put(sensor.topic, message);
    }
  }
}

void RunOutputs::write_global() {
  global_at_ = simulation_.time();
  if (global_.empty() || !wanted_anywhere(topics::kGlobalQuantities)) return;
  global_message_.header = header(options_.world_frame);
  global_message_.values = global_.read();
  put(topics::kGlobalQuantities, global_message_);
}

void RunOutputs::write_volumes() {
  if (simulation_.definition().volumes.empty() || !wanted(topics::kVolumes)) return;
  Volumes message = to_message(simulation_.volumes());
  message.header = header(options_.world_frame);
  put(topics::kVolumes, message);
}

void RunOutputs::write_ground(bool all) {
  if (!ground_) return;
  ground_at_ = simulation_.time();
  bool anyone = false;
  for (const char* topic : {topics::kTerrain, topics::kTerrainCloud, topics::kTerrainImage})
    anyone = anyone || wanted(topic);
  if (!simulation_.on_any_rank(anyone)) return;
  if (!ground_->look(simulation_, all)) return;
  if (wanted(topics::kTerrain)) {
    HeightMap message = to_message(ground_->map(), simulation_.definition().grid.min.z());
    message.header = header(options_.world_frame);
    put(topics::kTerrain, message);
  }
  if (wanted(topics::kTerrainCloud)) {
    sensor_msgs::PointCloud2 cloud = to_cloud(ground_->map(), ground_->before(), local_);
    cloud.header = header(local_.name);
    put(topics::kTerrainCloud, cloud);
  }
  if (wanted(topics::kTerrainImage)) {
    sensor_msgs::Image image = to_image(ground_->map());
    image.header = header(options_.world_frame);
    put(topics::kTerrainImage, image);
  }
}

}  // namespace mpm_ros
