// Outputs of a run and their times: turns the simulation's state at sync points into messages and hands them to sinks.
// Contact, cracks, robots, volumes and the ground have writers of their own; here is when each of them writes.
// The node and run_scene share it, so that a bag is the same whichever of them wrote it.
//
//   RunOutputs outputs(simulation, stamps, options);
//   outputs.add(recorder);
//   outputs.begin(run_info);
//   while (…) { apply(command, simulation); outputs.command(command); simulation.advance(); outputs.sync(false, 1.0); }
//   outputs.finish(1.0);
//
// Over several ranks every one of them has its outputs. Most sinks are the first rank's, and what has to be read from
// all is read on all; those that take each rank's own particles are on every one. A sink that fails ends the message
// that it gets, and the call is over on all ranks together.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mpm/implicit/sweep_budget.hpp"
#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"
#include "mpm_ros/command/body_command.hpp"
#include "mpm_ros/command/joint_command.hpp"
#include "mpm_ros/command/set_state.hpp"
#include "mpm_ros/message/contact_average.hpp"
#include "mpm_ros/message/local_frame.hpp"
#include "mpm_ros/message/message_sink.hpp"
#include "mpm_ros/message/particle_cloud.hpp"
#include "mpm_ros/message/stamps.hpp"
#include "mpm_ros/record/contact_outputs.hpp"
#include "mpm_ros/record/crack_outputs.hpp"
#include "mpm_ros/record/ground_outputs.hpp"
#include "mpm_ros/record/output_sinks.hpp"
#include "mpm_ros/record/robot_outputs.hpp"
#include "mpm_ros/record/volume_outputs.hpp"

namespace mpm_ros {

struct OutputOptions {
  ParticleSelection particles;
  double particle_period = 0.0;  ///< [s] simulated, rounded to sync periods; 0: at every sync point
  double particle_first = 0.0;   ///< [s] of the first cloud after that of the start, from which periods count
  double wrench_period = 0.0;    ///< [s] of contact forces, wrenches, bodies, solver state, transforms; 0: the same
  double wrench_cutoff = 0.0;    ///< [Hz] of the filtered wrenches; 0: there are none
  std::vector<mpm::GlobalQuantity> global;
  double global_period = 0.0;  ///< [s] simulated, rounded to sync periods; 0: at every sync point
  std::optional<mpm::GroundOutput> ground;
  std::string world_frame = "world";
  /// Frames that somebody else publishes: a body of such a name has no transform in /tf. Empty names do not count.
  std::vector<std::string> others;
  double force_scale = 0.0;  ///< scale of contact arrows [m/N]; 0: by the largest force met
  bool state_hash = false;   ///< in every solver state, not in the last alone
};

/// As the scene's `output` says.
OutputOptions output_options(const mpm::Scene& scene);

/// Information on what made a run. `parameters`: what the caller was given beside the scene, as YAML.
RunInfo run_info(const mpm::Scene& scene, const mpm::Simulation& simulation, const Stamps& stamps,
                 const std::string& parameters);

class RunOutputs {
 public:
  /// Both must outlive it. The simulation stands at its start. @throws mpm::DefinitionError for a global quantity that
  /// is not there, or a cutoff that is not below half of the sync points' rate
  RunOutputs(mpm::Simulation& simulation, const Stamps& stamps, OutputOptions options);

  /// Sinks are kept by reference. Add them before begin().
  void add(MessageSink& sink) { sinks_.add(sink); }
  /// Static content, and the state at the start.
  void begin(const RunInfo& info);
  /// The same for a run that goes on from a checkpoint: averages that are under way go on.
  void begin_again(const RunInfo& info);
  /// For checkpoints: averages since the last messages, and counts of commands.
  void serialise(mpm::StateArchive& archive);
  /// A command that was applied just now. Over several ranks a sink that fails is told of by the next sync().
  void command(const AppliedCommand& command);
  void command(const JointOrder& order);
  /// A state that was set just now.
  void state_set(const mpm::StateSet& state);
  /// After each advance. `last`: the run ends here, so everything is written, with the state hash.
  /// `real_time_factor`: simulated over wall time so far.
  void sync(bool last, double real_time_factor);
  /// For a run that ends between: writes the last state with its hash, unless sync() did. `failure`: why the run cannot
  /// go on, one line; then the state of the failure is written whole, and marked. Empty: the run was stopped.
  void finish(double real_time_factor, const std::string& failure = {});
  /// For a run whose state cannot be read any more: writes the solver state that was written last again, with the
  /// failure.
  void fail_unread(const std::string& failure);
  /// For the solver states from now on.
  void count_commands(std::uint64_t late, std::uint64_t refused, std::uint64_t dropped);
  void count_overruns(std::uint64_t overruns) { overruns_ = overruns; }

  /// The solver state as it was written last.
  const SolverState& solver_state() const { return state_; }
  /// Contacts over the last sync period.
  const Contacts& contacts() const { return contacts_.last(); }
  ContactForces contact_forces(const Contacts& contacts) const { return contacts_.message(contacts); }
  BodyStates body_states() const;
  ros::Time stamp() const { return sinks_.stamp(); }
  /// Frame of clouds and markers.
  const LocalFrame& local_frame() const { return local_; }
  /// After a checkpoint was loaded. @throws mpm::CheckpointError, which names it, where the particles do not remember
  /// what the chosen fields and global quantities need
  void check_fields(const std::string& checkpoint) const;

 private:
  /// To the sinks that take those of their own rank, or to the others.
  void write_particles(bool own);
  /// Takes the steps that a budget cut in the last sync period.
  void read_cuts();
  /// Writes what does not change: places of frames, shapes.
  void write_static();
  void write_bodies();
  void write_state(bool with_hash, double real_time_factor);
  void write_particles();
  void write_global();
  bool particles_due() const;

  mpm::Simulation& simulation_;
  const Stamps& stamps_;
  const OutputOptions options_;
  const std::int64_t particle_period_;  // [ns]
  const std::int64_t particle_first_;   // [ns]
  const std::int64_t wrench_period_;    // [ns]
  const std::int64_t global_period_;    // [ns]
  OutputSinks sinks_;
  const LocalFrame local_;
  ParticleCloud cloud_;
  mpm::GlobalQuantities global_;
  GlobalQuantities global_message_;
  ContactOutputs contacts_;
  CrackOutputs cracks_;
  RobotOutputs robots_;
  VolumeOutputs volumes_;
  GroundOutputs ground_;
  SolverState state_;
  std::vector<mpm::CutStep> cuts_;  // since the last solver state
  std::uint64_t applied_ = 0;       // commands
  std::uint64_t late_ = 0;
  std::uint64_t refused_ = 0;
  std::uint64_t dropped_ = 0;
  std::uint64_t overruns_ = 0;
  std::int64_t particles_at_ = -1;  // [ns] when they were written last
  bool global_kept_ = false;        // its means go on from a checkpoint
  std::int64_t global_at_ = -1;     // [ns] the same
  bool finished_ = false;
};

}  // namespace mpm_ros
