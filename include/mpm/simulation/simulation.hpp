// The assembled run. Time advances from one sync point (integer nanoseconds) to the next by a whole number of equal
// steps; commands given at a sync point act from there on; everything that is read is read at a sync point.
//
//   auto simulation = mpm::Simulation(definition, mpm::SimulationOptions{2});
//   while (simulation.time() < end) { simulation.advance(); auto report = simulation.take_contact(0); … }
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mpm/kernel/isa.hpp"
#include "mpm/math/error.hpp"
#include "mpm/math/state_archive.hpp"
#include "mpm/simulation/definition.hpp"
#include "mpm/simulation/particle_choice.hpp"
#include "mpm/simulation/report.hpp"

namespace mpm {

/// A definition that cannot be simulated (bad input: exit code 2).
class DefinitionError : public Error {
 public:
  using Error::Error;
};

/// The physics failed (exit code 3): J <= 0, a value that is not finite, a particle outside the domain.
/// what() names the particle, the step, the place and the likely remedy.
class PhysicsError : public Error {
 public:
  using Error::Error;
};

struct RunParts;
/// Adds the modules of a physics to a run (simulation/run_parts.hpp).
using AddModules = std::function<void(RunParts&)>;

struct SimulationOptions {
  int threads = 0;              ///< 0: as many as the machine has and 4,000 particles each make worth while
  std::optional<Isa> isa = {};  ///< instruction set of the kernels; the widest one available without it
  bool settle = true;           ///< geostatic bodies come to rest first; not needed by one that takes on a checkpoint
  std::vector<AddModules> modules = {};  ///< beside the shipped ones, after them
};

class Simulation {
 public:
  /// @throws DefinitionError, GridError, IsaError, MaterialError, RigidError
  /// Takes the definition over: what it holds of each particle is freed as soon as it has been read.
  explicit Simulation(SimulationDefinition definition, SimulationOptions options = {});
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  const SimulationDefinition& definition() const;  ///< particle positions left out
  int threads() const;
  std::string isa() const;                    ///< instruction set of the kernels
  std::vector<std::string> warnings() const;  ///< one line each, found when the run was put together
  std::vector<std::string> notes() const;     ///< the same, of what was done then and went well

  std::int64_t time() const;         ///< simulated time since the start [ns]
  std::int64_t sync_period() const;  ///< [ns]
  /// Runs to the next sync point. @throws PhysicsError; the state of the failed step can still be read and saved then,
  /// and advance() throws from there on.
  void advance();

  /// Index of a rigid body, or -1.
  int find_body(const std::string& name) const;
  /// From now on, until the next command. @throws RigidError when not finite or, in an axisymmetric scene, when it
  /// would take the body off the axis, tilt or spin it; then nothing is changed. The same of poses.
  void command_velocity(int body, const Twist& twist);
  /// To be at `target` by `arrival` [ns] > time(). @throws RigidError
  void command_pose(int body, const Pose& target, std::int64_t arrival);

  /// A force on a free body, from now on until the next. What is along no axis of the geometry does nothing.
  /// @throws RigidError when not finite, or the body is not free
  void apply_wrench(int body, const Wrench& wrench);

  std::vector<BodyState> bodies() const;
  /// Of the bodies that are free, in their order: what gave them their momentum, and their energies.
  std::vector<FreeBodyReport> free_bodies() const;
  const RigidBody& rigid_body(int body) const;
  /// A number of a rigid body, by one of body_values(): "x" of its origin [m], "vz" [m/s], "wy" [rad/s], "impulse_x"
  /// that contact gave it since the start [N s]. @throws DefinitionError for an unknown name
  double body_value(int body, const std::string& name) const;
  static const std::vector<std::string>& body_values();
  /// What the material did to the body since the last call.
  ContactReport take_contact(int body);
  /// What each pair of deformable bodies that has a law of contact did to each other since the last call.
  std::vector<PairReport> take_pairs();
  SolverState state() const;
  /// The scene's own numbers, in order.
  std::vector<std::pair<std::string, double>> metrics() const;

  std::uint64_t particles() const;
  /// Names that particle_field() knows in every run, with their units: {"vx", "m/s"}, … Those that modules bring to a
  /// run join them in it (ParticleSet::brought).
  static std::vector<std::pair<std::string, std::string>> particle_fields();
  /// One value a particle, in order of id (0 … particles()-1): the same order in every call.
  /// @throws DefinitionError for an unknown name, listing those that exist.
  void particle_field(const std::string& name, std::vector<float>& values) const;
  void particle_field(const std::string& name, std::vector<double>& values) const;
  /// Several fields of the chosen particles in one pass; keeps the memory of `columns`. @throws DefinitionError
  void read_particles(const std::vector<std::string>& fields, const ParticleChoice& choice,
                      ParticleColumns& columns) const;
  /// Whether one of the fields looks at where a particle was at the start ("ux", "x0", …).
  static bool needs_start(const std::vector<std::string>& fields);
  /// Lets the particles remember where they are now, for those fields. At time zero, unless they do already: a run
  /// pays for it in memory (24 bytes a particle) and in sorting. @throws DefinitionError later on
  void keep_start();
  /// First id and one-past-last id of a deformable body.
  std::pair<std::uint64_t, std::uint64_t> body_ids(const std::string& body) const;

  /// FNV-1a over time, particle state (by id) and rigid bodies: equal bits, equal hash. What else decides the future is
  /// left out (the order of particles, what contact remembers, the next step's limit), so that runs which do the same
  /// on other grids have the same hash; of two that are in the same place by other ways the hash may part later.
  /// memory_hash() tells those apart.
  std::uint64_t state_hash() const;
  /// Of all that serialise() keeps, reports and their sums since the last call too, but for the wall time.
  std::uint64_t memory_hash();

  /// Writes to, or reads from, a checkpoint (simulation/checkpoint.hpp) all that the run's future and its reports
  /// depend on beyond the definition. At a sync point. Reading wants a Simulation of the same definition, instruction
  /// set and precision; it goes on as the one that was written, to the bit, on any number of threads. After an error it
  /// cannot go on. @throws the archive's error
  void serialise(StateArchive& archive);

 private:
  /// Of those metrics that are rates, at a sync point.
  void sample_metrics();
  /// Of all particles, in order of id. @throws DefinitionError
  void read_fields(const std::vector<std::string>& fields, std::vector<std::vector<double>>& columns) const;
  friend class GlobalQuantities;
  friend class SimulationProbe;  // of tests: single steps, of any size
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace mpm
