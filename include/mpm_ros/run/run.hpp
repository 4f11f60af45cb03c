// One run of a scene from time zero, with everything that belongs to it: simulation, outputs, bag, and the commands
// that it was given. Knows nothing of a ROS master, pacing or services.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "mpm/advice/scene_warnings.hpp"
#include "mpm/checkpoint/checkpoint.hpp"
#include "mpm/scene/scene.hpp"
#include "mpm/simulation/device_choice.hpp"
#include "mpm/simulation/simulation.hpp"
#include "mpm_ros/command/body_command.hpp"
#include "mpm_ros/command/joint_command.hpp"
#include "mpm_ros/message/stamps.hpp"
#include "mpm_ros/record/bag_recorder.hpp"
#include "mpm_ros/record/run_outputs.hpp"
#include "mpm_ros/run/budget_watch.hpp"

namespace mpm_ros {

struct RunOptions {
  int threads = 0;
  std::string isa = "auto";   ///< instruction set; auto: the widest one available
  mpm::DeviceRequest device;  ///< processor that takes the steps
  OutputOptions output;
  std::string bag;  ///< path to write; empty: none
  BagOptions bag_options;
  std::string parameters;      ///< for RunInfo, YAML
  std::string resume;          ///< checkpoint that it goes on from; empty: none
  mpm::SerialiseMore more;     ///< data that the caller keeps beside, in that checkpoint
  std::function<bool()> stop;  ///< as mpm::SimulationOptions has it
  std::function<void(const mpm::Settling&)> settling;
  /// That compute the run together; null: this process alone. Each has a Run; the first one has all bags and sinks, and
  /// every function of them all is called on all of them. Where the first leads (led_run.hpp) it calls those of others.
  std::shared_ptr<mpm::Communicator> ranks;
  mpm::TimeProfile* profile = nullptr;  ///< as mpm::SimulationOptions has it; with what the run and its outputs take
};

class Run {
 public:
  /// Builds the simulation, on the processor that is asked for; opens the bag. `live`: a sink beside the bag, or null;
  /// must outlive the run.
  /// @throws mpm::Error for what cannot be simulated, or resumed; BagError
  Run(const mpm::Scene& scene, const RunOptions& options, const Stamps& stamps, MessageSink* live);

  virtual ~Run() = default;
  Run(const Run&) = delete;
  Run& operator=(const Run&) = delete;

  /// One more sink beside the bag, before begin(); it must outlive the run.
  void add(MessageSink& sink) { outputs_.add(sink); }
  /// Writes static content and the state at time zero, or of the checkpoint.
  virtual void begin();
  /// Saves a checkpoint of the present sync point. `more`: what the caller keeps beside. With a `failure`: of the state
  /// that it left, which can be looked at but not resumed. @throws mpm::CheckpointError, also when the run was cut
  /// short
  virtual mpm::CheckpointAbout save(const std::string& path, const mpm::SerialiseMore& more = {},
                                    const std::string& failure = {});
  /// Applies a command at the present sync point, and writes it. @throws mpm::RigidError; then nothing is changed.
  virtual void apply(const AppliedCommand& command);
  /// The same of a command to joints; `again`: one that was recorded as it was applied.
  void apply(const JointOrder& order, bool again = false);
  /// Sets the state of a body or a robot at the present sync point, and writes it. @throws mpm::RigidError; then
  /// nothing is changed.
  virtual void set_state(const mpm::StateSet& state);
  /// Runs to the next sync point and writes what is due. @throws mpm::PhysicsError; call fail() then. @throws BagError
  /// @throws mpm::StoppedError; finish() then ends the record with the sync point before. `late`: as in
  /// mpm::Simulation::advance().
  virtual void advance(std::chrono::steady_clock::duration late = {});
  /// Returns what should be known of the run since the last call, a line each: a rigid body that has left the grid, a
  /// crack's tip that has lost its J or grows no more, forces that time.budget makes worse.
  std::vector<std::string> take_warnings();
  /// Forgets the wall time since the last advance(): after a pause.
  void resume_clock() { clock_ = std::chrono::steady_clock::now(); }
  /// Writes the last state, and closes the bag. Nothing when done before. @throws BagError
  /// @throws mpm::PhysicsError where the state is lost with a device; call fail() then.
  virtual void finish();
  /// The same for the state that a PhysicsError left behind; the last solver state says why, in one line. Where the
  /// state is lost that is the last one that was written.
  virtual void fail(const std::string& reason);
  /// Commands that were late, refused and dropped so far, for the solver states.
  void count_commands(std::uint64_t late, std::uint64_t refused, std::uint64_t dropped) {
    outputs_.count_commands(late, refused, dropped);
  }
  /// Sync periods that came too late so far, for the same.
  void count_overruns(std::uint64_t overruns) { outputs_.count_overruns(overruns); }

