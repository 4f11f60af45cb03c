// One quantity that particles carry and that flows through the grid: heat, a solute, the water of pores. With S_ip and
// G_ip of the run's shape function (GIMP notes (6.10)-(6.26); Nairn & Guilkey (2015) eq. (56)-(62) about an axis):
//
//   c_i = sum of V_p C_p S_ip,  T_i = (sum of V_p C_p T_p S_ip) / c_i     a region may prescribe T_i
//   Q_i = - sum of V_p G_ip . K_p (sum of G_jp T_j)  +  sources on nodes
//   c_i dT_i/dt = Q_i
//   T_p += sum of S_ip dT_i  (6.22), or  (1/C_p) sum of S_ip Q_i dt / V_i  (6.24)
//
// Always in FLIP's manner: a particle takes the change of the nodes and never their value, which would conduct by
// itself. What is carried scatters within a cell, most where nodes are held; laws, properties and reports see the
// nodes' value at the particle (6.26). Of second order (the default) a change is handed over as FMPM(2) does with
// velocities: what is lost on the way to particles and back is added once. In a slab of 20 cells that takes the error
// at the centre from 0.8 % to 0.5 %, most of the first being heat that held nodes draw from particles more than once.
//
// An update may be shorter or longer than what is stable in one go, Dx^2 C / (4 K) (6.32): then it is taken in stages
// on the grid, which cost a pass each, two with a tensor, and leave the mechanics its step (stages.hpp). Content is
// booked: what particles have gained is what sources, prescribed values and local gains gave, each summed where it
// arises.
//
// A particle near a crack conducts with the nodes of the fields that it chose (grid/node_choice.hpp), down the gradient
// of their values in all of these; so nothing passes between nodes that no particle joins. There the stages of an
// update run in all fields at once.
//
// nodal_flow.cpp brings it to the nodes and moves it there, handing_over.cpp back to the particles.
//
// Where blocks sleep, content_at_rest.hpp says what becomes of it (field_at_rest.cpp).
//
// Weak: first order in time where one stage is enough; values in a region hold at whole nodes; about an axis r = 0
// needs nothing, since no area is there. Source: method reference 9.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "mpm/grid/fields.hpp"
#include "mpm/math/geometry_kind.hpp"
#include "mpm/math/stopped.hpp"
#include "mpm/particles/particle_set.hpp"
#include "mpm/shape/kind.hpp"
#include "mpm/step/module.hpp"
#include "mpm/step/scalar_transfer.hpp"
#include "mpm/transport/content_at_rest.hpp"
#include "mpm/transport/definition.hpp"
#include "mpm/transport/local_gain.hpp"
#include "mpm/transport/nodal_source.hpp"
#include "mpm/transport/stages.hpp"

namespace mpm {

/// Part of a stable step: with the shape function dirac longer updates grow at nodes that a point barely reaches.
inline constexpr double kOfPoints = 0.25;

/// Values that contradict each other, or a quantity that is out of its range. what() names the place.
class TransportError : public ModuleError {
 public:
  using ModuleError::ModuleError;
};

/// Parts of a run that all quantities share; they outlive them.
struct TransportParts {
  Fields& fields;
  std::vector<ParticleSet>& sets;
  GeometryKind geometry;
  ShapeKind shape;
  int threads;
  std::vector<int> materials;            ///< for each set, its index among the definition's
  std::vector<double> densities;         ///< initial density of each set [kg/m^3]
  Vec3 gravity;                          ///< [m/s^2]
  bool cracked = false;                  ///< particles near cracks choose a field at every node
  bool sleeps = false;                   ///< the grid's masses count material asleep
  Communicator* ranks = nullptr;         ///< communicator of a run over several ranks; else null
  std::function<bool()> interrupt = {};  ///< true if the run is asked to stop; may be empty
};

class TransportedField {
 public:
  /// Gives the particles of all sets the quantity, with its value at the start.
  TransportedField(const QuantityDefinition& definition, const TransportParts& parts,
                   std::unique_ptr<ScalarTransfer> transfer);

  /// Takes the start of a set's particles from a law that has the quantity itself.
  void start_from(int set, const std::function<double(int particle)>& value);
  void add(std::unique_ptr<LocalGain> gain) {
    gain_accounts_.push_back({gain->name(), 0.0, 0.0});
    gives_to_laws_ = gives_to_laws_ || gain->gives_energy();
    gains_.push_back(std::move(gain));
  }
  void add(std::unique_ptr<NodalSource> source);

