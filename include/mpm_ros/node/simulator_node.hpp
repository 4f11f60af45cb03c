// The node: a run, its topics and services, and the loop that drives it.
//
// Four kinds of threads at work: the solver's (the one that calls spin(), the only one that touches the run), one for
// command topics (checks and queues them), four for services and housekeeping (hand work to the solver's thread and
// wait), and one for `pause` alone, which ends a step under way and goes before all that waits.
// A sync period is: apply the commands that are due, advance, publish and record, then pace.
#pragma once

#include <mpm_ros/Checkpoint.h>
#include <mpm_ros/Reset.h>
#include <mpm_ros/SetState.h>
#include <mpm_ros/Step.h>
#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mpm/scene/scene.hpp"
#include "mpm_ros/message/node_health.hpp"
#include "mpm_ros/node/body_commands.hpp"
#include "mpm_ros/node/exit_watchdog.hpp"
#include "mpm_ros/node/frame_poses.hpp"
#include "mpm_ros/node/height_maps.hpp"
#include "mpm_ros/node/mailbox.hpp"
#include "mpm_ros/node/node_diagnostics.hpp"
#include "mpm_ros/node/node_parameters.hpp"
#include "mpm_ros/node/pacer.hpp"
#include "mpm_ros/node/publishers.hpp"
#include "mpm_ros/node/sim_clock.hpp"
#include "mpm_ros/run/expected_pace.hpp"
#include "mpm_ros/run/run.hpp"

namespace mpm_ros {

class SimulatorNode {
 public:
  /// Loads the scene, once the messages are there from which it takes heights, and makes the first run ready.
  /// `watchdog`, which must outlive it, ends the process when a stop comes while a reset builds a scene.
  /// `ranks`: null for a process that is alone; else this is the first of them, and the others follow() it.
  /// @throws mpm::Error, ParameterError, BagError: bad input, exit code 2. @throws mpm::StoppedError
  SimulatorNode(ros::NodeHandle node, const NodeParameters& parameters, ExitWatchdog& watchdog,
                std::shared_ptr<mpm::Communicator> ranks = {});
  ~SimulatorNode();
  /// Looks whether another node does what this one would do too: warns of a second clock.
  /// @throws ParameterError where one offers its services
  static void check_neighbours(const ros::NodeHandle& node, const NodeParameters& parameters);

  /// Runs until the scene ends or the run fails; with keep_alive it then waits for a reset, a checkpoint to load, or a
  /// stop (stop_signals.hpp, or a shutdown of ROS). Returns the exit code, with keep_alive that of the last run: 0
  /// done, 1 a bag could not be written, 2 bad input that showed only now (a function of time that is not finite,
  /// recorded commands of another scene), 3 the physics failed (or silence, with on_timeout error).
  /// @throws mpm::RankFailure where one of several ranks has failed alone: all have to be ended
  int spin();

 private:
  enum class Phase { running, paused, waiting, ended, failed };

  /// A stop was asked for.
  static bool ends();
  Stamps first_stamps() const;
  /// Subject that a run is made from: the scene, and what a reset has set in it.
  struct Subject {
    mpm::Scene scene;
    std::vector<std::string> set;
  };
  /// The scene with `set` over what ~set says. @throws mpm::Error
  mpm::Scene load(const std::vector<std::string>& set) const;
  /// The options of run_options() with what belongs to the ranks.
  RunOptions options_of_run(const mpm::Scene& scene, const std::vector<std::string>& set) const;
  /// To the next sync point. Over several ranks a stop closes the record where a rank has gone that others wait for.
  void advance();
  /// Chooses for a target that is open, and says so. @throws mpm::Error
  mpm::Scene aimed(mpm::Scene scene) const;
  /// A subject that fits the node, whose topics belong to its rigid bodies. @throws ParameterError, mpm::Error
  std::shared_ptr<const Subject> checked(Subject loaded) const;
  /// That of the present run, with what was chosen for its target in the checkpoint's.
  /// @throws mpm::Error, ParameterError
  std::shared_ptr<const Subject> subject_of(const std::string& checkpoint);
  /// The scene with `set` over what ~set says; with the choice of the present run for a target where it is the same
  /// scene, else with one that is made now. @throws mpm::Error, ParameterError
  std::shared_ptr<const Subject> load_subject(const std::vector<std::string>& set);
  /// `resume`: a checkpoint, or empty. @throws mpm::Error, BagError; then the run that is there goes on.
  void start_run(const std::shared_ptr<const Subject>& subject, const Stamps& stamps, const std::string& resume = {});
  /// Says what runs, at what pace it is expected to, and what the node waits for.
  void tell_start(const std::optional<ExpectedPace>& expected) const;
  /// Warns of a time.budget that is longer than a sync period lasts, or beside commands of a recording.
  void tell_budget() const;
  /// With nobody who waits: by a run's first second, how long it will take.
  void tell_pace();
  /// Tells, after a delay has been given up, that the run cannot keep its pace, and what would help.
  void tell_overload();
  /// Its first messages, and the pace from now on.
  void begin_run();
  /// One sync period; extra commands are applied after those that are due. False when it failed, or when an extra
  /// command was refused: then time has not moved, and `refusal` says why.
  bool sync_period(const StepCommands& extra, std::string& refusal);
  void fail(const std::string& reason, int exit_code);
  void end_run();
  /// With which the node ends, as things are.
  int exit_code() const;
  /// A scene is read or built beside the run that is there, which may take long: while it exists, services are refused
  /// after a while, and a stop ends the run, and the process.
  class Building;
  /// Has `work` done by the solver's thread and waits for it. False, with the reason in `message`, when it is not done.
  bool hand_over(const std::function<void()>& work, std::string& message, Mailbox::Turn turn = Mailbox::Turn::last);
  void say_closed() const;
  void count_commands();
  void publish_clock(bool always) { clock_.publish(run_->simulation().time(), run_->stamps(), always); }
  void report();
  Phase phase() const;

