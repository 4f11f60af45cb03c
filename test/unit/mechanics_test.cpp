// The passes of the mechanics on the grid: their conservation laws, which hold in every scene.
#include <gtest/gtest.h>

#include <random>

#include "kernel_tables.hpp"
#include "mpm/mechanics/continuum.hpp"

namespace mechanics_test {

using mpm::Vec3;

// A block of particles on the lattice of the grid, randomly displaced by up to `jitter` cells, with random velocities.
struct Scene {
  Scene(int dim, double jitter, const mpm::LawDefinition& law, int threads = 1, mpm::Isa isa = mpm::best_isa())
      : fields(mpm::make_fields(mpm::GridLayout(dim, Vec3::Constant(cell), Vec3::Zero(), Vec3::Constant(2.0)))) {
    laws.push_back(mpm::make_law({"m", 900.0, law}));
    sets.emplace_back();
    mpm::ParticleSet& set = sets.back();
    set.mass = 900.0 * std::pow(0.5 * cell, dim);
    set.half = {0.25, 0.25, 0.25};
    set.highest = {20.0, 20.0, 20.0};
    std::mt19937 engine(11);
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    const int edge = 20;  // particles along an edge: 10 cells, 3 blocks
    int count = 1;
    for (int k = 0; k < dim; ++k) count *= edge;
    set.x.assign(dim, mpm::PaddedArray<double>(count));
    set.v.assign(dim, mpm::ParticleScalar(set.precision, count));
    set.f.assign(dim == 3 ? 9 : 4, mpm::ParticleScalar(set.precision, count));
    set.tau.assign(dim == 3 ? 6 : 4, mpm::ParticleScalar(set.precision, count));
    set.history.assign(mpm::history_size(laws[0]), mpm::ParticleScalar(set.precision, count));
    set.id.resize(count);
    set.next_x.assign(dim, mpm::PaddedArray<double>(count));
    for (int p = 0; p < count; ++p) {
      set.id[p] = p;
      int rest = p;
      for (int k = 0; k < dim; ++k) {
        set.x[k][p] = 0.5 + cell * (0.5 * (rest % edge + 0.5) + jitter * u(engine));
        set.v[k].set(p, u(engine));
        set.f[k * (dim + 1)].set(p, 1.0);
        rest /= edge;
      }
    }
    EXPECT_FALSE(
        mpm::Sorter(threads, mpm::kernel_grouping(mpm::test::ugimp_kernels<double>(dim, isa))).sort(sets, fields));
    mpm::ContinuumSettings settings;
    settings.threads = threads;
    mechanics = mpm::make_mechanics(mpm::test::ugimp_kernels<double>(dim, isa), fields, sets, laws, settings);
  }

  template <class Visit>
  void each_node(Visit&& visit) {
    for (int b = 0; b < grid.blocks.size(); ++b) {
      for (int n = 0; n < grid.layout.nodes_per_block(); ++n) visit(mpm::NodeRef{b, n});
    }
  }

  static constexpr double cell = 0.1;
  mpm::Fields fields;
  mpm::Grid& grid = *fields.front();
  std::vector<mpm::ParticleSet> sets;
  std::vector<mpm::Law> laws;
  std::unique_ptr<mpm::Mechanics> mechanics;
};

class MechanicsTest : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Dimensions, MechanicsTest, testing::Values(2, 3));

TEST_P(MechanicsTest, ScatterKeepsMassAndMomentum) {
  Scene scene(GetParam(), 0.3, mpm::NeoHookeanDefinition{{1e6, 0.3}});
  mpm::StepContext context{scene.fields, 1e-4};
  scene.mechanics->scatter_momentum(context);
  double mass = 0.0, scale = 0.0;
  Vec3 momentum = Vec3::Zero(), expected = Vec3::Zero();
  scene.each_node([&](mpm::NodeRef n) {
    mass += scene.grid.mass.at(n.block, 0, n.node);
    momentum += mpm::nodal_vector(scene.grid.momentum, scene.grid.layout, n);
  });
  const mpm::ParticleSet& set = scene.sets[0];
  for (int p = 0; p < set.size(); ++p) {
    for (int k = 0; k < GetParam(); ++k) {
      expected[scene.grid.layout.axis(k)] += set.mass * set.v[k][p];
      scale += set.mass * std::abs(set.v[k][p]);
    }
  }
  // Sums of at most 8000 terms: 1e-13 of the sum of magnitudes is round-off.
  const double expected_mass = set.mass * set.size();
  EXPECT_NEAR(mass, expected_mass, 1e-13 * expected_mass);
  EXPECT_LT((momentum - expected).norm(), 1e-13 * scale);
}

