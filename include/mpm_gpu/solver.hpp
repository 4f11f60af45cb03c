// Steps of a run on the device: its memory, and the passes in their order. One step, strain first (USF):
//
//   sort          particles by cell, the table of blocks        where a particle has left its cell, and at first
//   momentum      m, m v, v of nodes        <-  particles       a gather by nodes
//   (average)     tau, F                    <-  particles       a cell at a time, where a body's stress is averaged
//   gradient      grad v of particles       <-  v               a gather by particles
//   (the law)     F, tau, history           <-  grad v dt       a set at a time
//   force         a, v of nodes             <-  particles       a gather by nodes; gravity and walls
//   (increments)  v of nodes               <-  v and particles  XPIC, FMPM: to particles and back, an order at a time
//   move          v, x of particles         <-  v, a            a gather by particles
//
// Strain last (USL): momentum, force, move, then momentum, gradient and the law again, from the places of the step's
// start: particles move to other places, which become theirs at the end. USAVG does half of the strain at each time.
// Implicit: momentum, the velocity with gravity and loads alone, the stage that solves the step (implicit_soil.hpp),
// move. Stages that a scene needs beside these (stage.hpp) act between the passes.
//
// Where a scene needs nothing of the host in a step, a step is recorded and replayed (replayed_steps.hpp), and the host
// waits when it looks; else it waits for the checks of each step. The bits are the same.
//
// Nothing is allocated in a step after make_room(), which is called between sync periods, but for what is recorded
// anew, and for lists of the nodes near rigid bodies and of those that moving regions hold, where they outgrow their
// room.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "mpm_gpu/cells.hpp"
#include "mpm_gpu/holds.hpp"
#include "mpm_gpu/impulses.hpp"
#include "mpm_gpu/passes.hpp"
#include "mpm_gpu/put_around.hpp"
#include "mpm_gpu/replayed_steps.hpp"
#include "mpm_gpu/stage.hpp"

namespace mpm_gpu {

/// Particles' numbers, as they lie in memory. Arrays that a scene does not need are empty.
template <class T>
struct ParticleStore {
  std::array<Buffer<double>, 3> x;
  std::array<Buffer<T>, 3> v;
  std::array<Buffer<T>, 9> f;
  std::array<Buffer<T>, 6> tau;
  std::array<Buffer<T>, kMostHistory> history;
  Buffer<double> strain_before;
  std::array<Buffer<T>, 9> affine;
  Buffer<T> mass;     ///< empty where all particles of each set have the same [kg]
  Buffer<T> surface;  ///< ParticleSet::surface; empty without cut places
  Buffer<std::uint32_t> id;
  Buffer<std::uint32_t> number;  ///< as CellTable::Places::number; empty where all of each set are here

  /// visit(buffer) for each.
  template <class Visit>
  void each(Visit&& visit) const {
    for (const auto& one : x) visit(one);
    for (const auto& one : v) visit(one);
    for (const auto& one : f) visit(one);
    for (const auto& one : tau) visit(one);
    for (const auto& one : history) visit(one);
    visit(strain_before);
    for (const auto& one : affine) visit(one);
    visit(mass);
    visit(surface);
    visit(id);
    visit(number);
  }
};

/// Choices of method of a scene.
struct Method {
  Shape shape = Shape::ugimp;
  Update update = Update::usf;
  mpm_kernel::Motion motion = mpm_kernel::kIncrement;  ///< FLIP and PIC; XPIC and FMPM; or APIC
  int order = 1;                                       ///< order of XPIC and FMPM
  bool from_start = false;                             ///< XPIC: increments are of the velocity at the step's start
  double flip = 1.0;                                   ///< fraction of FLIP; the rest is PIC
  int terms = 1;                                       ///< number of terms of exp(grad v dt)
  bool mixes = false;                     ///< FLIP is mixed with XPIC of a higher order than PIC's (mixture.hpp)
  Counting counting = Counting::nothing;  ///< numbers that are kept of what particles lose in their update
};

template <class T>
class Solver {
 public:
  /// `laws`: of each set, its index in the list of laws and the law, which is copied. The particles of the
  /// sets follow each other in the store. @throws GpuError for a law that cannot run there
  struct LawOfSet {
    std::size_t index;
    const void* law;
    std::size_t bytes;  ///< size of the law, which goes to the device as it is
  };
  Solver(const GridView& grid, int dim, const Method& method, std::vector<SetView> sets, std::vector<LawOfSet> laws,
         ParticleStore<T> particles, Executor executor);

