// Angular momentum of a disk that spins and flies, by transfer. APIC conserves it: the angular momentum that particles
// spread to the grid in a step is that of the grid at the end of the step before, since a particle stores the moment of
// the grid's velocity about itself, wherever it moves. Source: Jiang, Schroeder, Selle, Teran & Stomakhin (2015);
// method reference 6.6. PIC loses it within a turn, FLIP loses some.
#include <gtest/gtest.h>

#include "step_scene.hpp"

namespace mpm::test {
namespace angular_momentum_test {

using Disk = StepScene<PlaneStrain>;
using Vector = Disk::Vector;

constexpr double kRadius = 0.55, kCentre = 1.5;  // [m]
constexpr double kRate = 4.0;                    // [1/s]: the rim is at a fifth of the fastest wave's speed
constexpr double kFlight = 0.1;                  // [m/s], along x

/// Angular momentum, about the axis through the initial centre, of what particles spread to the grid in the next step:
/// sum of m [x × v + sum over nodes of S (x_i - x_p) × B D^-1 (x_i - x_p)]. The second term is the skew part of B,
/// since the sum of S (x_i - x_p) (x_i - x_p)^T is D.
double angular_momentum(Disk& disk) {
  const ParticleSet& set = disk.set();
  double sum = 0.0;
  for (int p = 0; p < set.size(); ++p) {
    sum += (set.x[0][p] - kCentre) * set.v[1][p] - (set.x[1][p] - kCentre) * set.v[0][p];
    if (!set.affine.empty()) sum += set.affine[2][p] - set.affine[1][p];
  }
  return set.mass * sum;
}
/// Angular momentum of the grid about the same axis.
double grid_angular_momentum(Disk& disk) {
  double sum = 0.0;
  disk.each_node([&](int b, int n, const std::array<int, 3>& number) {
    const double x = disk.node_position(number[0]) - kCentre, z = disk.node_position(number[1]) - kCentre;
    sum += x * disk.grid.momentum.at(b, 1, n) - z * disk.grid.momentum.at(b, 0, n);
  });
  return sum;
}

Disk spinning_disk(const StepMethod& method) {
  Disk::Body body;
  body.cells = 10;
  body.jitter = 0.0;
  body.centre = {kCentre, kCentre, 0.0};
  body.keep = [](const Vector& x) { return std::hypot(x[0] - kCentre, x[1] - kCentre) < kRadius; };
  return Disk(method, body);
}

/// Angular momentum after a turn, relative to the initial one, and its largest relative change on the way.
struct Spin {
  double left, change = 0.0;
};
Spin spin(const StepMethod& method) {
  Disk disk = spinning_disk(method);
  disk.set_velocity([&](const Vector& x) {
    return Vector{kFlight - kRate * (x[1] - kCentre), kRate * (x[0] - kCentre), 0.0};
  });
  if (method.transfer.kind == TransferKind::apic) disk.set_affine({{0.0, -kRate, 0.0}, {kRate, 0.0, 0.0}, {}});
  const double start = angular_momentum(disk);
  const int steps = static_cast<int>(std::ceil(2.0 * M_PI / kRate / disk.dt));
  Spin spin{1.0};
  for (int n = 0; n < steps; ++n) {
    disk.step();
    spin.left = angular_momentum(disk) / start;
    spin.change = std::max(spin.change, std::abs(spin.left - 1.0));
  }
  EXPECT_GT(disk.sorts, 1) << method.name();  // particles have moved from block to block
  return spin;
}

// Exact to round-off: asserted at 1e-12 over a turn of some 730 steps, measured below 1e-13. Hat functions at a point
// are excluded: light nodes beside a particle make its second moment, and with it the other nodes' share of the angular
// momentum, arbitrarily small, and the disk flies apart, whether B or its gradient is stored.
TEST(AngularMomentum, IsKeptByApic) {
  for (const ShapeKind shape : kAllShapes) {
    if (shape == ShapeKind::dirac) continue;
    for (const UpdateScheme update : kAllUpdates) {
      const StepMethod method{shape, update, {TransferKind::apic, 1.0, 2}};
      EXPECT_LT(spin(method).change, 1e-12) << method.name();
    }
  }
}

// The sum over particles above equals that of the grid: D of the shape function drops out.
TEST(AngularMomentum, IsWhatApicHandsToTheGrid) {
  for (const ShapeKind shape : kAllShapes) {
    Disk disk = spinning_disk({shape, UpdateScheme::usf, {TransferKind::apic, 1.0, 2}});
    std::mt19937 random(2);
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    disk.set_velocity([&](const Vector&) { return Vector{u(random), u(random), 0.0}; });
    for (ParticleScalar& b : disk.set().affine) {
      for (int p = 0; p < disk.set().size(); ++p) b.set(p, 0.1 * Disk::kCell * u(random));
    }
    StepContext context = disk.context();
    disk.mechanics->scatter_momentum(context);
    // Round-off for some 300 particles with 1 m/s at one radius.
    EXPECT_NEAR(grid_angular_momentum(disk), angular_momentum(disk), 1e-13 * disk.set().mass * 300 * kRadius)
        << shape_name(shape);
  }
}

// PIC smears velocities over a cell in every step: the rotation of a particle's surroundings is lost each time, and
// that of the whole disk before the turn ends (measured: 0.2 % left). FLIP keeps velocities that the grid does not
// resolve; the part that the weights of the next step resolve costs 3 to 5 % in the turn here. No theory bounds this;
// asserted twice as wide.
TEST(AngularMomentum, IsLostByPicAndLessByFlip) {
  for (const ShapeKind shape : kAllShapes) {
    const StepMethod pic{shape, UpdateScheme::usavg, {TransferKind::flip, 0.0, 2}};
    const StepMethod flip{shape, UpdateScheme::usavg, {TransferKind::flip, 1.0, 2}};
    EXPECT_LT(std::abs(spin(pic).left), 0.01) << pic.name();
    const double left = spin(flip).left;
    EXPECT_GT(left, 0.9) << flip.name();
    EXPECT_LT(left, 0.99) << flip.name();
  }
}

}  // namespace angular_momentum_test
}  // namespace mpm::test