TEST_P(MechanicsTest, InternalForcesSumToZero) {
  Scene scene(GetParam(), 0.3, mpm::NeoHookeanDefinition{{1e6, 0.3}});
  mpm::StepContext context{scene.fields, 1e-3};
  scene.mechanics->scatter_momentum(context);
  scene.mechanics->strain_and_force(context, context.dt);
  Vec3 sum = Vec3::Zero();
  double scale = 0.0;
  scene.each_node([&](mpm::NodeRef n) {
    const Vec3 f = mpm::nodal_vector(scene.grid.force, scene.grid.layout, n);
    sum += f;
    scale += f.norm();
  });
  EXPECT_GT(scale, 1.0);
  EXPECT_LT(sum.norm(), 1e-13 * scale);
}

// Method reference 1.1: sum over particles of V G = 0 at interior nodes when domains tile space.
TEST_P(MechanicsTest, UniformStressGivesNoForceInside) {
  const int dim = GetParam();
  Scene scene(dim, 0.0, mpm::NeoHookeanDefinition{{1e6, 0.3}});
  mpm::ParticleSet& set = scene.sets[0];
  for (auto* field : {&set.v, &set.f}) {
    for (auto& scalar : *field) scalar.assign(scalar.size(), 0.0);
  }
  for (int p = 0; p < set.size(); ++p) {
    for (int k = 0; k < dim; ++k) set.f[k * (dim + 1)].set(p, 0.9 + 0.1 * k);
    set.f[1].set(p, 0.05);
  }
  mpm::StepContext context{scene.fields, 1e-3};
  scene.mechanics->scatter_momentum(context);
  scene.mechanics->strain_and_force(context, context.dt);
  double inside = 0.0, surface = 0.0;
  for (int b = 0; b < scene.grid.blocks.size(); ++b) {
    for (int n = 0; n < scene.grid.layout.nodes_per_block(); ++n) {
      const auto node = scene.grid.layout.node(scene.grid.blocks.block(b), n);
      bool interior = true;  // the block fills nodes 5 to 15
      for (int k = 0; k < dim; ++k) interior = interior && node[k] > 5 && node[k] < 15;
      const double f = mpm::nodal_vector(scene.grid.force, scene.grid.layout, {b, n}).norm();
      (interior ? inside : surface) = std::max(interior ? inside : surface, f);
    }
  }
  EXPECT_GT(surface, 1.0);
  EXPECT_LT(inside, 1e-12 * surface);
}

TEST_P(MechanicsTest, ForcesDoNotDependOnThreads) {
  std::vector<double> force[2];
  for (const int threads : {1, 2}) {
    Scene scene(GetParam(), 0.3, mpm::DruckerPragerDefinition{{1e6, 0.3}, 0.5, 0.1, 100.0}, threads);
    mpm::StepContext context{scene.fields, 1e-3};
    scene.mechanics->scatter_momentum(context);
    scene.mechanics->strain_and_force(context, context.dt);
    scene.each_node([&](mpm::NodeRef n) {
      for (int k = 0; k < GetParam(); ++k) force[threads - 1].push_back(scene.grid.force.at(n.block, k, n.node));
    });
  }
  EXPECT_EQ(force[0], force[1]);
}

// With FLIP the particles gain the momentum that the grid gains; with a PIC fraction the sum is the same (method
// reference 6.2).
TEST_P(MechanicsTest, MotionKeepsMomentumForEveryFlipFraction) {
  for (const double flip : {1.0, 0.95, 0.0}) {
    Scene scene(GetParam(), 0.3, mpm::NeoHookeanDefinition{{1e6, 0.3}});
    mpm::ContinuumSettings settings;
    settings.transfer.flip = flip;
    scene.mechanics = mpm::make_mechanics(mpm::test::ugimp_kernels<double>(GetParam(), mpm::best_isa()), scene.fields,
                                          scene.sets, scene.laws, settings);
    mpm::ParticleSet& set = scene.sets[0];
    auto momentum = [&] {
      Vec3 sum = Vec3::Zero();
      for (int p = 0; p < set.size(); ++p) {
        for (int k = 0; k < GetParam(); ++k) sum[k] += set.mass * set.v[k][p];
      }
      return sum;
    };
    const Vec3 before = momentum();
    mpm::StepContext context{scene.fields, 1e-3};
    scene.mechanics->scatter_momentum(context);
    scene.mechanics->strain_and_force(context, context.dt);
    scene.mechanics->update_momentum(context);
    scene.mechanics->move_particles(context);
    EXPECT_LT((momentum() - before).norm(), 1e-12 * set.mass * set.size()) << "flip " << flip;
  }
}

}  // namespace mechanics_test