  mpm::Simulation& simulation() { return simulation_; }
  const mpm::Simulation& simulation() const { return simulation_; }
  const RunOutputs& outputs() const { return outputs_; }
  const Stamps& stamps() const { return stamps_; }
  /// [ns]; 0: it runs until it is stopped
  std::int64_t end() const { return end_; }
  bool closed() const { return closed_; }
  /// One of several ranks has failed alone: they can do nothing together any more.
  virtual bool parted() const { return false; }
  /// Closes the bag as it is, on this rank alone. Nothing when closed before. @throws BagError
  void close_record();
  /// It was stopped between two sync points: its state is of neither, and is not to be saved or told of.
  bool cut_short() const { return cut_short_; }
  bool ended() const { return end_ > 0 && simulation_.time() >= end_; }
  /// True after fail() if a device had the state and cannot be read any more: nothing more can be told of the run.
  bool state_lost() const { return state_lost_; }
  /// Name of the processor that takes the steps where this one does not, else empty.
  const std::string& device() const { return steps_by_.device; }
  /// One line on its choice, or empty.
  const std::string& device_note() const { return steps_by_.note; }
  /// Simulated over wall time so far.
  double real_time_factor() const;
  /// Wall time of the run, while not paused [s].
  double wall_seconds() const { return std::chrono::duration<double>(wall_).count(); }
  /// Null when none is written.
  const BagRecorder* recorder() const { return recorder_.get(); }
  /// The bag's path, and how many parts it has when it is split; empty when none is written.
  std::string bag() const;

 private:
  /// Lets the bag begin another part where one is due.
  void close_part();
  void close(const std::string& failure);
  /// True if a rigid body, with the sphere around its box, lies wholly beside the grid; one that has no end does not.
  bool outside(const mpm::RigidBody& body) const;
  void look_for_lost_bodies();
  void look_for_fast_bodies();
  void look_for_lost_tips();
  void look_for_soft_sweeps();
  /// Data that a checkpoint holds beside the simulation.
  void serialise(mpm::StateArchive& archive, const mpm::SerialiseMore& more);

  const mpm::Scene& scene_;
  const int threads_asked_;
  const Stamps stamps_;
  mpm::TimeProfile* const profile_;  ///< as in RunOptions
  mpm::StepsBy steps_by_;
  mpm::Simulation simulation_;
  const std::string parameters_;
  const std::int64_t end_;
  std::unique_ptr<BagRecorder> recorder_;
  RunOutputs outputs_;
  std::chrono::steady_clock::time_point clock_;
  std::chrono::steady_clock::duration wall_{};  // while not paused
  std::int64_t from_ = 0;                       // [ns] simulated time of the checkpoint
  enum class Place : std::uint8_t { outside_yet, inside, lost };
  std::vector<Place> places_;  // places of the rigid bodies
  const mpm::SlowestWave slowest_wave_;
  std::vector<bool> told_of_speed_;  // true for each of the rigid bodies that was told of
  struct ToldOfTip {
    bool no_j = false, stopped = false;
  };
  std::vector<ToldOfTip> told_of_tips_;
  bool told_of_sweeps_ = false;
  BudgetWatch budget_watch_;
  std::vector<std::string> warnings_;
  struct Jump {
    std::string what;  ///< as jump_of() says it
    std::int64_t arrival = 0;
  };
  Jump jump_;  ///< the last one that was commanded
  bool resumed_ = false;
  bool cut_short_ = false;   // stopped between two sync points
  bool state_lost_ = false;  // with the device that had it
  bool closed_ = false;
};

}  // namespace mpm_ros