  /// Takes local gains since the last call, after strain has been computed.
  void collect();
  /// Moves the quantity over `dt`, from `start` [s], after collect(). `reported`: particles see the new value in any
  /// case, else only if something in the run needs it. @throws TransportError; StoppedError between two stages
  void update(double start, double dt, bool reported);
  /// True if a source must not wait for its update.
  bool pending() const;

  /// The longest update that one stage can take [s], (6.32); infinite where nothing conducts.
  double stable_step() const { return stable_step_; }
  /// No update may be longer [s]; infinite where only conduction limits it.
  double longest_update() const { return longest_update_; }
  Transported quantity() const { return definition_.quantity; }
  /// Over several ranks, after it was made on each: what depends on all particles.
  void share_limits(Communicator& ranks);
  const QuantityDefinition& definition() const { return definition_; }
  const TransportMaterial& material(int set) const { return definition_.materials[parts_.materials[set]]; }
  /// Values that the particles of a set carry, in its order.
  PaddedArray<double>& carried(int set) { return parts_.sets[set].brought[place_[set] + 1].values; }
  const PaddedArray<double>& carried(int set) const { return parts_.sets[set].brought[place_[set] + 1].values; }
  /// Values that laws, properties and reports see: the nodes' value at the particles (6.26), without the scatter of
  /// what is carried within a cell; and what has been gained since.
  PaddedArray<double>& values(int set) { return parts_.sets[set].brought[place_[set]].values; }
  const PaddedArray<double>& values(int set) const { return parts_.sets[set].brought[place_[set]].values; }

  // Functions for blocks that sleep, as RestPartner has them.

  /// Blocks may sleep, for the whole run. `asked`: change of the quantity that wakes a block; without it a thousandth
  /// of the range of the values that the scene gives. `after`: time of rest [s]. @throws TransportError if there is no
  /// such range
  void let_sleep(std::optional<double> asked, double after);
  bool stirs(const RestingBlock& block, double now) const;
  void falls_asleep(const RestingBlock& block);
  void wakes(const RestingBlock& block);
  void hashed(std::vector<double>& numbers) const {
    if (rest_) rest_->hashed(numbers);
  }

  /// Content that came in since the start by each source, condition and local gain.
  std::vector<ContentAccount> accounts() const;
  /// Sum over the particles here of what they hold, by its size [content]: heat above the absolute zero.
  double content() const;
  /// Content that the particles have gained since the start [content].
  double gained() const { return gained_; }
  /// True if some law has the quantity itself, and stores energy with it.
  bool gives_to_laws() const { return gives_to_laws_; }
  /// Energy that came into laws so since the start [J].
  double given_to_laws() const { return given_to_laws_; }
  void serialise(StateArchive& archive);

 private:
  enum class Number { capacity, content, conductance, volume };  ///< all over mass
  /// A node whose value is prescribed.
  struct Held {
    int field;
    NodeRef ref;
    Vec3 place;
    int condition;
    double raw;  ///< as the particles give it
  };

