// Identities that every method must satisfy in any scene: conservation of linear momentum, a uniform motion, linear
// fields; and the definitions of the transfers (method reference 6.6). The steps are those of the real schedules,
// without walls and gravity.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <map>

#include "mpm/math/dimension.hpp"
#include "mpm/math/exponential.hpp"
#include "step_scene.hpp"

namespace mpm::test {
namespace step_identities_test {

using Vector = std::array<double, 3>;

/// Momentum, and the sum of the magnitudes of its parts [N s].
struct Momentum {
  Vector sum{};
  double size = 0.0;
};
template <class Scene>
Momentum momentum_of(Scene& scene) {
  Momentum momentum;
  const ParticleSet& set = scene.set();
  for (int p = 0; p < set.size(); ++p) {
    for (int k = 0; k < Scene::kDim; ++k) {
      momentum.sum[k] += set.mass_of(p) * set.v[k][p];
      momentum.size += set.mass_of(p) * std::abs(set.v[k][p]);
    }
  }
  return momentum;
}

/// Sets random velocities of up to 1 m/s, a tenth of the wave speed here. Those of rings decrease towards the axis,
/// where they are zero.
template <class Geometry, class T>
void shake(StepScene<Geometry, T>& scene) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  scene.set_velocity([&](const Vector& x) {
    const double along_x = u(random) + 0.3;
    return Vector{Geometry::kHoop ? along_x * x[0] : along_x, u(random), u(random)};
  });
}

// Weights sum to one, gradients to zero: method reference 1.1. The round-off of a step is some epsilon of the
// transferred momentum, and random: that of 100 steps is ten times as large.
template <class Geometry>
void check_momentum(int steps) {
  each_method<Geometry>([&](const StepMethod& method) {
    StepScene<Geometry> scene(method);
    shake(scene);
    const Momentum before = momentum_of(scene);
    scene.advance(steps);
    const Momentum after = momentum_of(scene);
    // The hoop stress of rings changes their radial momentum.
    for (int k = Geometry::kHoop ? 1 : 0; k < Geometry::kDim; ++k) {
      EXPECT_NEAR(after.sum[k], before.sum[k], 1e-13 * before.size) << method.name();
    }
  });
}
TEST(StepIdentities, KeepMomentumInAPlane) { check_momentum<PlaneStrain>(100); }
TEST(StepIdentities, KeepMomentumInASolid) { check_momentum<Solid>(10); }
TEST(StepIdentities, RingsKeepAxialMomentum) { check_momentum<Axisymmetric>(100); }

// Gradients of a uniform velocity are differences of equal numbers, rounded: epsilon v / h. 100 steps of dt add up to a
// strain of at most 100 epsilon v dt / h, here 100 epsilon.
template <class Geometry>
void check_translation() {
  each_method<Geometry>([&](const StepMethod& method) {
    StepScene<Geometry> scene(method);
    const double v = 0.5 * scene.kCell / scene.dt / 100.0;  // half a cell in 100 steps
    const Vector velocity{Geometry::kHoop ? 0.0 : v, -0.5 * v, 0.0};
    scene.set_velocity([&](const Vector&) { return velocity; });
    scene.advance(100);
    const ParticleSet& set = scene.set();
    const double stiffness = scene.kStiffness / scene.kDensity;
    for (int p = 0; p < set.size(); ++p) {
      for (int k = 0; k < 2; ++k) EXPECT_NEAR(set.v[k][p], velocity[k], 1e-13 * v) << method.name();
      for (const ParticleScalar& tau : set.tau) EXPECT_NEAR(tau[p], 0.0, 1e-13 * stiffness) << method.name();
    }
  });
}
TEST(StepIdentities, RigidTranslationLeavesNoStress) { check_translation<PlaneStrain>(); }
TEST(StepIdentities, TranslationOfRingsLeavesNoStress) { check_translation<Axisymmetric>(); }

constexpr double kGradient[3][3] = {{0.7, -0.4, 0.3}, {0.2, -0.6, 0.5}, {-0.1, 0.8, 0.4}};  // [1/s]
Vector linear(const Vector& x) {
  Vector v{};
  for (int c = 0; c < 3; ++c) {
    for (int k = 0; k < 3; ++k) v[c] += kGradient[c][k] * (x[k] - 1.4);
  }
  return v;
}

/// Sets the velocity of nodes to `field` of their positions, and to zero beyond walls.
template <class Scene>
void set_grid_velocity(Scene& scene, const std::function<Vector(const Vector&)>& field) {
  scene.each_node([&](int b, int n, const std::array<int, 3>& number) {
    Vector x{};
    bool inside = true;
    for (int k = 0; k < Scene::kDim; ++k) {
      x[k] = scene.node_position(number[k]);
      inside = inside && (number[k] >= 0 || !scene.grid.has_wall[2 * k]);
    }
    const Vector v = field(x);
    for (int k = 0; k < Scene::kDim; ++k) scene.grid.velocity.at(b, k, n) = inside ? v[k] : 0.0;
  });
}

/// About an axis v_r is a multiple of r, since otherwise the hoop strain would not be uniform.
template <class Geometry>
Vector linear_in(const Vector& x) {
  const Vector v = linear(x);
  return {Geometry::kHoop ? kGradient[0][0] * x[0] : v[0], v[1], v[2]};
}
template <class Geometry>
auto gradient_in(double dt) {
  double l[Geometry::kDim][Geometry::kDim];
  for (int c = 0; c < Geometry::kDim; ++c) {
    for (int k = 0; k < Geometry::kDim; ++k) l[c][k] = Geometry::kHoop && c < k ? 0.0 : kGradient[c][k] * dt;
  }
  auto gradient = Geometry::gradient(l);
  if constexpr (Geometry::kHoop) gradient.yy = l[0][0];
  return gradient;
}

// Linear completeness, method reference 1.1: every shape function reproduces the gradient of a linear field. Round-off
// is that of numbers of the size of position over cell, 24, times epsilon.
template <class Geometry>
void check_gradient() {
  for (const ShapeKind shape : kAllShapes) {
    if (!has_shape(shape, kGeometryKind<Geometry>)) continue;
    StepScene<Geometry> scene({shape, UpdateScheme::usf, {}});
    StepContext context = scene.context();
    scene.mechanics->scatter_momentum(context);
    set_grid_velocity(scene, linear_in<Geometry>);
    scene.mechanics->strain_and_force(context, scene.dt);
    double expected[Geometry::kMatrix], *to[Geometry::kMatrix];
    for (int c = 0; c < Geometry::kMatrix; ++c) to[c] = expected + c;
    Geometry::store_matrix(exponential(gradient_in<Geometry>(scene.dt), 2), to, 0);
    for (int p = 0; p < scene.set().size(); ++p) {
      for (int c = 0; c < Geometry::kMatrix; ++c) {
        EXPECT_NEAR(scene.set().f[c][p], expected[c], 1e-14) << shape_name(shape) << " component " << c;
      }
    }
  }
}
TEST(StepIdentities, LinearVelocityIsReproducedInAPlane) { check_gradient<PlaneStrain>(); }
TEST(StepIdentities, LinearVelocityIsReproducedInASolid) { check_gradient<Solid>(); }
TEST(StepIdentities, HomologousVelocityIsReproducedAboutAnAxis) { check_gradient<Axisymmetric>(); }

// XPIC(1) and FMPM(1) are PIC: from one state, particles have the same velocity after a step. (Positions differ by
// definition: those of PIC follow 6.2, those of XPIC and FMPM 6.6.)
template <class Geometry>
void check_first_orders() {
  for (const ShapeKind shape : kAllShapes) {
    if (!has_shape(shape, kGeometryKind<Geometry>)) continue;
    for (const UpdateScheme update : kAllUpdates) {
      std::vector<double> pic;
      for (const Transfer& transfer : {Transfer{TransferKind::flip, 0.0, 1}, Transfer{TransferKind::xpic, 1.0, 1},
                                       Transfer{TransferKind::fmpm, 1.0, 1}}) {
        const StepMethod method{shape, update, transfer};
        StepScene<Geometry> scene(method);
        shake(scene);
        scene.set().tau[0].visit([](auto& tau) { std::fill(tau.begin(), tau.end(), 3.0); });
        scene.step();
        for (int p = 0; p < scene.set().size(); ++p) {
          const double v = scene.set().v[0][p];
          if (transfer.kind == TransferKind::flip) {
            pic.push_back(v);
          } else {
            EXPECT_NEAR(v, pic[p], 1e-14) << method.name() << " particle " << p;  // for velocities of 1 m/s
          }
        }
      }
    }
  }
}
TEST(StepIdentities, FirstOrdersArePic) { check_first_orders<PlaneStrain>(); }
TEST(StepIdentities, FirstOrdersOfRingsArePic) { check_first_orders<Axisymmetric>(); }

/// S of all particles, and S+ = m^-1 S^T M, as dense matrices over the nodes that carry mass.
struct Dense {
  Eigen::MatrixXd s, s_plus;
  std::vector<NodeRef> nodes;
};
template <class Scene>
Dense dense_of(Scene& scene) {
  Dense dense;
  std::map<std::array<int, 3>, int> column;
  scene.each_node([&](int b, int n, const std::array<int, 3>& number) {
    if (!scene.grid.carries(b, n)) return;
    column[number] = static_cast<int>(dense.nodes.size());
    dense.nodes.push_back({b, n});
  });
  const ParticleSet& set = scene.set();
  dense.s = Eigen::MatrixXd::Zero(set.size(), dense.nodes.size());
  for (int p = 0; p < set.size(); ++p) {
    for (const NodeWeight& n : scene.stencil(p)) {
      if (n.s != 0.0) dense.s(p, column.at(n.at)) += n.s;
    }
  }
  dense.s_plus = dense.s.transpose();
  for (int p = 0; p < set.size(); ++p) dense.s_plus.col(p) *= set.mass_of(p);
  for (int i = 0; i < dense.s_plus.rows(); ++i) dense.s_plus.row(i) /= dense.s_plus.row(i).sum();
  return dense;
}

// Method reference 6.6: V <- [I - (I - S S+)^m] V + S a dt of XPIC(m), V <- S sum over j < k of (I - S+ S)^j v^{n+1} of
// FMPM(k). Sums of up to five terms of 1 m/s: 1e-13.
template <class Geometry>
void check_matrices() {
  for (const ShapeKind shape : kAllShapes) {
    if (!has_shape(shape, kGeometryKind<Geometry>)) continue;
    for (const TransferKind kind : {TransferKind::xpic, TransferKind::fmpm}) {
      for (const int order : {1, 2, 3, 5}) {
        const StepMethod method{shape, UpdateScheme::usf, {kind, 1.0, order}};
        StepScene<Geometry> scene(method, {3});
        shake(scene);
        scene.advance(3);  // creates some stress
        StepContext context = scene.context();
        scene.mechanics->scatter_momentum(context);
        const Dense dense = dense_of(scene);
        const int nodes = static_cast<int>(dense.nodes.size()), particles = scene.set().size();
        Eigen::MatrixXd before(particles, 2), v(nodes, 2), a(nodes, 2);
        for (int p = 0; p < particles; ++p) before.row(p) << scene.set().v[0][p], scene.set().v[1][p];
        scene.mechanics->strain_and_force(context, scene.dt);
        scene.mechanics->update_momentum(context);
        for (int i = 0; i < nodes; ++i) {
          for (int c = 0; c < 2; ++c) {
            v(i, c) = scene.grid.velocity.at(dense.nodes[i].block, c, dense.nodes[i].node);
            a(i, c) = scene.grid.force.at(dense.nodes[i].block, c, dense.nodes[i].node);
          }
        }
        if (scene.mechanics->increments() > 0) scene.mechanics->begin_increments(context);
        for (int n = 0; n < scene.mechanics->increments(); ++n) {
          scene.mechanics->find_increment(context);
          scene.mechanics->add_increment(context);
        }
        scene.mechanics->move_particles(context);
        Eigen::MatrixXd expected;
        if (kind == TransferKind::xpic) {
          const Eigen::MatrixXd lost = Eigen::MatrixXd::Identity(particles, particles) - dense.s * dense.s_plus;
          Eigen::MatrixXd left = before;
          for (int j = 0; j < order; ++j) left = lost * left;
          expected = before - left + dense.s * a * scene.dt;
        } else {
          Eigen::MatrixXd term = v, sum = v;
          for (int j = 1; j < order; ++j) sum += term = (term - dense.s_plus * (dense.s * term)).eval();
          expected = dense.s * sum;
        }
        EXPECT_GT((a * scene.dt).cwiseAbs().maxCoeff(), 1e-3) << method.name();
        for (int p = 0; p < particles; ++p) {
          for (int c = 0; c < 2; ++c) EXPECT_NEAR(scene.set().v[c][p], expected(p, c), 1e-13) << method.name();
        }
      }
    }
  }
}
TEST(StepIdentities, XpicAndFmpmAreTheirMatrices) { check_matrices<PlaneStrain>(); }
TEST(StepIdentities, XpicAndFmpmOfRingsAreTheirMatrices) { check_matrices<Axisymmetric>(); }

// APIC transfers a linear field to the grid and back without change, 50 times with particles that do not move (steps of
// zero time). The velocity of a particle is the field's at the mean position of its shape function. Gradients are
// differences over second moments, which are at least 1e-3 of a cell squared here.
template <class Geometry>
void check_affine() {
  for (const ShapeKind shape : kAllShapes) {
    if (!has_shape(shape, kGeometryKind<Geometry>)) continue;
    StepScene<Geometry> scene({shape, UpdateScheme::usf, {TransferKind::apic, 1.0, 2}});
    for (int p = 0; p < scene.set().size(); ++p) {
      const Vector v = linear_in<Geometry>(scene.mean_place(p));
      for (int k = 0; k < Geometry::kDim; ++k) scene.set().v[k].set(p, v[k]);
    }
    scene.dt = 0.0;
    double gradient[3][3];
    for (int c = 0; c < 3; ++c) {
      for (int k = 0; k < 3; ++k) gradient[c][k] = Geometry::kHoop && c < k ? 0.0 : kGradient[c][k];
    }
    scene.set_affine(gradient);
    scene.advance(50);
    StepContext context = scene.context();
    scene.mechanics->scatter_momentum(context);
    for (int p = 0; p < scene.set().size(); ++p) {
      const Vector v = linear_in<Geometry>(scene.mean_place(p));
      for (int k = 0; k < Geometry::kDim; ++k) EXPECT_NEAR(scene.set().v[k][p], v[k], 1e-12) << shape_name(shape);
    }
    scene.each_node([&](int b, int n, const std::array<int, 3>& number) {
      if (!(scene.grid.mass.at(b, 0, n) > 1e-6 * scene.set().mass)) return;
      Vector x{};
      for (int k = 0; k < Geometry::kDim; ++k) x[k] = scene.node_position(number[k]);
      const Vector v = linear_in<Geometry>(x);
      for (int k = 0; k < Geometry::kDim; ++k) {
        EXPECT_NEAR(scene.grid.velocity.at(b, k, n), v[k], 1e-10) << shape_name(shape);
      }
    });
  }
}
TEST(StepIdentities, ApicKeepsALinearFieldInAPlane) { check_affine<PlaneStrain>(); }
TEST(StepIdentities, ApicKeepsALinearFieldInASolid) { check_affine<Solid>(); }
TEST(StepIdentities, ApicKeepsAHomologousFieldAboutAnAxis) { check_affine<Axisymmetric>(); }

}  // namespace step_identities_test
}  // namespace mpm::test
