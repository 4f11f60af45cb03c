// The node: a run, its topics and services, and the loop that drives it.
//
// Three threads at work: the solver's (the one that calls spin(), the only one that touches the run), one for command
// topics (checks and queues them), four for services and housekeeping (hand work to the solver's thread and wait).
// A sync period is: apply the commands that are due, advance, publish and record, then pace.
#pragma once

#include <mpm_ros/Checkpoint.h>
#include <mpm_ros/Step.h>
#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "mpm/scene/scene.hpp"
#include "mpm_ros/message/node_health.hpp"
#include "mpm_ros/node/body_commands.hpp"
#include "mpm_ros/node/mailbox.hpp"
#include "mpm_ros/node/node_diagnostics.hpp"
#include "mpm_ros/node/node_parameters.hpp"
#include "mpm_ros/node/pacer.hpp"
#include "mpm_ros/node/publishers.hpp"
#include "mpm_ros/node/sim_clock.hpp"
#include "mpm_ros/run/run.hpp"

namespace mpm_ros {

class SimulatorNode {
 public:
  /// Loads the scene and makes the first run ready. `stop_requested` is asked between sync periods.
  /// @throws mpm::Error, ParameterError, BagError: bad input, exit code 2.
  SimulatorNode(ros::NodeHandle node, const NodeParameters& parameters, std::function<bool()> stop_requested);
  ~SimulatorNode();

  /// Runs until the scene ends (and, with keep_alive, on until it is stopped), a stop is requested or the physics
  /// fails. Returns the exit code: 0 done, 1 the bag cannot be written, 2 bad input that showed only now (a function of
  /// time that is not finite, recorded commands of another scene), 3 the physics failed (or silence, with on_timeout
  /// error).
  int spin();

 private:
  enum class Phase { running, paused, waiting, ended, failed };

  Stamps first_stamps() const;
  /// `resume`: a checkpoint, or empty. @throws mpm::Error, BagError; then the run that is there goes on.
  void start_run(const Stamps& stamps, const std::string& resume = {});
  /// Its first messages, and the pace from now on.
  void begin_run();
  /// One sync period; extra commands are applied after those that are due. False when it failed, or when an extra
  /// command was refused: then time has not moved, and `refusal` says why.
  bool sync_period(const std::vector<AppliedCommand>& extra, std::string& refusal);
  void fail(const std::string& reason, int exit_code);
  void end_run();
  void say_closed() const;
  void count_commands();
  void publish_clock(bool always) { clock_.publish(run_->simulation().time(), run_->stamps(), always); }
  void report();
  Phase phase() const;

  // Services; the first of each pair runs on a service thread, the second on the solver's.
  bool on_pause(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response);
  bool on_reset(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  bool on_step(Step::Request& request, Step::Response& response);
  void pause(bool paused, std_srvs::SetBool::Response& response);
  void reset(std_srvs::Trigger::Response& response);
  void step(const Step::Request& request, Step::Response& response);
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
  /// Of a run that goes on from that simulated time [ns].
  Stamps stamps_from(std::int64_t time) const;
  void leave_failed_state();

  ros::NodeHandle node_;
  const NodeParameters parameters_;
  const std::function<bool()> stop_requested_;
  const mpm::Scene scene_;
  NodeHealth health_;
  Mailbox mailbox_;
  SimClock clock_;
  BodyCommands commands_;
  ros::CallbackQueue service_callbacks_;
  std::unique_ptr<Publishers> publishers_;
  std::unique_ptr<Run> run_;
  std::unique_ptr<Pacer> pacer_;
  std::unique_ptr<NodeDiagnostics> diagnostics_;
  std::vector<ros::ServiceServer> services_;
  std::unique_ptr<ros::AsyncSpinner> service_spinner_;

  int runs_ = 0;
  bool paused_ = false;
  std::string failure_;
  bool record_lost_ = false;  // and said so
  int exit_code_ = 0;
};

}  // namespace mpm_ros
