// Many steps of the kernels: how far the results of instruction sets and the reference diverge, and that the number of
// threads changes nothing.
#include <gtest/gtest.h>

#include "kernel_scene.hpp"
#include "mpm/step/schedule.hpp"

namespace mpm::test {
namespace kernels_path_test {

/// The state of the particles, by id.
struct State {
  std::vector<double> x, v, tau;
};

template <class Values>
double largest(const Values& values) {
  double most = 0.0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}
double distance(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

template <class Geometry, class T>
class Run {
 public:
  Run(const paths::Specimen& specimen, Places places, Isa isa, bool usavg, int threads = 1, double flip = 1.0)
      : usavg_(usavg), scene_(ShapeKind::ugimp, specimen, places, isa, settings(threads, flip)) {
    for (ParticleSet& set : scene_.sets) {
      if (!usavg) set.next_x.clear();
    }
    scene_.dt *= kSlow;
  }

  void advance(int steps) {
    StepContext context{scene_.fields, scene_.dt};
    Sorter sorter(scene_.settings.threads, kernel_grouping(scene_.kernels));
    const Modules none;
    for (int n = 0; n < steps; ++n) {
      (usavg_ ? step_usavg : step_usf)(*scene_.mechanics, none, context);
      ASSERT_FALSE(scene_.mechanics->failed());
      if (scene_.mechanics->needs_sort()) {
        ++sorts;
        ASSERT_FALSE(sorter.sort(scene_.sets, scene_.fields));
      }
    }
  }
  /// Advances the reference by as many steps, from the same start.
  void advance_reference(int steps) {
    auto& r = scene_.reference;
    double gravity[3] = {};
    for (int k = 0; k < Geometry::kDim; ++k) gravity[k] = scene_.settings.gravity[scene_.grid.layout.axis(k)];
    const double least = scene_.grid.least_mass, dt = scene_.dt, strain_dt = usavg_ ? 0.5 * dt : dt;
    const int terms = scene_.settings.gradient_terms;
    for (int n = 0; n < steps; ++n) {
      r.scatter_momentum();
      r.nodal_velocity(least);
      r.strain(strain_dt, terms);
      r.force();
      r.nodal_update(dt, gravity, least);
      r.move(mpm_kernel::kIncrement, dt, scene_.settings.transfer.flip);
      if (usavg_) {
        r.gather_momentum();
        r.nodal_velocity(least);
        r.strain(strain_dt, terms);
      }
      r.place();
    }
  }

  State of_reference() {
    State state = empty();
    scene_.reference.each([&](const auto&, const auto& p) {
      double t[Geometry::kSymmetric], *to[Geometry::kSymmetric];
      for (int c = 0; c < Geometry::kSymmetric; ++c) to[c] = t + c;
      Geometry::store_symmetric(p.tau, to, 0);
      std::copy(p.x, p.x + Geometry::kDim, &state.x[p.id * Geometry::kDim]);
      std::copy(p.v, p.v + Geometry::kDim, &state.v[p.id * Geometry::kDim]);
      std::copy(t, t + Geometry::kSymmetric, &state.tau[p.id * Geometry::kSymmetric]);
    });
    return state;
  }
  State state() {
    State state = empty();
    for (const ParticleSet& set : scene_.sets) {
      for (int p = 0; p < set.size(); ++p) {
        for (int k = 0; k < Geometry::kDim; ++k) {
          state.x[set.id[p] * Geometry::kDim + k] = set.x[k][p];
          state.v[set.id[p] * Geometry::kDim + k] = set.v[k][p];
        }
        for (int c = 0; c < Geometry::kSymmetric; ++c) state.tau[set.id[p] * Geometry::kSymmetric + c] = set.tau[c][p];
      }
    }
    return state;
  }

  int sorts = 0;

 private:
  static constexpr double kSlow = 0.5;  ///< part of the scene's step, stable also for torn material

  static ContinuumSettings settings(int threads, double flip) {
    ContinuumSettings settings;
    settings.threads = threads;
    settings.transfer.flip = flip;
    return settings;
  }
  State empty() {
    std::size_t count = 0;
    for (const ParticleSet& set : scene_.sets) count += set.size();
    return {std::vector<double>(count * Geometry::kDim), std::vector<double>(count * Geometry::kDim),
            std::vector<double>(count * Geometry::kSymmetric)};
  }

  bool usavg_;
  KernelScene<Geometry, T> scene_;
};

class KernelsPathTest : public testing::TestWithParam<Isa> {};
INSTANTIATE_TEST_SUITE_P(Isas, KernelsPathTest, testing::ValuesIn(available_isas()),
                         [](const auto& info) { return isa_name(info.param); });

// Each step rounds what the next one begins with. Stable waves do not amplify it, so that n steps add up to about
// n epsilon times stiffness over stress, here up to 100: 2e-12 for 100 steps. Measured: 8e-14.
template <class Geometry>
void check_growth(Isa isa) {
  double worst = 0.0;
  for (const bool usavg : {false, true}) {
    for (const int law : {2, 3, 7}) {  // neo-Hookean, soil, metal
      paths::Specimen specimen = paths::zoo()[law];
      specimen.strain = std::min(specimen.strain, 0.01);  // faster material would leave the grid in 100 steps
      Run<Geometry, double> run(specimen, Places::irregular, isa, usavg);
      int done = 0;
      for (const int steps : {1, 10, 100}) {
        run.advance(steps - done);
        run.advance_reference(steps - done);
        done = steps;
        const State found = run.state(), expected = run.of_reference();
        const double apart = std::max({distance(found.x, expected.x) / largest(expected.x),
                                       distance(found.v, expected.v) / largest(expected.v),
                                       distance(found.tau, expected.tau) / largest(expected.tau)});
        EXPECT_LE(apart, 1e-12) << specimen.material.name << " after " << steps << " steps, usavg " << usavg;
        worst = std::max(worst, apart);
      }
      EXPECT_GT(run.sorts, 0) << specimen.material.name;  // groups became mixed and were made anew
    }
  }
  testing::Test::RecordProperty("apart", std::to_string(1e15 * worst) + "e-15");
}

TEST_P(KernelsPathTest, GrowsApartSlowlyInASolid) { check_growth<Solid>(GetParam()); }
TEST_P(KernelsPathTest, GrowsApartSlowlyInAPlane) { check_growth<PlaneStrain>(GetParam()); }

template <class Geometry, class T>
void check_threads(Isa isa) {
  for (const bool usavg : {false, true}) {
    for (const Places places : {Places::irregular, Places::loose, Places::bodies}) {
      paths::Specimen specimen = paths::zoo()[3];
      State one;
      for (const int threads : {1, 2, 3}) {
        Run<Geometry, T> run(specimen, places, isa, usavg, threads, 0.95);
        const State before = run.state();
        run.advance(20);
        const State after = run.state();
        if (threads == 1) {
          one = after;
          EXPECT_GT(distance(before.tau, after.tau), 0.1 * largest(before.tau));
          continue;
        }
        EXPECT_EQ(after.x, one.x) << threads << " threads, " << name_of(places);
        EXPECT_EQ(after.v, one.v) << threads << " threads, " << name_of(places);
        EXPECT_EQ(after.tau, one.tau) << threads << " threads, " << name_of(places);
      }
    }
  }
}

TEST_P(KernelsPathTest, HasTheSameBitsForAnyNumberOfThreads) {
  check_threads<Solid, double>(GetParam());
  check_threads<PlaneStrain, double>(GetParam());
  check_threads<Solid, float>(GetParam());
  check_threads<PlaneStrain, float>(GetParam());
}

}  // namespace kernels_path_test
}  // namespace mpm::test
