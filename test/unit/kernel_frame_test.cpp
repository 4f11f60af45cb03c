// Other shape functions in the frame of the kernels: one with a tensor stencil of three nodes an axis, which is a class
// and no more, and one whose nodes are scattered, which brings passes of its own. The schedule is the same.
#include "corner_passes.hpp"
#include "kernel_check.hpp"
#include "mpm/shape/bspline.hpp"
#include "mpm/step/schedule.hpp"

namespace mpm_plain {
const mpm_kernel::KernelTable<double>& solid_spline_double();
}
namespace mpm_avx2 {
const mpm_kernel::KernelTable<double>& solid_spline_double();
}
namespace mpm_avx512 {
const mpm_kernel::KernelTable<double>& solid_spline_double();
}

namespace mpm::test {
namespace {

constexpr int kNeoHookean = 2;  // of the zoo

const mpm_kernel::KernelTable<double>& spline_kernels(Isa isa) {
#if defined(MPM_X86_KERNELS)
  if (isa == Isa::avx512) return mpm_avx512::solid_spline_double();
  if (isa == Isa::avx2) return mpm_avx2::solid_spline_double();
#endif
  (void)isa;
  return mpm_plain::solid_spline_double();
}

paths::Specimen gentle() {
  paths::Specimen specimen = paths::zoo()[kNeoHookean];
  specimen.strain = 0.01;
  return specimen;
}

class KernelFrameTest : public testing::TestWithParam<Isa> {};
INSTANTIATE_TEST_SUITE_P(Isas, KernelFrameTest, testing::ValuesIn(available_isas()),
                         [](const auto& info) { return isa_name(info.param); });

TEST_P(KernelFrameTest, SplinesGoThroughThePasses) {
  const auto& kernels = spline_kernels(GetParam());
  for (const int law : {kNeoHookean, 3, 9}) {
    for (const Places places : kAllPlaces) {
      for (const bool regather : {false, true}) {
        Kernels<Solid, double, QuadraticSpline>(paths::zoo()[law], places, GetParam(), 0.95, &kernels).check(regather);
      }
    }
  }
}

// Both reproduce linear fields: the gradient of A x is A at every particle, F = (I + A dt) F_old with one term.
void check_linear_field(const mpm_kernel::KernelTable<double>& kernels, Places places, Isa isa) {
  ContinuumSettings settings;
  settings.gradient_terms = 1;
  KernelScene<Solid, double> scene(gentle(), places, isa, settings, &kernels);
  const Matrix3<double> a = {0.3, -0.2, 0.5, 0.7, -0.4, 0.1, -0.6, 0.2, 0.35};
  const double rows[3][3] = {{a.xx, a.xy, a.xz}, {a.yx, a.yy, a.yz}, {a.zx, a.zy, a.zz}};
  StepContext context{scene.grid, 0.1};
  scene.mechanics->scatter_momentum(context);
  for (int b = 0; b < scene.grid.blocks.size(); ++b) {
    for (int n = 0; n < 64; ++n) {
      const Vec3 x = scene.grid.layout.node_position(scene.grid.blocks.block(b), n);
      for (int c = 0; c < 3; ++c) {
        scene.grid.velocity.at(b, c, n) = rows[c][0] * x[0] + rows[c][1] * x[1] + rows[c][2] * x[2];
      }
    }
  }
  scene.mechanics->strain_and_force(context, context.dt);
  double error = 0.0;
  for (int p = 0; p < scene.sets[0].size(); ++p) {
    const auto& old = scene.reference.sets[0].particles[p].f;
    const Matrix3<double> expected = product(exponential(paths::scaled(a, context.dt), 1), old);
    const Matrix3<double> found = Solid::load_matrix(scene.sets[0].f, p);
    for (const double apart : {found.xx - expected.xx, found.xy - expected.xy, found.xz - expected.xz,
                               found.yx - expected.yx, found.yy - expected.yy, found.yz - expected.yz,
                               found.zx - expected.zx, found.zy - expected.zy, found.zz - expected.zz}) {
      error = std::max(error, std::abs(apart));
    }
  }
  // Velocities up to 3 times epsilon, over the smallest cell of 1/16: 1e-14 for a gradient, of which a tenth counts.
  EXPECT_LT(error, 1e-14) << name_of(places);
}

// Steps of either schedule: momentum changes by gravity alone, whatever the shape functions; forces sum to zero.
void check_momentum(const mpm_kernel::KernelTable<double>& kernels, Isa isa) {
  for (const bool usavg : {false, true}) {
    KernelScene<Solid, double> scene(gentle(), Places::irregular, isa, {}, &kernels);
    ParticleSet& set = scene.sets[0];
    if (!usavg) set.next_x.clear();
    const auto momentum = [&] {
      Vec3 sum = Vec3::Zero();
      for (int p = 0; p < set.size(); ++p) sum += set.mass * Vec3(set.v[0][p], set.v[1][p], set.v[2][p]);
      return sum;
    };
    const Vec3 before = momentum();
    const double energy = set.tau[0][0];
    StepContext context{scene.grid, 0.5 * scene.dt};
    Sorter sorter(1, kernel_grouping(kernels));
    Stages none;
    int sorts = 0;
    for (int n = 0; n < 100; ++n) {
      (usavg ? step_usavg : step_usf)(*scene.mechanics, none, context);
      ASSERT_FALSE(scene.mechanics->failed());
      if (scene.mechanics->needs_sort()) {
        ++sorts;
        ASSERT_FALSE(sorter.sort(scene.sets, scene.grid));
      }
    }
    EXPECT_NE(set.tau[0][0], energy);
    const double mass = set.mass * set.size(), time = 100 * context.dt;
    double exchanged = 0.0;
    for (int p = 0; p < set.size(); ++p) {
      exchanged += set.mass * Vec3(set.v[0][p], set.v[1][p], set.v[2][p]).norm();
    }
    // A hundred steps, each off by some epsilon of the momentum that passes through the grid.
    EXPECT_LT((momentum() - before - mass * time * scene.settings.gravity).norm(), 1e-13 * exchanged)
        << "usavg " << usavg << ", " << sorts << " sorts";
  }
}

TEST_P(KernelFrameTest, UgimpReproducesALinearField) {
  for (const Places places : kAllPlaces) check_linear_field(ugimp_kernels<double>(3, GetParam()), places, GetParam());
}

TEST_P(KernelFrameTest, SplinesReproduceALinearField) {
  for (const Places places : kAllPlaces) check_linear_field(spline_kernels(GetParam()), places, GetParam());
}

TEST_P(KernelFrameTest, SplinesGoThroughTheSchedule) { check_momentum(spline_kernels(GetParam()), GetParam()); }

TEST_P(KernelFrameTest, ScatteredNodesGoThroughTheSchedule) {
  const auto kernels = CornerPasses::table(ugimp_kernels<double>(3, GetParam()));
  for (const Places places : kAllPlaces) {
    if (places != Places::bodies) check_linear_field(kernels, places, GetParam());
  }
  check_momentum(kernels, GetParam());
}

}  // namespace
}  // namespace mpm::test
