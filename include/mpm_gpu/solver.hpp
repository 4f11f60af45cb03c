// Steps of a run on the device: its memory, and the passes in their order. One step (USF):
//
//   sort          particles by cell, the table of blocks        where a particle has left its cell, and at first
//   momentum      m, m v, v of nodes        <-  particles       a gather by nodes
//   gradient      grad v of particles       <-  v               a gather by particles
//   (the law)     F, tau, history           <-  grad v dt       a set at a time
//   force         a, v of nodes             <-  particles       a gather by nodes; gravity and walls
//   move          v, x of particles         <-  v, a            a gather by particles
//
// Nothing is allocated in a step after make_room(), which is called between sync periods.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mpm_gpu/cells.hpp"
#include "mpm_gpu/passes.hpp"

namespace mpm_gpu {

/// Particles' numbers, as they lie in memory. Arrays that a scene does not need are empty.
template <class T>
struct ParticleStore {
  std::array<Buffer<double>, 3> x;
  std::array<Buffer<T>, 3> v;
  std::array<Buffer<T>, 9> f;
  std::array<Buffer<T>, 6> tau;
  std::array<Buffer<T>, kMostHistory> history;
  Buffer<std::uint32_t> id;

  /// visit(buffer) for each.
  template <class Visit>
  void each(Visit&& visit) const {
    for (const auto& one : x) visit(one);
    for (const auto& one : v) visit(one);
    for (const auto& one : f) visit(one);
    for (const auto& one : tau) visit(one);
    for (const auto& one : history) visit(one);
    visit(id);
  }
};

/// Impulses on the material since the start [N s], along the grid's axes.
struct Impulses {
  double walls[3] = {}, gravity[3] = {};
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
  Solver(const GridView& grid, int dim, Shape shape, double flip, int terms, std::vector<SetView> sets,
         std::vector<LawOfSet> laws, ParticleStore<T> particles, Executor executor);

  /// Fits the memory to where the particles are; between sync periods.
  void make_room();
  /// Makes a step of `dt` [s]. @throws GpuError naming a particle that has failed; nothing can be stepped after that
  void step(double dt);

  const ParticleStore<T>& particles() const { return store_; }
  const std::vector<SetView>& sets() const { return sets_; }
  const Impulses& impulses() const { return impulses_; }
  /// Momentum of all particles along the grid's axes [N s].
  std::array<double, 3> momentum();
  long steps() const { return steps_; }
  long sorts() const { return sorts_; }
  /// Memory in use, of particles and of all [bytes].
  std::size_t particle_bytes();
  std::size_t bytes();

 private:
  void sort();
  StepView<T> view(double dt);
  void check();
  void account(double dt);
  std::array<const double*, 3> places() const { return {store_.x[0].data(), store_.x[1].data(), store_.x[2].data()}; }

  // Sums are constexpr, so that kernels may call them, too.
  /// Sums of the nodes in a step.
  struct OfNodes {
    double held[3], mass;
    constexpr OfNodes& operator+=(const OfNodes& other) {
      for (int k = 0; k < 3; ++k) held[k] += other.held[k];
      mass += other.mass;
      return *this;
    }
  };
  /// Faults of the particles in a step; numbers of the first ones.
  struct OfParticles {
    static constexpr std::uint32_t kNone = 0xffffffffU;
    bool left = false;
    std::uint32_t outside = kNone, inverted = kNone;
    constexpr OfParticles& operator+=(const OfParticles& other) {
      left = left || other.left;
      outside = outside < other.outside ? outside : other.outside;
      inverted = inverted < other.inverted ? inverted : other.inverted;
      return *this;
    }
  };
  struct Momentum {
    double p[3] = {};
    constexpr Momentum& operator+=(const Momentum& other) {
      for (int k = 0; k < 3; ++k) p[k] += other.p[k];
      return *this;
    }
  };

  GridView grid_;
  int dim_;
  double flip_;
  int terms_;
  std::vector<SetView> sets_;
  Buffer<SetView> sets_there_;
  std::vector<Buffer<unsigned char>> laws_;  ///< the law of each set
  ParticleStore<T> store_;
  Executor run_;
  const Passes<T>* passes_;
  std::vector<LawPass<T>> law_passes_;
  CellTable cells_;
  long count_ = 0;
  std::array<Buffer<T>, 9> gradient_;
  Buffer<std::uint32_t> node_, id_room_;
  Buffer<std::uint8_t> fault_;
  Buffer<double> place_room_;
  Buffer<T> room_;
  Buffer<double> mass_, nodal_[4];
  Buffer<OfNodes> of_nodes_;
  Buffer<OfParticles> of_particles_;
  Buffer<Momentum> of_momentum_;
  Impulses impulses_;
  bool must_sort_ = true;
  long steps_ = 0, sorts_ = 0;
};

}  // namespace mpm_gpu
