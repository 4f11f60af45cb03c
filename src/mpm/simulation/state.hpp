// The inside of a Simulation: the objects of lower layers that make up a run. Private to this folder.
#pragma once

#include <chrono>
#include <limits>

#include "contact_on_host.hpp"
#include "energy_watch.hpp"
#include "mpm/bed/following_bed.hpp"
#include "mpm/contact/contact_reporter.hpp"
#include "mpm/mechanics/continuum.hpp"
#include "mpm/modules/run_parts.hpp"
#include "mpm/particles/sum_particles.hpp"
#include "mpm/simulation/projected.hpp"
#include "mpm/simulation/simulation.hpp"
#include "mpm/step/schedule.hpp"
#include "over_ranks.hpp"
#include "rest_on_host.hpp"

namespace mpm {

/// The straight line with the least squares through points that come one by one.
class LineFit {
 public:
  void add(double t, double y);
  /// Not a number before the second point.
  double slope() const;
  double mean() const { return mean_y_; }
  int count() const { return count_; }
  /// For checkpoints: of every metric.
  static void serialise(StateArchive& archive, std::vector<LineFit>& fits);

 private:
  int count_ = 0;
  double mean_t_ = 0.0, mean_y_ = 0.0, tt_ = 0.0, ty_ = 0.0;
};

/// Impulse and wrench that contact gives a rigid body, on the way from one sync point to the next.
struct PeriodWrench {
  double time = 0.0;                                            ///< time of the last sync point [s]
  Vec3 impulse = Vec3::Zero(), angular_impulse = Vec3::Zero();  ///< since the start, there [N s], [N m s]
  Wrench mean;                                                  ///< over the period before it
};

struct SetView;

/// Sums over particles.
struct MaterialTotals {
  double kinetic = 0.0, potential = 0.0, elastic = 0.0, plastic = 0.0;  ///< [J]
  double carried = 0.0;                                                 ///< sum of m |v| [N s]
  double min_j = std::numeric_limits<double>::infinity();               ///< smallest det F

  MaterialTotals& operator+=(const MaterialTotals& other);
};

/// Sums over the whole run; found again in the same memory.
struct RunTotals {
  MaterialTotals material;
  Vec3 momentum = Vec3::Zero();  ///< momentum of all particles, where a device finds it with the others [N s]
  EnergyReport energy;
  /// Sums of groups of one set's particles. Those of a group asleep hold until it changes (ParticleSet::rest_changes).
  struct OfGroups {
    std::vector<MaterialTotals> sums;
    std::vector<std::uint32_t> changes;  ///< values of rest_changes when they were found
    std::vector<std::uint8_t> found_asleep;
  };
  std::vector<OfGroups> of_set;
};

struct Simulation::State {
  SimulationDefinition definition;
  int threads = 1;
  Isa isa = Isa::plain;
  std::vector<std::string> warnings, notes;
  std::function<bool()> asked_to_stop;  ///< may be empty
  std::function<bool()> interrupt;      ///< as in SimulationOptions
  std::shared_ptr<Communicator> ranks;
  std::unique_ptr<OverRanks> over;  ///< over several ranks, else null
  std::function<void(const Settling&)> settling;
  TimeProfile* profile = nullptr;  ///< as in SimulationOptions

  std::vector<ParticleSet> sets;
  std::vector<std::uint64_t> sizes;  ///< size of each set, on all ranks
  std::vector<Law> laws;             ///< law of each set
  FieldMap field_map;
  Fields fields;
  std::unique_ptr<NodeChoice> choice;  ///< choice of fields by particles near cracks
  std::unique_ptr<Sorter> sorter;
  std::unique_ptr<Mechanics> mechanics;
  std::unique_ptr<Device> device;                  ///< another processor that takes the steps, else null
  std::unique_ptr<ContactOnHost> host_contact;     ///< null without a device, or rigid bodies and implicit steps
  std::unique_ptr<RestOnHost> rest_on_host;        ///< sleep in the device's steps; null without one, or sleep
  Device::Numbers fetched = Device::Numbers::all;  ///< numbers that the sets show as the device has them
  bool moved_by_device = false;                    ///< true if sets show its steps and have not been sorted since
  std::vector<RigidBody> bodies;
  std::vector<std::unique_ptr<Robot>> robots;  ///< robots, whose links are among the bodies
  Modules modules;
  std::vector<ContactReporter*> reporters;  ///< among the modules
  Services services;

