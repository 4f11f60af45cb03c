// Splines folded at walls (shape/bspline.hpp), tested through the kernels: a field that is zero on a wall is zero there
// for particles beside the wall, and so is one that they spread. The field is linear in position and vanishes on a
// wall's nodes, as walls leave it, with nothing on the nodes beyond.
#include <gtest/gtest.h>

#include <algorithm>

#include "step_scene.hpp"

namespace mpm::test {
namespace spline_walls_test {

constexpr ShapeKind kSplines[] = {ShapeKind::bspline2, ShapeKind::bspline3};

// A block in the corner between the walls at the domain's lower faces, touching them.
template <class Geometry>
typename StepScene<Geometry>::Body corner() {
  using Scene = StepScene<Geometry>;
  typename Scene::Body body;
  body.walls = true;
  for (double& x : body.centre) x = 0.5 * body.cells * Scene::kCell;
  body.keep = [](const typename Scene::Vector& x) { return *std::min_element(x.begin(), x.begin() + Scene::kDim) > 0; };
  return body;
}

// Each component increases from its own wall: v_k = rate_k x_k.
constexpr double kRate[3] = {0.5, -0.3, 0.8};  // [1/s]

template <class Geometry>
void check_seen() {
  for (const ShapeKind shape : kSplines) {
    for (const Transfer& transfer : kAllTransfers) {
      const StepMethod method{shape, UpdateScheme::usf, transfer};
      StepScene<Geometry> scene(method, corner<Geometry>());
      StepContext context = scene.context();
      scene.mechanics->scatter_momentum(context);
      double beside = 1.0;  // the nearest particle to a wall [cells]
      scene.each_node([&](int b, int n, const std::array<int, 3>& number) {
        for (int k = 0; k < Geometry::kDim; ++k) {
          scene.grid.velocity.at(b, k, n) = kRate[k] * std::max(0.0, scene.node_position(number[k]));
          scene.grid.force.at(b, k, n) = 0.0;
        }
      });
      // Without force, particles adopt the field; FLIP adopts accelerations only.
      const auto before = scene.set();
      scene.mechanics->strain_and_force(context, scene.dt);
      for (int p = 0; p < scene.set().size(); ++p) {
        for (int c = 0; c < Geometry::kDim; ++c) {
          beside = std::min(beside, scene.set().x[c][p] / scene.kCell);
          for (int k = 0; k < Geometry::kDim; ++k) {
            const double a = kRate[c] * scene.dt, grown = c == k ? 1.0 + a + 0.5 * a * a : 0.0;
            EXPECT_NEAR(scene.set().f[c * Geometry::kDim + k][p], grown, 1e-14) << method.name();
          }
        }
      }
      EXPECT_LT(beside, 0.1);
      if (transfer.kind == TransferKind::flip) continue;
      scene.mechanics->move_particles(context);
      for (int p = 0; p < scene.set().size(); ++p) {
        for (int k = 0; k < Geometry::kDim; ++k) {
          EXPECT_NEAR(scene.set().v[k][p], kRate[k] * before.x[k][p], 1e-14) << method.name();
        }
      }
    }
  }
}
TEST(SplineWalls, ALinearFieldIsSeenBesideThemInAPlane) { check_seen<PlaneStrain>(); }
TEST(SplineWalls, ALinearFieldIsSeenBesideThemInASolid) { check_seen<Solid>(); }

// With APIC the particles also spread the field: nothing beyond the walls, and zero on them, without a condition there.
template <class Geometry>
void check_made() {
  for (const ShapeKind shape : kSplines) {
    StepScene<Geometry> scene({shape, UpdateScheme::usf, {TransferKind::apic, 1.0, 2}}, corner<Geometry>());
    scene.set_velocity([](const auto& x) {
      return std::array<double, 3>{kRate[0] * x[0], kRate[1] * x[1], kRate[2] * x[2]};
    });
    scene.set_affine({{kRate[0], 0.0, 0.0}, {0.0, kRate[1], 0.0}, {0.0, 0.0, kRate[2]}});
    scene.dt = 0.0;
    scene.advance(20);  // back and forth
    StepContext context = scene.context();
    scene.mechanics->scatter_momentum(context);
    int on_wall = 0;
    scene.each_node([&](int b, int n, const std::array<int, 3>& number) {
      const double mass = scene.grid.mass.at(b, 0, n);
      for (int k = 0; k < Geometry::kDim; ++k) {
        if (number[k] < 0) {
          EXPECT_EQ(mass, 0.0) << shape_name(shape);
        } else if (mass > 1e-6 * scene.set().mass) {
          const double expected = kRate[k] * scene.node_position(number[k]);
          EXPECT_NEAR(scene.grid.velocity.at(b, k, n), expected, 1e-12) << shape_name(shape);
          on_wall += number[k] == 0;
        }
      }
    });
    EXPECT_GT(on_wall, 0);
  }
}
TEST(SplineWalls, ApicMakesALinearFieldBesideThemInAPlane) { check_made<PlaneStrain>(); }
TEST(SplineWalls, ApicMakesALinearFieldBesideThemInASolid) { check_made<Solid>(); }

// A particle slightly beyond a wall, where the second moment of the weights is negative, and one on the wall, where it
// is zero: the values that they gather are finite and equal to the field.
TEST(SplineWalls, ApicGoesOnBeyondThem) {
  for (const ShapeKind shape : kSplines) {
    StepScene<PlaneStrain> scene({shape, UpdateScheme::usf, {TransferKind::apic, 1.0, 2}}, corner<PlaneStrain>());
    scene.set().x[0][0] = 0.0;
    scene.set().x[0][1] = -1e-6 * scene.kCell;
    scene.set().x[1][2] = -0.2 * scene.kCell;
    const std::array<double, 3> rate{0.5, 0.5, 0.0};
    scene.set_velocity([&](const auto& x) { return std::array<double, 3>{rate[0] * x[0], rate[1] * x[1], 0.0}; });
    scene.set_affine({{rate[0], 0.0, 0.0}, {0.0, rate[1], 0.0}, {}});
    scene.dt = 0.0;
    scene.advance(20);
    for (int p = 0; p < scene.set().size(); ++p) {
      for (int k = 0; k < 2; ++k) EXPECT_NEAR(scene.set().v[k][p], rate[k] * scene.set().x[k][p], 1e-12);
    }
  }
}

}  // namespace spline_walls_test
}  // namespace mpm::test
