// A physics of its own, handed to a run from outside: dye that particles carry and that diffuses through the grid,
// dc/dt = k c_xx with nothing lost at the ends. It touches no file of the library, yet it is sorted, reported, kept in
// checkpoints and limits the time step.
#include <gtest/gtest.h>

#include <cmath>

#include "mpm/checkpoint/checkpoint.hpp"
#include "mpm/math/constants.hpp"
#include "mpm/modules/run_parts.hpp"
#include "mpm/simulation/global_quantity.hpp"
#include "mpm/simulation/simulation.hpp"

namespace mpm {
namespace passive_scalar_test {

constexpr double kLength = 1.0, kCell = 0.05;  // [m]

/// Particles take increments, as in FLIP: c_p += dt sum_i S_ip r_i, m_i r_i = -sum_p m_p k G_ip . grad c_p.
class Dye final : public Stage {
 public:
  /// Makes the dye of a run with one body.
  Dye(RunParts& parts, double diffusivity)
      : set_(parts.sets[0]),
        transfer_(parts.make_transfer(parts.definition.method.shape)),
        k_(diffusivity),
        place_(set_.bring("dye", "1")),
        nodal_(1, parts.layout().nodes_per_block()),
        gradient_(set_.id.size()) {
    const double from = set_.x[0][0] - 0.25 * kCell;
    for (int p = 0; p < set_.size(); ++p) dye()[p] = 1.0 + std::cos(kPi * (set_.x[0][p] - from) / kLength);
  }
  std::string name() const override { return "dye"; }
  Ranks ranks(Hook) const override { return {Rank::load}; }

  void momentum_gathered(StepContext& context) override {
    const Grid& grid = *context.fields[0];
    nodal_.resize(grid.blocks.size());
    transfer_->spread(0, {{dye()}}, ScalarTransfer::Weight::mass, nodal_);
    divide_by_mass(grid);
    transfer_->gradient(0, nodal_, {{gradient_.data()}});
    for (double& value : gradient_) value *= -k_;
    transfer_->spread_gradient(0, {{gradient_.data()}}, ScalarTransfer::Weight::mass, nodal_);
    divide_by_mass(grid);
    transfer_->gather(0, nodal_, {{gradient_.data()}});
    for (int p = 0; p < set_.size(); ++p) dye()[p] += context.dt * gradient_[p];
  }
  void numbers(std::vector<NamedNumber>& list) const override {
    double sum = 0.0;
    for (int p = 0; p < set_.size(); ++p) sum += set_.mass_of(p) * set_.brought[place_].values[p];
    list.push_back({"total dye", "kg", sum});
  }
  void limit_step(const PeriodAhead& period, StepLimit& limit) const override {
    StepLimit own;
    own.by = this;
    own.dt = period.cfl * period.cell * period.cell / (2.0 * k_);
    if (k_ > 0.0) limit.tighten(own);
  }

 private:
  double* dye() { return set_.brought[place_].values.data(); }
  void divide_by_mass(const Grid& grid) {
    for (int b = 0; b < grid.blocks.size(); ++b) {
      for (int n = 0; n < grid.layout.nodes_per_block(); ++n) {
        nodal_.at(b, 0, n) = grid.carries(b, n) ? nodal_.at(b, 0, n) / grid.mass.at(b, 0, n) : 0.0;
      }
    }
  }

