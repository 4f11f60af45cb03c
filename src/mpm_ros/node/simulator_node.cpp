#include "mpm_ros/node/simulator_node.hpp"

#include <ros/console.h>
#include <ros/service.h>

#include <algorithm>
#include <cstdio>
#include <new>
#include <thread>
#include <utility>

#include "mpm/advice/target_record.hpp"
#include "mpm/simulation/rank_failure.hpp"
#include "mpm_ros/aim/aim.hpp"
#include "mpm_ros/message/topics.hpp"
#include "mpm_ros/node/neighbours.hpp"
#include "mpm_ros/node/node_run.hpp"
#include "mpm_ros/record/output_names.hpp"
#include "mpm_ros/run/led_run.hpp"
#include "mpm_ros/run/run_scene_checkpoint.hpp"
#include "mpm_ros/run/settling_news.hpp"
#include "mpm_ros/run/stop_signals.hpp"

namespace mpm_ros {

namespace {

/// Longest time that the solver's thread sleeps before it looks whether it is to stop.
constexpr std::chrono::milliseconds kGlance{50};
/// Steps that wait for messages hold one each; others are for who asks meanwhile.
constexpr std::uint32_t kServiceThreads = 4;
/// After a stop, in which a sync period over several ranks is to end: a launcher of MPI kills what has not ended in 1
/// s.
constexpr std::chrono::milliseconds kRanksPatience{600};
/// At the end: for messages and answers on their way out.
constexpr std::chrono::milliseconds kLinger{300};

}  // namespace

class SimulatorNode::Building {
 public:
  explicit Building(SimulatorNode& node) : node_(node) {
    // Several ranks close their record together.
    if (!node.ranks_) deaf_.emplace(node.watchdog_, [&node] { return stop(node); });
    node_.mailbox_.set_busy(true);
  }
  ~Building() { node_.mailbox_.set_busy(false); }
  Building(const Building&) = delete;
  Building& operator=(const Building&) = delete;

 private:
  /// On the watchdog's thread; the run stands between two sync points.
  static int stop(SimulatorNode& node) {
    node.mailbox_.close();
    if (!node.run_) return 0;  // the first one is not there yet
    ROS_WARN_STREAM("stopped while a scene was built for the next run; the record ends with the run before");
    node.end_run();
    return node.exit_code();
  }

