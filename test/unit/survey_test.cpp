// The limit of the time step that the kernels find (kernel/survey.hpp), against a loop over the particles, for every
// law, geometry, precision and instruction set.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "kernel_tables.hpp"
#include "material_zoo.hpp"
#include "mpm/math/dimension.hpp"
#include "mpm/mechanics/continuum.hpp"
#include "mpm/mechanics/kernel_views.hpp"

namespace mpm::test {
namespace survey_test {

constexpr double kCell = 0.05;  ///< [m]

std::vector<Isa> instruction_sets() {
  std::vector<Isa> found;
  for (const Isa isa : {Isa::plain, Isa::avx2, Isa::avx512}) {
    if (isa_available(isa)) found.push_back(isa);
  }
  return found;
}

/// Moving particles of a material after strain paths of different lengths.
template <class Geometry>
ParticleSet worked_particles(const paths::Specimen& specimen, Precision precision, int count) {
  ParticleSet set;
  set.precision = precision;
  set.id.resize(count);
  set.x.assign(Geometry::kDim, PaddedArray<double>(count));
  set.v.assign(Geometry::kDim, ParticleScalar(precision, count));
  set.f.assign(Geometry::kMatrix, ParticleScalar(precision, count));
  set.tau.assign(Geometry::kSymmetric, ParticleScalar(precision, count));
  std::mt19937 random(5);
  std::uniform_real_distribution<double> speed(-3.0, 3.0);
  for (int p = 0; p < count; ++p) {
    MaterialPoint point(specimen.material);
    for (int n = 0; n < 1 + p % 20; ++n) {
      Matrix3<double> du = paths::random_gradient(random, specimen.strain);
      const double volume = n < 5 ? 0.2 * specimen.pressing : 0.0;
      du.xx += volume, du.zz += volume;
      if (Geometry::kDim == 2) du.xy = du.yx = du.yz = du.zy = du.yy = 0.0;
      point.advance(du, specimen.time);
    }
    const Matrix3<double>& f = point.f();
    const Symmetric3<double>& t = point.tau();
    const double solid_f[] = {f.xx, f.xy, f.xz, f.yx, f.yy, f.yz, f.zx, f.zy, f.zz},
                 plane_f[] = {f.xx, f.xz, f.zx, f.zz};
    const double solid_tau[] = {t.xx, t.yy, t.zz, t.yz, t.xz, t.xy}, plane_tau[] = {t.xx, t.zz, t.xz, t.yy};
    for (int c = 0; c < Geometry::kMatrix; ++c) set.f[c].set(p, (Geometry::kDim == 3 ? solid_f : plane_f)[c]);
    for (int c = 0; c < Geometry::kSymmetric; ++c) set.tau[c].set(p, (Geometry::kDim == 3 ? solid_tau : plane_tau)[c]);
    for (ParticleScalar& v : set.v) v.set(p, speed(random));
  }
  return set;
}

/// The rate of one particle in double precision [1/s].
template <class Geometry>
double rate(const ParticleSet& set, const Law& law, int p) {
  const auto f = Geometry::load_matrix(set.f, p);
  const auto tau = Geometry::load_symmetric(set.tau, p);
  double speed2 = 0.0;
  for (const ParticleScalar& v : set.v) speed2 += v[p] * v[p];
  return std::visit(
      [&](const auto& kind) {
        return (kind.wave_speed(f, tau, determinant(f)) + std::sqrt(speed2)) / kCell +
               2.0 * Geometry::kDim * kind.diffusivity(determinant(f)) / (kCell * kCell);
      },
      law);
}

/// `below`, `above`: relative differences of the kernels' rate that are allowed.
template <class Geometry, class T>
void survey_every_law(Precision precision, double below, double above) {
  for (const paths::Specimen& specimen : paths::zoo()) {
    const Law law = make_law(specimen.material);
    ParticleSet set = worked_particles<Geometry>(specimen, precision, 61);
    const mpm_kernel::SetView<T> view = view_of<T>(set, law, ugimp_kernels<T>(Geometry::kDim, Isa::plain));
    for (const Isa isa : instruction_sets()) {
      const auto survey = ugimp_kernels<T>(Geometry::kDim, isa).laws[law.index()].survey;
      // Single particles, parts of registers, and all particles.
      for (const auto& [first, last] : {std::pair{0, 1}, std::pair{7, 8}, std::pair{3, 36}, std::pair{0, 61}}) {
        int expected = first;
        for (int p = first; p < last; ++p) {
          if (rate<Geometry>(set, law, p) > rate<Geometry>(set, law, expected)) expected = p;
        }
        const mpm_kernel::Fastest found = survey(view, first, last, kCell);
        const double most = rate<Geometry>(set, law, expected);
        EXPECT_GE(found.rate, (1.0 - below) * most) << specimen.material.name << ' ' << isa_name(isa);
        EXPECT_LE(found.rate, (1.0 + above) * most) << specimen.material.name << ' ' << isa_name(isa);
        ASSERT_GE(found.particle, first);
        ASSERT_LT(found.particle, last);
        EXPECT_NEAR(rate<Geometry>(set, law, found.particle), found.rate, std::max(above, below) * most)
            << specimen.material.name << ' ' << isa_name(isa);
      }
    }
  }
}

// The tolerance is that of a hundred operations, whose round-off is amplified by cancellation in J and the deviator.
TEST(Survey, OfDoublesIsALoop) {
  survey_every_law<Solid, double>(Precision::float64, 1e-12, 1e-12);
  survey_every_law<PlaneStrain, double>(Precision::float64, 1e-12, 1e-12);
}

// In single precision the rate may also be larger by the allowance for round-off in the bounds of principal values,
// 5e-4 of the deviator (principal.hpp).
TEST(Survey, OfSinglesIsALoopOverWhatTheyHold) {
  survey_every_law<Solid, float>(Precision::float32, 1e-5, 1e-3);
  survey_every_law<PlaneStrain, float>(Precision::float32, 1e-5, 1e-3);
}

TEST(Survey, NamesTheFirstOfEqualRates) {
  const paths::Specimen specimen = paths::zoo()[2];
  const Law law = make_law(specimen.material);
  ParticleSet set = worked_particles<Solid>(specimen, Precision::float64, 50);
  for (auto* fields : {&set.v, &set.f, &set.tau}) {
    for (ParticleScalar& scalar : *fields) {
      for (const int p : {13, 22, 31, 40}) scalar.set(p, (fields == &set.v ? 100.0 : 1.0) * scalar[5]);
    }
  }
  for (const Isa isa : instruction_sets()) {
    const auto survey = ugimp_kernels<double>(3, isa).laws[law.index()].survey;
    EXPECT_EQ(survey(view_of<double>(set, law, ugimp_kernels<double>(3, isa)), 0, 50, kCell).particle, 13)
        << isa_name(isa);
    EXPECT_EQ(survey(view_of<double>(set, law, ugimp_kernels<double>(3, isa)), 14, 50, kCell).particle, 22)
        << isa_name(isa);
  }
}

TEST(Survey, TellsWhatIsNotANumberOfEveryStress) {
  for (const paths::Specimen& specimen : paths::zoo()) {
    if (std::holds_alternative<NewtonianFluidDefinition>(specimen.material.law)) continue;  // its state is J alone
    if (std::holds_alternative<NeoHookeanDefinition>(specimen.material.law)) continue;      // its state is F alone
    const Law law = make_law(specimen.material);
    for (const Isa isa : instruction_sets()) {
      ParticleSet set = worked_particles<Solid>(specimen, Precision::float64, 30);
      for (const int p : {25, 18}) set.tau[0].set(p, std::numeric_limits<double>::quiet_NaN());
      const mpm_kernel::Fastest found = ugimp_kernels<double>(3, isa).laws[law.index()].survey(
          view_of<double>(set, law, ugimp_kernels<double>(3, isa)), 0, 30, kCell);
      EXPECT_TRUE(std::isnan(found.rate)) << specimen.material.name << ' ' << isa_name(isa);
      EXPECT_EQ(found.particle, 18) << specimen.material.name << ' ' << isa_name(isa);
    }
  }
}

// There are more particles than a thread surveys at once; the fastest particle and an equal one are in different parts.
TEST(Survey, DoesNotDependOnTheNumberOfThreads) {
  const paths::Specimen specimen = paths::zoo()[3];
  const std::vector<Law> laws = {make_law(specimen.material)};
  std::vector<ParticleSet> sets = {worked_particles<PlaneStrain>(specimen, Precision::float64, 20000)};
  const auto fastest = [&](int threads) {
    ContinuumSettings settings;
    settings.threads = threads;
    Fields fields = make_fields(GridLayout(2, Vec3::Constant(kCell), Vec3::Zero(), Vec3::Ones()));
    return make_mechanics(ugimp_kernels<double>(2, best_isa()), fields, sets, laws, settings)->fastest(0, kCell);
  };
  int expected = 0;
  for (int p = 1; p < sets[0].size(); ++p) {
    if (rate<PlaneStrain>(sets[0], laws[0], p) > rate<PlaneStrain>(sets[0], laws[0], expected)) expected = p;
  }
  EXPECT_EQ(fastest(1).index, expected);
  EXPECT_EQ(fastest(3).index, expected);
  EXPECT_EQ(fastest(3).rate, fastest(1).rate);
  for (const int p : {17000, 6000}) {
    for (auto* fields : {&sets[0].v, &sets[0].f, &sets[0].tau}) {
      for (ParticleScalar& scalar : *fields) scalar.set(p, (fields == &sets[0].v ? 10.0 : 1.0) * scalar[100]);
    }
  }
  EXPECT_EQ(fastest(1).index, 6000);
  EXPECT_EQ(fastest(3).index, 6000);
  for (const int p : {18000, 9000}) sets[0].v[1].set(p, std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(fastest(3).index, 9000);
  EXPECT_TRUE(std::isnan(fastest(3).rate));
}

}  // namespace survey_test
}  // namespace mpm::test
