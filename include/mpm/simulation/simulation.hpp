// The assembled run. Time advances from one sync point (integer nanoseconds) to the next by a whole number of
// steps, equal unless they have to get shorter on the way; commands given at a sync point act from there on; all
// reports are those of a sync point.
//
//   mpm::Simulation simulation(mpm::load_scene("blade_in_soil"));  // or a SimulationDefinition
//   while (simulation.time() < end) { simulation.advance(); auto report = simulation.take_contact(0); … }
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mpm/definition/definition.hpp"
#include "mpm/definition/particle_choice.hpp"
#include "mpm/definition/report.hpp"
#include "mpm/kernel/isa.hpp"
#include "mpm/loop/profile.hpp"
#include "mpm/math/error.hpp"
#include "mpm/math/state_archive.hpp"
#include "mpm/math/stopped.hpp"
#include "mpm/ranks/communicator.hpp"
#include "mpm/robot/joint_target.hpp"
#include "mpm/robot/robot_report.hpp"
#include "mpm/step/device.hpp"

namespace mpm {

struct CutStep;
struct StateSet;
class SweepBudget;

/// The physics failed (exit code 3): J <= 0, a value that is not finite, a particle outside the domain.
/// what() names the particle, the step, the place and the likely remedy. Also thrown where a device that has the
/// particles is lost (SimulationOptions::device): by advance(), and by all that reads them from then on.
class PhysicsError : public Error {
 public:
  using Error::Error;
};

/// A device that is not there, or cannot begin a run, as for lack of memory. what() is one sentence with a remedy.
class DeviceError : public Error {
 public:
  using Error::Error;
};

/// Distance of a geostatic start from rest.
struct Settling {
  std::uint64_t steps = 0;  ///< steps of settling so far
  double unbalanced = 0.0;  ///< force over the weight, when last at rest; infinite before
  double wanted = 0.0;      ///< at which the soil has settled
};

struct RunParts;
/// Adds the modules of a physics to a run (modules/run_parts.hpp).
using AddModules = std::function<void(RunParts&)>;

/// Maker of the processor that takes the steps of a run (step/device.hpp).
struct DeviceMaker {
  std::string name;  ///< name of the processor in records, as its maker has it
  /// Makes it, from the particles of the assembled run and for its modules. @throws Error where it cannot take them
  std::function<std::unique_ptr<Device>(const SimulationDefinition&, const std::vector<ParticleSet>&, RunModules)> make;
};

struct SimulationOptions {
  int threads = 0;                       ///< 0: as many as the machine has, with at least 4,000 particles each
  std::optional<Isa> isa = {};           ///< instruction set of the kernels; without it the widest one available
  bool settle = true;                    ///< settle geostatic bodies first; not needed before a checkpoint is loaded
  std::vector<AddModules> modules = {};  ///< added after the shipped ones
  std::function<bool()> stop = {};       ///< asked after every step; true: the step was the last, see StoppedError
  std::function<void(const Settling&)> settling = {};  ///< told after every step of settling
  /// The ranks that compute the run together; null: this process alone. Then every function of the simulation whose
  /// result depends on particles is collective, and particle fields are given to the first rank alone. A definition
  /// that has been built for ranks has each rank's own particles; of any other every rank has all, and leaves its own.
  std::shared_ptr<Communicator> ranks = {};
  /// Asked where `stop` is not: often while the run is put together, and between the stages of a step that has many;
  /// true: it ends at once, see StoppedError.
  std::function<bool()> interrupt = {};
  /// Counts where the wall time of steps goes; null: nowhere. It outlives the simulation.
  TimeProfile* profile = nullptr;
  /// Another processor, which takes all steps; none: this one does. What it cannot have stands in the table of
  /// features (rules/feature_rules.hpp); nor does it reach modules of the caller. simulation/device_choice.hpp chooses.
  std::optional<DeviceMaker> device = {};
};

class Simulation {
 public:
  /// @throws DefinitionError, DeviceError, GridError, IsaError, MaterialError, RigidError; StoppedError when asked to
  /// stop
  /// Takes over the definition, whose particle data are freed as soon as they have been read.
  explicit Simulation(SimulationDefinition definition, SimulationOptions options = {});
  /// Makes the simulation of a scene (scene/scene.hpp), which lies in a layer above: its build() is found where the
  /// scene is declared.
  /// @throws SceneError, and what the other constructor throws
  template <class AnyScene, class Built = decltype(build(std::declval<const AnyScene&>()))>
  explicit Simulation(const AnyScene& scene, SimulationOptions options = {})
      : Simulation(Built(build(scene, options.ranks.get(), options.interrupt)), options) {}
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  const SimulationDefinition& definition() const;  ///< particle positions left out
  int threads() const;
  /// Over several ranks, else null.
  Communicator* ranks() const;
  /// True if it holds on any rank.
  bool on_any_rank(bool own) const;
  std::string isa() const;                    ///< instruction set of the kernels
  std::vector<std::string> warnings() const;  ///< one line each, found when the run was put together
  std::vector<std::string> notes() const;     ///< one line each, on choices made when the run was put together