  /// Fits the memory to where the particles are; between sync periods.
  void make_room();
  /// Makes a step of `dt` [s] that begins at `start` [s], for stages that depend on time. @throws GpuError naming a
  /// particle that has failed; nothing can be stepped after that
  void step(double dt, double start = 0.0);
  /// Waits for the steps, where the host has not waited for each. @throws GpuError as step()
  void look();
  /// False: the host waits for each step, whether or not it has to.
  void let_replay(bool replays) { may_replay_ = replays; }

  /// Lets a stage act in the steps from here on.
  void add(std::unique_ptr<Stage<T>> stage);
  const std::vector<std::unique_ptr<Stage<T>>>& stages() const { return stages_; }
  const Passes<T>& passes() const { return *passes_; }
  const ParticleStore<T>& particles() const { return store_; }
  const GridView& grid() const { return grid_; }
  const std::vector<SetView>& sets() const { return sets_; }
  /// Sums up to now, for which it waits; a caller may take some away, so that they begin again at zero.
  Impulses& impulses();
  /// State of the nodes of walls in the last step.
  const WallHolds& holds() const { return holds_; }
  WallHolds& holds() { return holds_; }
  PutAround& put_around() { return around_; }
  /// Forgets by how many lengths of periodic axes particles were put around.
  void clear_turns() { around_.clear_turns(run_); }
  /// Particles, or what walls hold, have been changed between two steps: sorts before the next one.
  void sort_next() {
    must_sort_ = true;
    recorded_dt_ = 0.0;
  }
  /// Walls will act once more in a step, after a stage that moves their nodes.
  void let_walls_act_again();
  /// The particle of a set that crosses cells the fastest, and its place along the grid's axes [m]. `cell` [m].
  struct Fastest {
    double rate;  ///< [1/s]; NaN if that of any particle is
    std::array<double, 3> place;
  };
  Fastest fastest(int set, double cell);
  /// Sums over the particles of a set.
  Totals totals(int set);
  /// Momentum of all particles along the grid's axes [N s].
  std::array<double, 3> momentum();
  /// Numbers of both up to the last look.
  long steps() const { return steps_; }
  long sorts() const { return sorts_; }
  /// Memory in use, of particles and of all [bytes].
  std::size_t particle_bytes();
  std::size_t bytes();

 private:
  /// True if no step needs anything of the host.
  bool replays() const;
  void replay(double dt);
  /// `stay`: addresses of all arrays do, and the host waits for nothing.
  void sort(bool stay);
  /// All passes of a step but its checks.
  Step<T> pass(double dt, double start, bool stay);
  [[noreturn]] void fail(std::uint32_t fault, std::uint32_t id, const double* place, long step) const;
  void average(const Step<T>& now);
  void momentum(const Step<T>& now) { passes_->momentum[method_.motion == mpm_kernel::kAffine](run_, now); }
  Step<T> view(double dt);
  /// True if strain is found at the end of a step.
  bool strains_last() const { return method_.update == Update::usl || method_.update == Update::usavg; }
  /// Lets the stages act at a hook.
  void act(mpm::Hook hook, const Step<T>& now) {
    for (auto& stage : stages_) stage->act(hook, run_, now);
  }
  /// Velocity gradient, strain and stress over `dt` of the particles, from the velocity of the nodes.
  void strain(Step<T> now, double dt);
  /// Adds the increments of XPIC and FMPM to the velocity of the nodes.
  void filter(Step<T> now);
  /// Returns what is kept of what particles lose in their update in this step.
  Counting counting(const StepSettings& settings) const;
  /// Sums the faults of the particles and, if it is counted, what they lose; there.
  void sum_checks(Counting counted);
  void check(const Step<T>& now, double start);
  template <int Dim>
  void account(double dt);
  CellTable::Places places() const {
    return {{store_.x[0].data(), store_.x[1].data(), store_.x[2].data()}, store_.id.data(), store_.number.data()};
  }

