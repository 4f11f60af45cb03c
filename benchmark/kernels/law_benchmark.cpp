// Every law over a block of particles, by numbers (not registers), each particle with a deformation of its own: one
// small increment, from the same state at every turn. Soil and metal are sheared past yielding: the return counts.
#include <benchmark/benchmark.h>

#include <random>
#include <type_traits>

#include "mpm/material/law.hpp"
#include "mpm/math/exponential.hpp"

namespace {

constexpr int kParticles = 512;  ///< about those of a block of 4^3 nodes, 8 a cell

void update(benchmark::State& state, const mpm::LawDefinition& definition, double strain) {
  using Matrix = mpm::Matrix3<double>;
  const mpm::Law law = mpm::make_law({"specimen", 1500.0, definition});
  std::mt19937 random(1);
  const auto number = [&] { return strain * (static_cast<double>(random()) * 0x1p-31 - 1.0); };
  std::vector<Matrix> du(kParticles), df(kParticles), f(kParticles);
  for (int p = 0; p < kParticles; ++p) {
    du[p] = {number(), number(), number(), number(), number(), number(), number(), number(), number()};
    df[p] = mpm::exponential(du[p], 2);
    f[p] = df[p];
  }
  std::vector<mpm::Symmetric3<double>> tau(kParticles);
  std::visit(
      [&](const auto& kind) {
        for (auto _ : state) {
          for (int p = 0; p < kParticles; ++p) {
            double history[std::decay_t<decltype(kind)>::kHistory + 1] = {};
            tau[p] = {};
            const mpm::Increment<double, Matrix> step{du[p], df[p], f[p], 1.0, mpm::determinant(f[p]), 1e-4};
            kind.update(step, tau[p], history);
            benchmark::DoNotOptimize(history);
          }
          benchmark::DoNotOptimize(tau.data());
          benchmark::ClobberMemory();
        }
      },
      law);
  state.SetItemsProcessed(state.iterations() * kParticles);
}

const mpm::Elasticity kSoft{1e6, 0.3}, kMetal{70e9, 0.33};

BENCHMARK_CAPTURE(update, linear_elastic, mpm::LinearElasticDefinition{kSoft}, 0.01);
BENCHMARK_CAPTURE(update, neo_hookean, mpm::NeoHookeanDefinition{kSoft}, 0.01);
BENCHMARK_CAPTURE(update, drucker_prager, mpm::DruckerPragerDefinition{kSoft, 0.6, 0.0, 2000.0}, 0.01);
BENCHMARK_CAPTURE(update, mohr_coulomb, mpm::MohrCoulombDefinition{kSoft, 0.6, 0.0, 2000.0}, 0.01);
BENCHMARK_CAPTURE(update, j2_plasticity, mpm::J2PlasticityDefinition{kMetal, 200e6, 500e6, 300e6, 20.0}, 0.01);
BENCHMARK_CAPTURE(update, newtonian_fluid, mpm::NewtonianFluidDefinition{1e6, 7.0, 50.0, true}, 0.01);
BENCHMARK_CAPTURE(update, ideal_gas, mpm::IdealGasDefinition{101325.0, 293.15}, 0.01);
BENCHMARK_CAPTURE(update, viscoelastic, mpm::StandardLinearSolidDefinition{kSoft, 5e5, 0.5}, 0.01);

}  // namespace