  ParticleSet& set_;
  std::unique_ptr<ScalarTransfer> transfer_;
  double k_;
  std::size_t place_;
  NodalField nodal_;
  PaddedArray<double> gradient_;
};

/// A bar along x, two particles a cell, that flies at `speed` [m/s] with dye of this diffusivity [m^2/s] in it.
Simulation bar(double diffusivity, double speed) {
  SimulationDefinition d;
  d.geometry = GeometryKind::line;
  d.grid = {Vec3::Constant(kCell), Vec3::Zero(), Vec3::Constant(3.0)};
  d.time.sync = 10'000'000;
  d.materials.push_back({"rubber", 1000.0, NeoHookeanDefinition{{1e3, 0.3}}});
  DeformableBody body;
  body.name = "bar", body.material = "rubber";
  body.particle_volume = 0.5 * kCell;
  for (int p = 0; p < 40; ++p) body.positions.emplace_back(1.0 + (0.25 + 0.5 * p) * kCell, 0.0, 0.0);
  body.velocities.assign(40, Vec3(speed, 0.0, 0.0));
  d.bodies.push_back(body);
  SimulationOptions options{1};
  options.modules.push_back([=](RunParts& parts) { parts.modules.add(std::make_unique<Dye>(parts, diffusivity)); });
  return Simulation(d, options);
}

double amplitude(const Simulation& simulation) {
  std::vector<double> dye;
  simulation.particle_field("dye", dye);
  double sum = 0.0;
  for (int p = 0; p < 40; ++p) sum += dye[p] * std::cos(kPi * (0.25 + 0.5 * p) * kCell / kLength) / 20.0;
  return sum;
}

// The cosine falls by exp(-k pi^2 t / L^2). On the lattice its rate is less: differences over a cell take
// (2/h sin(qh/2))^2 for q^2, and each way between particles and nodes, at h/4 and 3h/4, smooths by s; a step of dt
// takes 1 - rate dt for exp(-rate dt). What is left is what the lattice's second wave, of a cell's length, gives back.
TEST(PassiveScalar, DecaysAsACosine) {
  const double k = 0.2, q = kPi / kLength;
  Simulation run = bar(k, 0.0);
  for (int n = 0; n < 100; ++n) run.advance();
  EXPECT_EQ(run.state().step.limited_by, "dye");
  const double dt = 1.0 / static_cast<double>(run.state().step.steps);
  const double s = 0.75 * std::cos(q * kCell / 4.0) + 0.25 * std::cos(3.0 * q * kCell / 4.0);
  const double rate = k * std::pow(2.0 / kCell * std::sin(0.5 * q * kCell) * s, 2);
  const double measured = -std::log(amplitude(run)), exact = k * q * q;
  EXPECT_NEAR(measured / exact, 1.0, 0.01);
  EXPECT_NEAR(measured, -std::log(1.0 - rate * dt) / dt, 1e-4 * exact);
}

// Dye moves with its particles, through many sorts: without diffusion to the bit, with it to round-off in all.
TEST(PassiveScalar, IsCarriedAndKept) {
  Simulation still = bar(0.0, 2.0), run = bar(0.2, 2.0);
  std::vector<double> start, end, x;
  still.particle_field("dye", start);
  GlobalQuantities total(run, {{"total dye", ""}});
  const double before = total.read()[0];
  EXPECT_NEAR(before, 1000.0 * kLength, 1e-9);
  for (int n = 0; n < 40; ++n) still.advance(), run.advance();
  still.particle_field("x", x);
  EXPECT_NEAR(x[0], 1.0 + 0.25 * kCell + 0.8, 1e-9);
  still.particle_field("dye", end);
  EXPECT_EQ(start, end);
  EXPECT_NEAR(total.read()[0], before, 1e-12 * before);
  EXPECT_LT(amplitude(run), 0.95);
}

TEST(PassiveScalar, GoesOnFromACheckpoint) {
  const std::string path = testing::TempDir() + "passive_scalar.h5";
  Simulation whole = bar(0.2, 2.0), part = bar(0.2, 2.0);
  for (int n = 0; n < 5; ++n) whole.advance();
  save_checkpoint(path, whole, {});
  load_checkpoint(path, part, "");
  for (int n = 0; n < 5; ++n) whole.advance(), part.advance();
  EXPECT_EQ(part.state_hash(), whole.state_hash());
  EXPECT_EQ(part.memory_hash(), whole.memory_hash());
}

}  // namespace passive_scalar_test
}  // namespace mpm