  // Sums are constexpr, so that kernels may call them, too.
  /// Faults of the particles in a step in which what they lose is counted.
  struct OfCounted {
    Faults faults;
    Taken taken;
    constexpr OfCounted& operator+=(const OfCounted& other) {
      faults += other.faults;
      taken += other.taken;
      return *this;
    }
  };
  /// The fastest of some particles.
  struct Faster {
    double rank = -1.0, rate = -1.0;  ///< the rank of a rate that is not a number is infinite
    std::uint32_t particle = 0;
    constexpr Faster& operator+=(const Faster& other) {
      if (other.rank > rank) *this = other;
      return *this;
    }
  };
  GridView grid_;
  int dim_;
  Method method_;
  std::vector<SetView> sets_;
  Buffer<SetView> sets_there_;
  std::vector<Buffer<unsigned char>> laws_;  ///< the law of each set
  ParticleStore<T> store_;
  Executor run_;
  const Passes<T>* passes_;
  std::vector<LawPass<T>> law_passes_;
  std::vector<RatePass<T>> rate_passes_;
  std::vector<TotalsPass<T>> totals_passes_;
  std::vector<AveragePass<T>> average_passes_;  ///< null for a law whose stress is not averaged
  CellTable cells_;
  WallHolds holds_;
  PutAround around_;
  long count_ = 0;
  std::array<Buffer<double>, 3> next_x_;  ///< empty with USF
  std::array<Buffer<T>, 9> gradient_;
  std::array<Buffer<T>, 3> domain_;  ///< empty of a shape function that does not stretch
  Buffer<std::uint32_t> node_, id_room_;
  Buffer<std::uint8_t> fault_;
  Buffer<double> taken_;  ///< empty where nothing is counted
  Buffer<double> place_room_;
  Buffer<T> room_;
  Buffer<double> mass_, nodal_[3];
  int held_rows_;
  bool acts_again_ = false;                            ///< true if walls act twice in a step
  Buffer<double> moved_[2];                            ///< NodeView::moved at the start and the end of a step
  Buffer<double> held_, held_more_, left_, averaged_;  ///< those of NodeView; empty where it has none
  Buffer<double> increment_;                           ///< empty without XPIC and FMPM
  Buffer<SumsOfNodes> of_nodes_;
  Buffer<Faults> of_particles_;
  Buffer<OfCounted> of_counted_;  ///< empty where nothing is counted
  Buffer<Totals> of_totals_;
  Buffer<Faster> of_faster_;
  Impulses impulses_;
  Buffer<Impulses> impulses_there_;  ///< those of the steps since the last call of impulses()
  bool counted_ = false;             ///< there was such a step
  std::vector<std::unique_ptr<Stage<T>>> stages_;
  bool may_replay_ = true;
  bool has_replayed_ = false;  ///< the last step was replayed
  bool looked_ = true;         ///< no step has been replayed since the last look
  ReplayedSteps replayed_;
  card::Recording recording_;
  double recorded_dt_ = 0.0;      ///< step that is recorded [s]
  long recorded_generation_ = 0;  ///< generation of the table of cells as it was recorded
  bool must_sort_ = true;
  long steps_ = 0, sorts_ = 0;
};

}  // namespace mpm_gpu