  std::int64_t time() const;         ///< simulated time since the start [ns]
  std::int64_t sync_period() const;  ///< [ns]
  /// Runs to the next sync point. @throws PhysicsError; the state of the failed step can still be read and saved then,
  /// and advance() throws from there on. @throws StoppedError; advance() throws from there on.
  /// `late`: how much of the wall time that a budget gives the sync period has gone already.
  void advance(std::chrono::steady_clock::duration late = {});

  /// Index of a rigid body, or -1.
  int find_body(const std::string& name) const;
  /// Index of what can be commanded to move, or -1: a rigid body, or after all of these a robot whose base moves, by
  /// the robot's name. Commands below take it as `body`, and rigid_body() has its pose and twist.
  int find_commanded(const std::string& name) const;
  /// All of these, in that order.
  std::vector<BodyState> commanded() const;
  /// Prescribes a velocity from now on, until the next command. @throws RigidError when not finite or, in an
  /// axisymmetric scene, when it would take the body off the axis, tilt or spin it; then nothing is changed.
  void command_velocity(int body, const Twist& twist);
  /// Prescribes that the body reaches `target` at `arrival` [ns] > time(). @throws RigidError as command_velocity()
  void command_pose(int body, const Pose& target, std::int64_t arrival);

  /// Applies a wrench to a free body, from now on until the next one. Components that the geometry does not have are
  /// ignored.
  /// @throws RigidError when not finite, or the body is not free
  void apply_wrench(int body, const Wrench& wrench);

  /// Sets pose and twist of a rigid body, or base and joints of a robot, at the present sync point
  /// (simulation/state_set.hpp). Contact forgets what it knows of what has moved, material asleep there wakes, and the
  /// accounts of free bodies and robots have what they gain. Collective.
  /// @throws RigidError, when nothing is changed: no such body, robot or joint; a pose, twist or position that it
  /// cannot have; more than half a cell of material in it
  void set_state(const StateSet& set);

  std::vector<BodyState> bodies() const;
  /// Balances of momentum and energies of the free bodies, in their order.
  std::vector<FreeBodyReport> free_bodies() const;

  /// Robots as they are at the present sync point.
  std::vector<RobotReport> robots() const;
  /// Index of a robot by its name, -1 without one.
  int find_robot(const std::string& name) const;
  /// Index of a robot's joint that can be commanded. @throws RigidError with the nearest name
  int find_joint(int robot, const std::string& joint) const;
  /// Commands joints from now on, each by the kind of its drive: velocity, position or effort. A position that a rigid
  /// drive is to reach is approached until `arrival` [ns], or the next sync point where that is later.
  /// @throws RigidError when not finite, or outside the joint's limits; nothing is changed then
  void command_joints(int robot, const std::vector<int>& joints, const std::vector<double>& values,
                      std::int64_t arrival);
  /// Lets joints follow a trajectory each, whose knots are in simulated time [s]. @throws RigidError as
  /// Robot::check_trajectory() does; nothing is changed then
  void follow_trajectory(int robot, const std::vector<int>& joints, std::vector<std::vector<JointKnot>> knots);
  /// @throws std::out_of_range
  const RigidBody& rigid_body(int body) const;
  /// A number of a rigid body, by one of the names in body_values(): "x" of its origin [m], "vz" [m/s], "wy" [rad/s],
  /// "impulse_x" of contact on it since the start [N s]. @throws DefinitionError for an unknown name
  double body_value(int body, const std::string& name) const;
  static const std::vector<std::string>& body_values();
  /// The explicit cracks and their tips; empty without any.
  std::vector<CrackReport> cracks() const;
  std::vector<CrackTipReport> crack_tips() const;
  /// Material in the volumes of the scene, in its order; empty without any.
  std::vector<VolumeReport> volumes() const;
  /// Account of what time.budget has done to implicit steps (implicit/sweep_budget.hpp); null without one.
  const SweepBudget* budget() const;
  /// Ends the sweeps of these steps as they ended in another run, in place of the clock. Ignored without a budget.
  void repeat_cuts(const std::vector<CutStep>& steps);
  /// Numbers that modules report, as in state().
  std::vector<NamedNumber> numbers() const;
  /// The action of the material on the body since the last call.
  ContactReport take_contact(int body);
  /// The action on each other of each pair of deformable bodies with a law of contact, since the last call.
  std::vector<PairReport> take_pairs();
  SolverState state() const;
  /// The scene's own numbers, in order.
  std::vector<std::pair<std::string, double>> metrics() const;