  void make_room();
  /// Particles may have come from other ranks and gone there.
  void fit_scratch();
  void start_values();
  void find_limit();
  /// Capacities over mass of particles [first, last).
  void find_capacities(int set, int first, int last, double* capacity) const;
  /// Conductances along the tensor's unit over mass.
  void find_conductances(int set, int first, int last, double* conductance) const;
  /// Sets the first scratch array of every set.
  void fill(Number number);
  void spread_scratch(int field, NodalField& to);
  /// Returns what flows to nodes from material asleep [content/s]. `moved`: particles have moved since their masses
  /// were gathered.
  double find_nodal_values(bool moved = false);
  void find_held();
  double prescribed(const Held& held, double time) const;
  /// Flow to the nodes down the gradient of `value` [content/s]; conductances are in the scratch arrays.
  void flow(int field, const NodalField& value, NodalField& to);
  void flow_in_all(const NodalField& value, NodalField& to);
  /// Has gradients taken to the scratch arrays.
  void take_gradients();
  /// Makes fluxes of them, by mass, to be given.
  void turn_gradients();
  void drive_by_gravity();
  /// Adds what is in `volume_`.
  void add_to_sources(int field);
  void add_volume_sources(double start, double dt);
  static double value_of(const SourceDefinition& source, const std::string& body, double time, const Vec3& place);
  /// Holds the field's own nodes, which begin with block `first` of `value`.
  void hold(int field, NodalField& value, double time, int first = 0) const;
  void conduct(int field, double start, double dt);
  void conduct_in_all(double start, double dt);
  void begin_conduction(int field, double start);
  void end_conduction(int field, double start, double dt, const NodalField& came, int first = 0);
  void sharpen();
  void finish(double start, double dt, bool sees);
  void follow_ramps(double start, double dt);
  void check_range() const;
  bool is_fed(const RestingBlock& block) const;
  /// Gives nodes of a field the share of what is asleep there; what flows to them from it [content/s].
  double join_at_rest(int field);
  /// Keeps what has come to these nodes for it.
  void keep_for_rest(int field);
  void watch_rest(double now, double dt);
  void find_values_at_rest();
  void add_flow_at_rest(const RestingBlock& block, ContentAtRest::Tile& tile);
  /// @throws StoppedError
  void ask_to_stop();

  QuantityDefinition definition_;
  TransportParts parts_;
  std::unique_ptr<ScalarTransfer> transfer_;
  std::vector<std::size_t> place_;  ///< for each set, place in ParticleSet::brought of what is seen, before the carried
  bool reads_nodes_ = false;        ///< true if anything but a report needs what is seen
  bool flows_ = false, conducts_ = false, anisotropic_ = false, gravity_driven_ = false;
  std::optional<double> one_capacity_;  ///< capacity of all material, over its mass
  double stable_step_ = 0.0, longest_update_ = 0.0;
  double least_of_volume_ = std::numeric_limits<double>::infinity();  ///< capacity of a volume
  double least_capacity_ = std::numeric_limits<double>::infinity();   ///< capacity of a particle [content/quantity]
  /// Lowest and highest of the values that the scene gives.
  double lowest_ = std::numeric_limits<double>::infinity(), highest_ = -std::numeric_limits<double>::infinity();
  std::vector<std::unique_ptr<LocalGain>> gains_;
  std::vector<std::unique_ptr<NodalSource>> sources_;
  std::vector<NodalQuantity> nodes_;  ///< nodes of each velocity field
  std::vector<NodalField> rooms_;     ///< V_i of each velocity field, for (6.24)
  NodalField volume_;                 ///< scratch
  Stages stages_;
  /// Nodes for particles near cracks that join fields: those of all, field by field, for the stages, and of each for a
  /// stage.
  struct Joined {
    std::vector<int> first;  ///< block of each field, and one more for the end
    NodalField value, capacity;
    std::vector<NodalField> values, flows;
  };
  std::optional<Joined> joined_;
  std::vector<Held> held_;
  std::uint64_t generation_ = 0;                             ///< generation of the blocks that held_ is of
  std::vector<std::array<PaddedArray<double>, 3>> scratch_;  ///< scratch of each set, vectors_ of them in use
  int vectors_ = 0;
  ScalarTransfer::Given given_;
  ScalarTransfer::Taken taken_;
  std::vector<double> sums_;
  ContentAccount prescribed_, volume_sources_;
  std::vector<ContentAccount> gain_accounts_;
  double gained_ = 0.0, given_to_laws_ = 0.0;
  bool gives_to_laws_ = false;
  std::uint32_t asked_ = 0;

  // Members for blocks that sleep.
  std::optional<ContentAtRest> rest_;
  std::vector<Box> changing_;      ///< bounds of regions whose values change with time
  std::vector<double> changes_;    ///< scratch: fastest change of each owner of a field
  NodalField around_;              ///< scratch: nodes of the blocks around one
  double updated_ = 0.0;           ///< end of the last update [s]
  std::uint64_t rests_since_ = 0;  ///< generation of the blocks for which values at rest were found
  ContentAccount at_rest_;         ///< content that flowed steadily from and to material asleep
};

/// "(1, 0, 2) m"
std::string text_of(const Vec3& place);
/// J of particles [first, last) of a set.
void find_volume_ratios(const ParticleSet& set, GeometryKind geometry, int first, int last, double* j);

}  // namespace mpm
