// Mean stresses of cells: who shares them, what stays, and the energy that is booked.
#include "mpm/mechanics/stress_average.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mpm/step/sorter.hpp"

namespace mpm {
namespace stress_average_test {

constexpr double kCell = 0.1, kBulk = 2e6, kShear = 1e6, kDensity = 1600.0;
constexpr double kMass = 0.25;  // [kg]

struct Particle {
  double x, z;            // [m]
  double xx, zz, xz, yy;  // [J/kg]
  double strain;          // plastic
};

/// Young's modulus and Poisson's ratio of kBulk and kShear.
constexpr Elasticity kElasticity{9.0 * kBulk * kShear / (3.0 * kBulk + kShear),
                                 (3.0 * kBulk - 2.0 * kShear) / (6.0 * kBulk + 2.0 * kShear)};

Law soil_law() {
  DruckerPragerDefinition soil;
  soil.elasticity = kElasticity;
  soil.friction_angle = 0.5;
  return make_law({"soil", kDensity, soil});
}
Law metal_law() {
  J2PlasticityDefinition metal;
  metal.elasticity = kElasticity;
  metal.yield_stress = 1e3;
  return make_law({"metal", kDensity, metal});
}

/// Particles in one plane; in the order in which they were given, whatever the sort does.
template <class T>
struct Soil {
  explicit Soil(const std::vector<Particle>& particles, Law of = soil_law())
      : law(std::move(of)),
        fields(make_fields(GridLayout(2, Vec3::Constant(kCell), Vec3::Zero(), Vec3::Ones()))),
        sets(1) {
    ParticleSet& set = sets[0];
    set.mass = kMass;
    set.precision = sizeof(T) == 4 ? Precision::float32 : Precision::float64;
    set.half = {0.25, 0.25, 0.0};
    set.highest = {10.0, 10.0, 0.0};
    const std::size_t n = particles.size();
    set.id.resize(n);
    set.x.assign(2, PaddedArray<double>(n));
    const auto zeros = [&](int count) { return std::vector<ParticleScalar>(count, ParticleScalar(set.precision, n)); };
    set.v = zeros(2), set.f = zeros(5), set.tau = zeros(4), set.history = zeros(1);
    for (std::size_t p = 0; p < n; ++p) {
      const Particle& one = particles[p];
      set.id[p] = static_cast<std::uint32_t>(p);
      set.x[0][p] = one.x, set.x[1][p] = one.z;
      for (const int diagonal : {0, 3}) set.f[diagonal].set(p, 1.0);
      set.tau[0].set(p, one.xx), set.tau[1].set(p, one.zz), set.tau[2].set(p, one.xz), set.tau[3].set(p, one.yy);
    }
    average = std::make_unique<StressAverage>(std::vector<AveragedSet>{{&set, &law}}, GeometryKind::plane_strain, 2);
    EXPECT_FALSE(Sorter(1).sort(sets, fields));
    act();  // plastic strain of the start does not count
    for (std::size_t p = 0; p < n; ++p) set.history[0].set(p, particles[set.id[p]].strain);
  }
  void act() {
    StepContext context{fields, 1e-3, 0.0};
    average->momentum_gathered(context);
  }
  /// A component of the stress of the particle with this id.
  double stress(int component, std::uint32_t id) const {
    for (int p = 0; p < sets[0].size(); ++p) {
      if (sets[0].id[p] == id) return sets[0].tau[component][p];
    }
    return 0.0;
  }
  double energy() const {
    EnergyReport report;
    average->energies(report);
    return report.of("stress averaging");
  }
  Law law;
  Fields fields;
  std::vector<ParticleSet> sets;
  std::unique_ptr<StressAverage> average;
};

template <class T>
class StressAverageOf : public testing::Test {};
using Precisions = testing::Types<double, float>;
TYPED_TEST_SUITE(StressAverageOf, Precisions);

// Gives the mean of the stresses to what flows; what does not flow, what is in tension and what is alone stay.
TYPED_TEST(StressAverageOf, SharedByWhatFlowsInACell) {
  const double tolerance = sizeof(TypeParam) == 4 ? 1e-6 : 1e-14;
  Soil<TypeParam> soil({{0.52, 0.41, -9.0, -5.0, 1.0, -4.0, 0.1},
                        {0.58, 0.48, -1.0, -3.0, 0.5, -2.0, 0.2},
                        {0.51, 0.42, -8.0, -8.0, 0.0, -8.0, 0.0},
                        {0.57, 0.44, 3.0, 3.0, 0.0, 3.0, 0.1},
                        {0.43, 0.56, -7.0, -7.0, 0.0, -7.0, 0.1}});
  soil.act();
  const double expected[][4] = {{-5.0, -4.0, 0.75, -3.0},
                                {-5.0, -4.0, 0.75, -3.0},
                                {-8.0, -8.0, 0.0, -8.0},
                                {3.0, 3.0, 0.0, 3.0},
                                {-7.0, -7.0, 0.0, -7.0}};
  for (std::uint32_t p = 0; p < 5; ++p) {
    for (int c = 0; c < 4; ++c) EXPECT_NEAR(soil.stress(c, p), expected[p][c], 10.0 * tolerance) << p << ' ' << c;
  }
  // Volume energy m rho0 t^2 / 2K of the mean stress t: 36 + 4 becomes 16 + 16. Shear energy m rho0 s:s / 4G: deviators
  // (-3, 1, 2; 1) with 16 and (1, -1, 0; 0.5) with 2.5 become twice (-1, 0, 1; 0.75) with 3.125.
  const double lost = kMass * kDensity * (8.0 / (2.0 * kBulk) + (16.0 + 2.5 - 2.0 * 3.125) / (4.0 * kShear));
  EXPECT_NEAR(soil.energy(), lost, tolerance * lost);
  // Nothing has flowed since.
  soil.act();
  EXPECT_NEAR(soil.stress(0, 0), -5.0, 10.0 * tolerance);
  EXPECT_NEAR(soil.energy(), lost, tolerance * lost);
}

// Ground that has yielded while it settled brings its plastic strain along.
TYPED_TEST(StressAverageOf, PlasticStrainOfTheStartIsNoFlow) {
  Soil<TypeParam> soil({{0.52, 0.41, -9.0, -9.0, 0.0, -9.0, 0.1}, {0.58, 0.48, -1.0, -1.0, 0.0, -1.0, 0.2}});
  soil.average = std::make_unique<StressAverage>(std::vector<AveragedSet>{{&soil.sets[0], &soil.law}},
                                                 GeometryKind::plane_strain, 1);
  soil.act();
  EXPECT_EQ(soil.stress(0, 0), -9.0);
  EXPECT_EQ(soil.energy(), 0.0);
}

// Cells are those between nodes, whatever block the particles belong to: nodes 0 to 3, 4 to 7 and so on are a block's,
// and a particle's block is that of its nearest node.
TYPED_TEST(StressAverageOf, CellsAreThoseBetweenNodes) {
  Soil<TypeParam> soil({{0.599, 0.41, -6.0, -6.0, 0.0, -6.0, 0.1},
                        {0.601, 0.41, -2.0, -2.0, 0.0, -2.0, 0.1},
                        {0.699, 0.49, -4.0, -4.0, 0.0, -4.0, 0.1},
                        {0.701, 0.72, -1.0, -1.0, 0.0, -1.0, 0.1},
                        {0.799, 0.78, -3.0, -3.0, 0.0, -3.0, 0.1}});
  soil.act();
  const double expected[] = {-6.0, -3.0, -3.0, -2.0, -2.0};
  for (std::uint32_t p = 0; p < 5; ++p) EXPECT_NEAR(soil.stress(0, p), expected[p], 1e-6) << p;
}

// 0.9 and 1.1 of one mass are 1.0 together: along the grid's axes each is stretched by the root of the ratio, and the
// volume of the cell stays.
TYPED_TEST(StressAverageOf, TheVolumeIsSharedToo) {
  Soil<TypeParam> soil({{0.52, 0.41, -4.0, -4.0, 0.0, -4.0, 0.1}, {0.58, 0.48, -4.0, -4.0, 0.0, -4.0, 0.1}});
  ParticleSet& set = soil.sets[0];
  set.f[0].set(0, 0.9), set.f[0].set(1, 1.1);
  soil.act();
  for (int p = 0; p < 2; ++p) {
    const double before = p == 0 ? 0.9 : 1.1, stretch = std::sqrt(1.0 / before);
    EXPECT_NEAR(set.f[0][p], before * stretch, 1e-6);
    EXPECT_NEAR(set.f[3][p], stretch, 1e-6);
  }
}

// Metal shares deviators and J in tension, too, and what it loses is what its law's energy says.
TYPED_TEST(StressAverageOf, MetalSharesInTensionToo) {
  const double stress = kShear / kDensity * 1e-3;  // stress of an elastic strain of 1e-3 [J/kg]
  Soil<TypeParam> metal(
      {{0.52, 0.41, 3.0 * stress, 0.0, 0.0, 0.0, 0.1}, {0.58, 0.48, 0.0, 3.0 * stress, 0.0, 0.0, 0.1}}, metal_law());
  metal.act();
  const double tolerance = sizeof(TypeParam) == 4 ? 1e-6 : 1e-14;
  for (std::uint32_t p = 0; p < 2; ++p) {
    EXPECT_NEAR(metal.stress(0, p), 1.5 * stress, tolerance * stress) << p;
    EXPECT_NEAR(metal.stress(1, p), 1.5 * stress, tolerance * stress) << p;
  }
  // Energy of a small strain, G/4 dev b : dev b a volume: deviators (2, -1, -1) become (0.5, 0.5, -1).
  const double lost = 2.0 * kMass / kDensity * kShear / 4.0 * (6.0 - 1.5) * 1e-6;
  EXPECT_NEAR(metal.energy(), lost, 3e-3 * lost);
}

}  // namespace stress_average_test
}  // namespace mpm