  std::uint64_t particles() const;
  /// Over several ranks; collective.
  SharingReport sharing() const;
  /// Names that particle_field() knows in every run, with their units: {"vx", "m/s"}, … In a run it also knows those
  /// that its modules add (ParticleSet::brought).
  static std::vector<std::pair<std::string, std::string>> particle_fields();
  /// One value for each particle, in order of id (0 … particles()-1, but where ground follows bodies, whose particles
  /// come and go): the same order in every call.
  /// @throws DefinitionError for an unknown name, listing those that exist.
  void particle_field(const std::string& name, std::vector<float>& values) const;
  void particle_field(const std::string& name, std::vector<double>& values) const;
  /// Several fields of the chosen particles in one pass; keeps the memory of `columns`. @throws DefinitionError
  void read_particles(const std::vector<std::string>& fields, const ParticleChoice& choice,
                      ParticleColumns& columns) const;
  /// The same of this rank's own particles, as they lie in memory; in one process, of all.
  void read_own_particles(const std::vector<std::string>& fields, const ParticleChoice& choice,
                          ParticleColumns& columns) const;
  /// True if one of the fields needs the particles' positions at the start ("ux", "x0", …).
  static bool needs_start(const std::vector<std::string>& fields);
  /// Stores the particles' present positions for those fields, unless they are stored already. This costs memory (24
  /// bytes for each particle) and time in sorting. @throws DefinitionError after time zero
  void keep_start();
  /// First id and one-past-last id of a deformable body.
  std::pair<std::uint64_t, std::uint64_t> body_ids(const std::string& body) const;

  /// FNV-1a over time, particle state (by id) and rigid bodies: equal bits, equal hash. Other state on
  /// which the future depends is left out (the order of particles, the memory of contact, the next step's limit), so
  /// that runs which do the same on other grids have the same hash. Two runs with equal hashes may therefore differ
  /// later; memory_hash() distinguishes them.
  std::uint64_t state_hash() const;
  /// Hash over all that serialise() writes, including reports and their sums since the last call, without the wall
  /// time.
  std::uint64_t memory_hash();

  /// Writes to, or reads from, a checkpoint (checkpoint/checkpoint.hpp) all that the run's future and its reports
  /// depend on beyond the definition. To be called at a sync point. Reading requires a Simulation of the same
  /// definition, instruction set and precision; it then continues like the one that was written, to the bit, on any
  /// number of threads. After an error it cannot go on. @throws the archive's error
  void serialise(StateArchive& archive);

 private:
  /// Value of a metric now. `values`: memory to use.
  double statistic_of(const MetricDefinition& metric, std::vector<double>& values) const;
  /// Adds a value, at a sync point, to the metrics that are rates.
  void sample_metrics();
  /// Reads fields of all particles, in order of id; over several ranks of this rank's own, one body after another.
  /// @throws DefinitionError
  void read_fields(const std::vector<std::string>& fields, std::vector<std::vector<double>>& columns) const;
  friend class GlobalQuantities;
  friend class SimulationProbe;  // part of tests: single steps, of any size
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace mpm