  SimulatorNode& node_;
  std::optional<ExitWatchdog::Deaf> deaf_;
};

SimulatorNode::SimulatorNode(ros::NodeHandle node, const NodeParameters& parameters, ExitWatchdog& watchdog,
                             std::shared_ptr<mpm::Communicator> ranks)
    : node_(std::move(node)),
      parameters_(parameters),
      watchdog_(watchdog),
      ranks_(std::move(ranks)),
      heights_(wait_for_height_maps(node_, parameters.scene, parameters.set, parameters.world_frame)),
      poses_(node_, parameters, heights_.set),
      subject_(std::make_shared<const Subject>(
          Subject{aimed(parameters.resume.empty() ? load({}) : with_choice_of(load({}), parameters.resume)), {}})),
      clock_(node_, parameters.publish_clock, parameters.clock_rate),
      commands_(node_, subject_->scene, parameters_, health_),
      paused_(parameters.start_paused) {
  RunOptions first_run = options_of_run(subject_->scene, {});
  check(parameters_, first_run, subject_->scene);
  ros::NodeHandle services(node_), urgent(node_);
  services.setCallbackQueue(&service_callbacks_);
  urgent.setCallbackQueue(&pause_callbacks_);
  std::vector<std::string> bodies;
  for (const mpm::RigidBodyDefinition& body : subject_->scene.definition.rigid_bodies) bodies.push_back(body.name);
  publishers_ = std::make_unique<Publishers>(services, bodies, parameters_.wrench_cutoff > 0.0);
  pacer_ = std::make_unique<Pacer>(subject_->scene.definition.time.sync, parameters_.real_time_factor);
  // Before the run has a time to keep; the copy that is timed is freed before the run is built.
  first_run.stop = stop_overdue;
  const bool paced = parameters_.pacing == Pacing::real_time;
  // By what steps cost on this processor, in one process.
  std::optional<ExpectedPace> expected;
  const mpm::DeviceRequest& device = parameters_.device;
  const bool may_be_elsewhere = device.word != "cpu" && device.find && device.find().missing.empty();
  if (!ranks_ && !may_be_elsewhere)
    expected = expected_pace(subject_->scene, first_run, paced ? parameters_.real_time_factor : 1.0, paced);
  start_run(subject_,
            parameters_.resume.empty() ? first_stamps() : stamps_from(mpm::read_checkpoint(parameters_.resume).time),
            parameters_.resume);
  for (const std::string& warning : run_->simulation().warnings()) ROS_WARN_STREAM(warning);
  for (const std::string& note : run_->simulation().notes()) ROS_INFO_STREAM(note);

  diagnostics_ = std::make_unique<NodeDiagnostics>(services, health_, [this] { commands_.keep_house(); });
  services_.push_back(urgent.advertiseService(topics::kPause, &SimulatorNode::on_pause, this));
  services_.push_back(services.advertiseService(topics::kReset, &SimulatorNode::on_reset, this));
  services_.push_back(services.advertiseService(topics::kResetWith, &SimulatorNode::on_reset_with, this));
  services_.push_back(services.advertiseService(topics::kSetState, &SimulatorNode::on_set_state, this));
  services_.push_back(services.advertiseService(topics::kSaveCheckpoint, &SimulatorNode::on_save_checkpoint, this));
  services_.push_back(services.advertiseService(topics::kLoadCheckpoint, &SimulatorNode::on_load_checkpoint, this));
  // Last: who sees it finds all the others.
  services_.push_back(services.advertiseService(topics::kStep, &SimulatorNode::on_step, this));

  service_spinner_ = std::make_unique<ros::AsyncSpinner>(kServiceThreads, &service_callbacks_);
  pause_spinner_ = std::make_unique<ros::AsyncSpinner>(1, &pause_callbacks_);
  commands_.listen();
  service_spinner_->start();
  pause_spinner_->start();
  tell_start(expected);
}

void SimulatorNode::check_neighbours(const ros::NodeHandle& node, const NodeParameters& parameters) {
  const Neighbours neighbours = Neighbours::ask();
  const std::string& self = ros::this_node::getName();
  std::vector<std::string> services;
  for (const char* service : topics::kServices) services.push_back(node.resolveName(service));
  const auto alive = [](const std::string& service) { return ros::service::exists(service, false); };
  if (const std::string taken = taken_service(neighbours, self, services, alive); !taken.empty())
    throw ParameterError(taken);
  if (!parameters.publish_clock || !ros::Time::isSimTime()) return;
  const std::string second = second_clock(neighbours, self, node.resolveName(topics::kClock));
  if (!second.empty()) ROS_WARN_STREAM(second);
}

SimulatorNode::~SimulatorNode() {
  mailbox_.close();
  if (diagnostics_) diagnostics_->stop();
  commands_.stop_listening();
  if (service_spinner_) service_spinner_->stop();
  if (pause_spinner_) pause_spinner_->stop();
}

bool SimulatorNode::ends() { return stop_requested() || !ros::ok(); }

Stamps SimulatorNode::first_stamps() const {
  if (ros::Time::isSimTime()) return Stamps();
  const ros::WallTime now = ros::WallTime::now();
  return Stamps(ros::Time(now.sec, now.nsec));
}

mpm::Scene SimulatorNode::load(const std::vector<std::string>& set) const {
  std::vector<std::string> overrides = heights_.set;
  for (const std::string& pose : poses_.set())
    if (!pose.empty()) overrides.push_back(pose);
  overrides.insert(overrides.end(), set.begin(), set.end());
  return mpm::load_scene(parameters_.scene, overrides);
}

mpm::Scene SimulatorNode::aimed(mpm::Scene scene) const {
  if (!scene.target) return scene;
  const Aim aim =
      mpm_ros::aim(std::move(scene), parameters_.threads, mpm::choose_isa(parameters_.isa), stop_overdue, ranks_.get());
  for (const std::string& line : aim.news) ROS_INFO_STREAM(line);
  for (const std::string& warning : aim.warnings) ROS_WARN_STREAM(warning);
  std::fflush(stdout);
  return aim.scene;
}

std::shared_ptr<const SimulatorNode::Subject> SimulatorNode::subject_of(const std::string& checkpoint) {
  const std::string text = mpm::read_checkpoint(checkpoint).label.scene_text;
  if (subject_->scene.text == text) return subject_;
  const FramePoses before = poses_;
  try {
    poses_.take_recorded(text);
    const Building building(*this);
    mpm::Scene scene = aimed(with_choice_of(load(subject_->set), checkpoint));
    return checked({std::move(scene), subject_->set});
  } catch (...) {
    poses_ = before;  // the run that is there goes on
    throw;
  }
}

std::shared_ptr<const SimulatorNode::Subject> SimulatorNode::load_subject(const std::vector<std::string>& set) {
  poses_.look_again(subject_->scene, [this](int body) { return commands_.frame_pose(body); });
  const Building building(*this);
  mpm::Scene scene = load(set);
  if (mpm::RecordedChoice choice = mpm::with_recorded_choice(scene, subject_->scene.text); choice.scene)
    scene = std::move(*choice.scene);
  return checked({aimed(std::move(scene)), set});
}

std::shared_ptr<const SimulatorNode::Subject> SimulatorNode::checked(Subject loaded) const {
  auto subject = std::make_shared<const Subject>(std::move(loaded));
  check(parameters_, run_options(subject->scene, parameters_, runs_ + 1, node_.getNamespace()), subject->scene);
  const auto bodies = [](const mpm::Scene& scene) {
    std::vector<std::pair<std::string, std::string>> names;  // and the frames that they follow
    const std::vector<std::string> commanded = mpm::commanded_names(scene);
    for (std::size_t body = 0; body < commanded.size(); ++body) {
      names.emplace_back(commanded[body], scene.commands[body].frame);
    }
    for (const mpm::RobotDefinition& robot : scene.definition.robots) names.emplace_back(robot.name, "");
    return names;
  };
  if (bodies(subject->scene) != bodies(subject_->scene)) {
    throw ParameterError(
        "neither a reset nor a checkpoint can change the names of rigid bodies and robots, or the tf frames that they "
        "follow: the "
        "node's topics are "
        "theirs; start another node for that scene");
  }
  return subject;
}

RunOptions SimulatorNode::options_of_run(const mpm::Scene& scene, const std::vector<std::string>& set) const {
  RunOptions options = run_options(scene, parameters_, runs_ + 1, node_.getNamespace(), set);
  options.ranks = ranks_;
  return options;
}

void SimulatorNode::start_run(const std::shared_ptr<const Subject>& subject, const Stamps& stamps,
                              const std::string& resume) {
  RunOptions options = options_of_run(subject->scene, subject->set);
  options.stop = stop_overdue;
  options.settling = settling_news([](const std::string& line) {
    ROS_INFO_STREAM(line);
    std::fflush(stdout);  // a pipe would keep it until the run has long begun
  });
  CommandMemory memory = commands_.fresh_memory(subject->scene);
  if (!resume.empty()) {
    resume_from(resume, options);
    options.more = [&](mpm::StateArchive& archive) { memory.serialise(archive); };
  }
  if (!subject->scene.output.global.empty()) publishers_->add_global();
  if (subject->scene.definition.cracks.any()) publishers_->add_cracks();
  for (const mpm::RobotDefinition& robot : subject->scene.definition.robots) publishers_->add_robot(robot);
  if (!subject->scene.definition.volumes.empty()) publishers_->add_volumes();
  if (subject->scene.output.ground) publishers_->add_ground();
  if (local_frame(subject->scene.definition.grid, parameters_.world_frame).apart()) publishers_->add_static_frames();
  std::unique_ptr<Run> run;
  {
    const Building building(*this);
    run = make_run(subject->scene, options, stamps, publishers_.get());
  }
  if (run_) end_run();
  run_ = std::move(run);
  last_checkpoint_ = resume.empty() ? "" : absolute_path(resume);
  subject_ = subject;
  pacer_->set_period(run_->simulation().sync_period());
  ++runs_;  // names the next bag
  record_lost_ = false;
  if (!run_->device_note().empty()) ROS_INFO_STREAM(run_->device_note());
  if (const std::string note = note_on(run_->outputs().local_frame()); !note.empty()) ROS_INFO_STREAM(note);
  if (const BagRecorder* recorder = run_->recorder()) {
    ROS_INFO_STREAM("recording to " << recorder->path() << (recorder->replaced() ? ", which is replaced" : ""));
  }
  commands_.begin(*run_, memory);
  health_.restart();
  failure_.clear();
  clock_.restart();
}

SimulatorNode::Phase SimulatorNode::phase() const {
  if (!failure_.empty()) return Phase::failed;
  if (run_->ended()) return Phase::ended;
  if (paused_) return Phase::paused;
  return parameters_.pacing == Pacing::lockstep ? Phase::waiting : Phase::running;
}

void SimulatorNode::begin_run() {
  pace_told_ = false;
  overload_told_.reset();
  publish_clock(true);
  count_commands();  // those of an earlier run stay in the count
  try {
    run_->begin();
  } catch (const BagError& error) {
    bag_lost_ = true;
    fail(error.what(), 1);
  }
  pacer_->restart(Pacer::Clock::now());
  report();
}

int SimulatorNode::spin() {
  begin_run();
  std::string ignored;  // nothing is asked for that could be refused
  while (!ends()) {
    const Phase now = phase();
    if (run_->parted()) break;
    if ((now == Phase::failed || now == Phase::ended) && !parameters_.keep_alive) {
      if (now == Phase::ended) {
        ROS_INFO("the run has reached its end at %g s, and the node ends with it", subject_->scene.definition.time.end);
      }
      break;
    }
    if (now != Phase::running) {
      mailbox_.run_until(Pacer::Clock::now() + kGlance);
      continue;
    }
    mailbox_.run_until(Pacer::Clock::now());
    if (phase() != Phase::running || !sync_period({}, ignored) || parameters_.pacing != Pacing::real_time) continue;
    const Pacer::Clock::time_point due = pacer_->next(Pacer::Clock::now());
    tell_overload();
    while (Pacer::Clock::now() < due && phase() == Phase::running && !ends()) {
      mailbox_.run_until(std::min(due, Pacer::Clock::now() + kGlance));
    }
  }
  end_run();
  mailbox_.close();
  std::this_thread::sleep_for(kLinger);
  if (run_->parted()) throw mpm::RankFailure(failure_);
  if (!used_up().empty()) ROS_FATAL_STREAM(used_up());
  return exit_code();
}

int SimulatorNode::exit_code() const {
  if (!failure_.empty()) return failure_code_;
  return bag_lost_ || !used_up().empty() ? 1 : 0;
}

bool SimulatorNode::hand_over(const std::function<void()>& work, std::string& message, Mailbox::Turn turn) {
  if (mailbox_.call(work, turn)) return true;
  message = mailbox_.closed()
                ? "the node is ending"
                : "a scene is being built (reset, reset_with or load_checkpoint); ask again when it is done";
  return false;
}

void SimulatorNode::advance() {
  std::optional<ExitWatchdog::Deaf> deaf;
  if (ranks_) {
    const auto close = [this] {
      mailbox_.close();
      ROS_WARN_STREAM("stopped within a sync period; the record ends with the sync point before");
      run_->close_record();
      return exit_code();
    };
    deaf.emplace(watchdog_, close, kRanksPatience);
  }
  const bool paced = parameters_.pacing == Pacing::real_time && phase() == Phase::running;
  run_->advance(paced ? pacer_->late(Pacer::Clock::now()) : Pacer::Clock::duration::zero());
}

bool SimulatorNode::sync_period(const StepCommands& extra, std::string& refusal) {
  try {
    const BodyCommands::Outcome outcome = commands_.apply_due(*run_, extra);
    refusal = outcome.refusal;
    if (!outcome.silence.empty()) fail(outcome.silence, 3);
    if (!failure_.empty() || !refusal.empty()) return false;
    count_commands();
    advance();
    for (const std::string& warning : run_->take_warnings()) ROS_WARN_STREAM(warning);
    publish_clock(run_->ended());
    if (run_->ended()) end_run();
    tell_pace();
    report();
    return true;
  } catch (const mpm::StoppedError& error) {
    ROS_WARN_STREAM(error.what() << "; the record ends at the sync point before");
  } catch (const mpm::PhysicsError& error) {
    fail(error.what(), 3);
  } catch (const mpm::RankFailure& error) {
    fail(error.what(), 3);
  } catch (const mpm::Error& error) {
    fail(error.what(), 2);
  } catch (const ParameterError& error) {
    fail(error.what(), 2);
  } catch (const BagError& error) {
    bag_lost_ = true;
    fail(error.what(), 1);
  } catch (const std::bad_alloc&) {
    fail("there is not enough memory to go on; use a larger grid.cell or a smaller scene", 1);
  }
  return false;
}

void SimulatorNode::fail(const std::string& reason, int exit_code) {
  failure_ = reason;
  failure_code_ = exit_code;
  ROS_FATAL_STREAM(reason);
  try {
    count_commands();
    run_->fail(reason);
    say_closed();
  } catch (const BagError& error) {
    ROS_FATAL_STREAM(error.what());
    bag_lost_ = true;
  }
  if (run_->parted()) return;
  leave_failed_state();
  if (parameters_.keep_alive) ROS_WARN_STREAM("the node waits for reset, reset_with or load_checkpoint");
  report();
}

void SimulatorNode::end_run() {
  if (run_->closed()) return;
  try {
    count_commands();
    run_->finish();
    say_closed();
  } catch (const BagError& error) {
    ROS_FATAL_STREAM(error.what());
    bag_lost_ = true;
  } catch (const mpm::PhysicsError& error) {
    fail(error.what(), 3);
  }
}

}  // namespace mpm_ros
