// Measures every kernel of the table by itself, for each instruction set that the machine has, in both precisions, in
// two and three dimensions, on one thread, on a lattice and on irregular positions; and the strain pass with each law.
//
// Every iteration does the same work: its time step is too small to move particles or to strain them further. For the
// laws, particles are first sheared past yielding and strained by a further 1e-5 in each iteration, so that the time
// includes the return to the yield surface.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <tuple>

#include "benchmarks.hpp"
#include "block.hpp"
#include "mpm/kernel/select.hpp"
#include "mpm/mechanics/continuum.hpp"
#include "mpm/mechanics/kernel_views.hpp"

namespace bench {
namespace {

constexpr double kHardlyAny = 1e-14;  ///< time step of an iteration [s]
constexpr int kTerms = 2;             ///< terms of the exponential, the default of scenes

struct Place {
  const char* geometry;
  const char* positions;
  const char* scene;
  const char* jitter;
};
constexpr Place kPlaces[] = {{"solid", "lattice", "speed_block_3d", "0"},
                             {"solid", "irregular", "speed_block_3d", "0.6"},
                             {"plane_strain", "lattice", "speed_block_2d", "0"},
                             {"plane_strain", "irregular", "speed_block_2d", "0.6"}};

template <class T>
constexpr mpm::Precision kPrecision = sizeof(T) == 4 ? mpm::Precision::float32 : mpm::Precision::float64;

/// A block that is sorted for one table of kernels, with its mass and velocity on the nodes.
template <class T>
class Subject {
 public:
  using Kernels = mpm_kernel::KernelTable<T>;

  Subject(const Place& place, mpm::Isa isa)
      : block_(place.scene, {fmt::format("bodies.block.jitter={}", place.jitter)}, kPrecision<T>),
        kernels_(mpm::kernel_table<T>(mpm::ShapeKind::ugimp, block_.definition.geometry, isa)) {
    block_.sort(1, mpm::kernel_grouping(kernels_));
    look();
  }
  /// A block of another material, uniformly sheared and compressed past yielding.
  Subject(const Place& place, mpm::Isa isa, const mpm::MaterialDefinition& material) : Subject(place, isa) {
    block_.make_of(material);
    mpm::ParticleSet& set = block_.sets.front();
    constexpr double kGradient[3][3] = {{-0.05, 0.5, 0.8}, {0.2, -0.05, 0.3}, {0.4, -0.3, -0.05}};  // [1/s]
    for (int c = 0; c < block_.dim(); ++c) {
      for (int p = 0; p < set.size(); ++p) {
        double v = 0.0;
        for (int k = 0; k < block_.dim(); ++k) v += kGradient[c][k] * set.x[k][p];
        set.v[c].set(p, v);
      }
    }
    look();
    for (int n = 0; n < 10; ++n) strain({2e-3, kTerms, false});
  }

  /// Fills the nodes anew, without force. A kernel that is applied to its own result again and again, like the update
  /// of nodes with its division by mass, would reach denormal numbers.
  void look() {
    mpm::Grid& grid = block_.grid;
    const int blocks = grid.blocks.size(), nodes = grid.layout.nodes_per_block();
    for (mpm::NodalField* field : {&grid.mass, &grid.momentum, &grid.velocity, &grid.force}) {
      std::fill_n(field->data(), static_cast<std::size_t>(blocks) * field->components() * nodes, 0.0);
    }
    grid_ = mpm::view_of(grid);
    set_ = mpm::view_of<T>(block_.sets.front(), block_.law, kernels_);
    scatter_momentum();
    nodal_velocity();
  }
  void scatter_momentum() {
    each([&](const auto& b) { kernels_.scatter_momentum[0](grid_, b, &set_, 1); });
  }
  void strain(const mpm_kernel::StrainSettings& settings) {
    each([&](const auto& b) { kernels_.strain(grid_, b, &set_, 1, settings); });
  }
  void move(bool regather) {
    each([&](const auto& b) {
      kernels_.move[mpm_kernel::kIncrement](grid_, b, &set_, 1, {kHardlyAny, 1.0, regather});
    });
  }
  void nodal_velocity() { kernels_.nodal_velocity(grid_, 0, block_.grid.blocks.size()); }
  void nodal_update() {
    const double gravity[3] = {};
    kernels_.nodal_update(grid_, 0, block_.grid.blocks.size(), kHardlyAny, gravity);
  }
  int particles() const { return block_.particles(); }