  std::int64_t time = 0;  ///< [ns]
  StepReport steps;
  ImpulseAccount gravity;
  Vec3 initial_momentum = Vec3::Zero();
  double total_mass = 0.0;
  std::chrono::duration<double> wall{0.0};
  StepLimit material_limit;  ///< as surveyed at the last sync point
  StepLimit previous_limit;  ///< as surveyed at the one before
  StepLimit limit;           ///< limit of the last steps
  EnergyWatch energy_watch;
  RunTotals totals;              ///< sums when last asked for
  bool foreign_modules = false;  ///< true if the caller added modules of its own
  bool failed = false;
  std::vector<LineFit> rates;          ///< rate of each metric; those without a window stay empty
  std::vector<PeriodWrench> wrenches;  ///< wrench of each rigid body; empty where no metric is a force or a torque

  /// Brings these numbers of the sets, and accounts, up to date with the device, if there is one. All that reads them
  /// calls it before.
  void fetch(Device::Numbers which = Device::Numbers::all);
  /// Returns what work() does, which asks the device. @throws PhysicsError when that is lost, and the particles with it
  template <class Work>
  static auto ask_device(Work&& work) {
    try {
      return work();
    } catch (const ModuleError& error) {
      throw PhysicsError(error.what());
    }
  }
  /// Lets a device take the steps from here on.
  void hand_to_device(const DeviceMaker& maker);
  /// Lets modules take note of the start, as they else do in the first step.
  void begin_modules();
  /// Lets modules know what the device has done in their place.
  void tell_modules();
  /// Looks whether bodies may be where they have been put. Collective. @throws RigidError
  void check_places(const std::vector<const RigidBody*>& moved);
  /// Lets modules know of bodies that have been put elsewhere. Collective.
  void forget_contact(const std::vector<const RigidBody*>& moved);
  /// The part of set_state() for a body that is no link. @throws RigidError, when nothing is changed
  void set_body(RigidBody& body, const StateSet& set);
  /// Bodies, then moving bases of robots, by Simulation::find_commanded().
  RigidBody& commanded(int index);
  /// Layout of every field.
  const GridLayout& layout() const { return fields.front()->layout; }
  /// The shipped modules that the definition asks for, those of the caller, and the mechanics.
  /// `on_device`: whether a device will take the steps.
  void add_modules(const std::vector<AddModules>& of_caller, bool on_device);
  /// Views of each set, for particle fields (particle_view.hpp).
  std::vector<SetView> views();
  /// @throws DefinitionError for a particle field that the run does not have
  void check_field(const std::string& name);
  /// Impulse given to the material since the start by the account of that name; zero without one [N s].
  Vec3 impulse(const std::string& account) const;
  /// Numbers of all modules.
  std::vector<NamedNumber> numbers() const;
  /// At a sync point, for metrics that are forces and torques.
  void find_wrenches();
  /// Rows of the particles with ids [first, last), those of some bodies, in what read_fields() gives.
  std::pair<std::size_t, std::size_t> rows_of(std::uint64_t first, std::uint64_t last) const;
  /// The value that the first rank found.
  double from_first(double value) const;
  /// Momentum of all particles [N s].
  Vec3 momentum();
  /// Limit of the step by the material now.
  StepLimit survey_material();
  /// The same of an implicit step.
  StepLimit survey_motion() const;
  /// Limit of the step by material and modules in the sync period, when the material has gone from one limit to the
  /// other.
  /// @throws DampingError
  StepLimit step_limit(const StepLimit& before, const StepLimit& now) const;
  /// Notes what part of a cell the fastest wave crossed in a step of dt [s].
  void see_courant(double dt, const StepLimit& found);
  /// `now` [s]; `found`: what the material allows then. @throws PhysicsError when the run makes energy
  void watch_energy(double now, const StepLimit& found);
  const RunTotals& find_totals();
  /// Sums over a set's particles, which the device finds.
  MaterialTotals totals_of_device(int set);
  /// Runs to the next sync point. @throws PhysicsError, LoadError, DampingError, FunctionError, StoppedError
  void run_period();
  /// One step of the schedule, with the checks after it; it begins at `start` [s]. `more`: whether others follow in the
  /// sync period; then it returns whether the run, on any rank, is asked to stop.
  bool step(double start, double dt, bool more);
  /// Sorts, and lets particles fall asleep and wake. @throws PhysicsError for a particle that is not where it may be
  void sort(double now) { rest_on_host&& device ? sort_beside_device(now) : sort_here(now); }
  /// The same of the sets as they are here.
  void sort_here(double now);
  /// The same of the particles of a device, which takes those that are awake then (rest_on_host.cpp).
  void sort_beside_device(double now);
  /// Lets ranks meet where tools have come to, with particles as they lie.
  void meet_again();
  /// The same as the sorter: after particles have gone to their ranks, and before these meet.
  std::optional<ParticleRef> sort_particles();
  /// Ids are not those of the start without a gap: particles come and go.
  bool renews_particles() const { return services.bed != nullptr; }
  /// Puts to sleep what carries ground that follows bodies, before the first step. @throws DefinitionError
  void begin_bed();
  /// At a sync point: makes and puts away such ground. @throws PhysicsError, ModuleError
  void follow_bed();
  /// Makes the ground around the bodies that it follows, and puts away what is far.
  void bring_ground();
  /// The particles of some of it, at rest under its weight's stress.
  ParticleSet make_ground(GroundParticles ground);
  /// Ends the run on all ranks if check() throws on one of them, with its reason. @throws PhysicsError
  void check_together(const std::function<void()>& check);
  /// All that the run remembers (serialise_state.cpp).
  void serialise(StateArchive& archive);
  void serialise_particles(StateArchive& archive);
  void serialise_grid(StateArchive& archive);
  void serialise_limit(StateArchive& archive, const char* name, StepLimit& kept);
  /// Lets the bodies that start geostatic, already under their weight's stress, come to rest. Before anything is
  /// sorted. @throws PhysicsError, StoppedError
  void settle();
  /// @throws PhysicsError; over several ranks RankFailure, which ends those that know of nothing
  [[noreturn]] void end_run(const std::string& reason) const;
  [[noreturn]] void fail(const std::string& what, ParticleRef particle, double now, const std::string& remedy) const;
};

/// Places of a set's particles, in the order of their ids. `whole`: all of the set's particles are here.
std::vector<int> places_by_id(const ParticleSet& set, bool whole);

/// True if a metric is a force or a torque on a rigid body.
bool is_wrench(const MetricDefinition& metric);

/// Deformation gradient and stress of one particle as full tensors (what a geometry does not store filled in), for what
/// is not a kernel.
struct ParticleTensors {
  Matrix3<double> f;
  Symmetric3<double> tau;  ///< Kirchhoff stress over initial density [J/kg]
  double j;                ///< det f
};
ParticleTensors particle_tensors(const ParticleSet& set, GeometryKind geometry, int p);
/// Tensors that the law of an expanding particle has seen (kernel/free_strain.hpp); free strain across a plane or a
/// line counts as J of the law there, too.
ParticleTensors without_free_strain(const ParticleSet& set, int p, ParticleTensors tensors);

}  // namespace mpm