  // Services; the first of each pair runs on a service thread, the second on the solver's.
  bool on_pause(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response);
  bool on_reset(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  bool on_reset_with(Reset::Request& request, Reset::Response& response);
  bool on_step(Step::Request& request, Step::Response& response);
  bool on_set_state(SetState::Request& request, SetState::Response& response);
  void pause(bool paused, std_srvs::SetBool::Response& response);
  /// Reason why a service did nothing, for its answer.
  static std::string refusal_of(const std::exception& error);
  /// Begins the subject from time zero. Returns what began; `success`: whether it did.
  std::string reset(const std::shared_ptr<const Subject>& subject, bool& success);
  void reset_with(const Reset::Request& request, Reset::Response& response);
  void set_state(const SetState::Request& request, SetState::Response& response);
  void step(const Step::Request& request, Step::Response& response);
  /// Reason why a step cannot begin now, or empty.
  std::string step_refused() const;
  /// Waits for the messages on command topics that the request wants first. False, with the answer, when they stay
  /// away.
  bool wait_received(const Step::Request& request, Step::Response& response) const;
  /// Sync periods that a step request asks for; 0 with a problem when it makes no sense.
  std::int64_t periods_of(const Step::Request& request, std::string& problem) const;

  // Checkpoints (checkpoint_services.cpp).
  bool on_save_checkpoint(Checkpoint::Request& request, Checkpoint::Response& response);
  bool on_load_checkpoint(Checkpoint::Request& request, Checkpoint::Response& response);
  void save_checkpoint(const std::string& path, Checkpoint::Response& response);
  void load_checkpoint(const std::string& path, Checkpoint::Response& response);
  /// Stamps of a run that goes on from that simulated time [ns].
  Stamps stamps_from(std::int64_t time) const;
  void leave_failed_state();

  ros::NodeHandle node_;
  const NodeParameters parameters_;
  ExitWatchdog& watchdog_;
  const std::shared_ptr<mpm::Communicator> ranks_;
  const HeightMaps heights_;                // with the overrides of the scene
  FramePoses poses_;                        // poses of the present run
  std::shared_ptr<const Subject> subject_;  // subject of the present run
  NodeHealth health_;
  Mailbox mailbox_;
  SimClock clock_;
  BodyCommands commands_;
  ros::CallbackQueue service_callbacks_, pause_callbacks_;
  std::unique_ptr<Publishers> publishers_;
  std::unique_ptr<Run> run_;
  std::unique_ptr<Pacer> pacer_;
  std::unique_ptr<NodeDiagnostics> diagnostics_;
  std::vector<ros::ServiceServer> services_;
  std::unique_ptr<ros::AsyncSpinner> service_spinner_, pause_spinner_;

  int runs_ = 0;
  bool paused_ = false;
  bool pace_told_ = false;           // true after the pace of a run that nothing paces was told
  std::uint64_t given_up_seen_ = 0;  // last value of Pacer::given_up()
  std::optional<Pacer::Clock::time_point> overload_told_;
  std::string failure_;          // failure of the present run
  std::string last_checkpoint_;  // from which it could go on; empty: none
  int failure_code_ = 0;         // exit code that goes with it
  bool bag_lost_ = false;        // true if the bag of any run was lost
  bool record_lost_ = false;     // and said so
};

}  // namespace mpm_ros