 private:
  template <class Pass>
  void each(Pass&& pass) {
    mpm::each_owner("pass", block_.grid, 1, pass);
  }
  Block block_;
  Kernels kernels_;
  mpm_kernel::GridView grid_{};
  mpm_kernel::SetView<T> set_{};
};

/// The subject of a benchmark; it has the material of `law`, if one is given. The last subject is kept, because
/// benchmarks of one subject follow each other and each is called several times to find its number of iterations.
template <class T>
Subject<T>& subject(const Place& place, mpm::Isa isa, const mpm::LawDefinition* law = nullptr) {
  static std::unique_ptr<Subject<T>> kept;
  static std::tuple<const Place*, mpm::Isa, const mpm::LawDefinition*> of;
  if (kept == nullptr || of != std::tuple(&place, isa, law)) {
    kept.reset();
    kept = law == nullptr ? std::make_unique<Subject<T>>(place, isa)
                          : std::make_unique<Subject<T>>(place, isa, mpm::MaterialDefinition{"specimen", 1500.0, *law});
    of = {&place, isa, law};
  }
  return *kept;
}

template <class T>
struct Kernel {
  const char* name;
  void (*run)(Subject<T>&);
};
template <class T>
constexpr Kernel<T> kKernels[] = {
    {"scatter_momentum", [](Subject<T>& s) { s.scatter_momentum(); }},
    {"nodal_velocity", [](Subject<T>& s) { s.nodal_velocity(); }},
    {"strain_and_force",
     [](Subject<T>& s) {
       s.strain({kHardlyAny, kTerms, true});
     }},
    {"strain",
     [](Subject<T>& s) {
       s.strain({kHardlyAny, kTerms, false});
     }},
    {"nodal_update", [](Subject<T>& s) { s.nodal_update(); }},
    {"move", [](Subject<T>& s) { s.move(false); }},
    {"move_and_regather", [](Subject<T>& s) { s.move(true); }},
};

template <class T>
void run_kernel(benchmark::State& state, const Place* place, mpm::Isa isa, const Kernel<T>* kernel) {
  Subject<T>& on = subject<T>(*place, isa);
  on.look();
  for (auto _ : state) kernel->run(on);
  state.SetItemsProcessed(state.iterations() * on.particles());
}

const mpm::Elasticity kSoft{1e6, 0.3}, kMetal{70e9, 0.33};
const mpm::LawDefinition kLaws[] = {
    mpm::LinearElasticDefinition{kSoft},
    mpm::NeoHookeanDefinition{kSoft},
    mpm::DruckerPragerDefinition{kSoft, 0.6, 0.0, 2000.0},
    mpm::MohrCoulombDefinition{kSoft, 0.6, 0.0, 2000.0},
    mpm::J2PlasticityDefinition{kMetal, 200e6, 500e6, 300e6, 20.0},
    mpm::NewtonianFluidDefinition{1e6, 7.0, 50.0, true},
    mpm::IdealGasDefinition{101325.0, 293.15},
    mpm::StandardLinearSolidDefinition{kSoft, 5e5, 0.5},
    mpm::JohnsonCookDefinition{
        kMetal.shear(), {5000.0, 1.5, 2.0}, 200e6, 300e6, 0.3, 0.01, 1.0, 1.2, 900.0, 293.0, 900.0, 0.9}};

template <class T>
void run_law(benchmark::State& state, mpm::Isa isa, const mpm::LawDefinition* law) {
  Subject<T>& on = subject<T>(kPlaces[0], isa, law);
  for (auto _ : state) on.strain({1e-5, kTerms, false});
  state.SetItemsProcessed(state.iterations() * on.particles());
}

template <class T>
void register_all(mpm::Isa isa) {
  const std::string with = fmt::format("{}/{}", mpm::precision_name(kPrecision<T>), mpm::isa_name(isa));
  for (const Place& place : kPlaces) {
    for (const Kernel<T>& kernel : kKernels<T>) {
      const std::string name = fmt::format("kernel/{}/{}/{}/{}", kernel.name, place.geometry, with, place.positions);
      benchmark::RegisterBenchmark(name.c_str(), run_kernel<T>, &place, isa, &kernel);
    }
  }
  for (const mpm::LawDefinition& law : kLaws) {
    const std::string name = fmt::format("strain_with_law/{}/solid/{}", mpm::law_name(law), with);
    benchmark::RegisterBenchmark(name.c_str(), run_law<T>, isa, &law);
  }
}

}  // namespace

void register_kernels() {
  for (const mpm::Isa isa : {mpm::Isa::avx512, mpm::Isa::avx2, mpm::Isa::plain}) {
    if (!mpm::isa_available(isa)) continue;
    register_all<double>(isa);
    register_all<float>(isa);
  }
}

}  // namespace bench
