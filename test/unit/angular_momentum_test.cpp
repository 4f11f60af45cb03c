// Angular momentum of a disk that spins and flies, by transfer. APIC keeps it: what particles hand to the grid in a
// step has the angular momentum of the grid at the end of the step before, since a particle keeps the moment of the
// grid's velocity about it, whatever it moves on to. Source: Jiang, Schroeder, Selle, Teran & Stomakhin (2015); method
// reference 6.6. PIC forgets it within a turn, FLIP loses some.
#include <gtest/gtest.h>

#include "step_scene.hpp"

namespace mpm::test {
namespace {

using Disk = StepScene<PlaneStrain>;
using Vector = Disk::Vector;

constexpr double kRadius = 0.55, kCentre = 1.5;  // [m]
constexpr double kRate = 4.0;                    // [1/s]: the rim is at a fifth of the fastest wave's speed
constexpr double kFlight = 0.1;                  // [m/s], along x

/// About the axis through the start's centre, of what particles hand to the grid in the next step: sum of
/// m [x × v + sum over nodes of S (x_i - x_p) × B D^-1 (x_i - x_p)], of which the second is the skew part of B,
/// since sum of S (x_i - x_p) (x_i - x_p)^T is D.
double angular_momentum(Disk& disk) {
  const ParticleSet& set = disk.set();
  double sum = 0.0;
  for (int p = 0; p < set.size(); ++p) {
    sum += (set.x[0][p] - kCentre) * set.v[1][p] - (set.x[1][p] - kCentre) * set.v[0][p];
    if (!set.affine.empty()) sum += set.affine[2][p] - set.affine[1][p];
  }
  return set.mass * sum;
}
/// The same of the grid.
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

/// What is left of the angular momentum after a turn, as a part of what there was, and the largest change on the way.
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
  EXPECT_GT(disk.sorts, 1) << method.name();  // particles have gone from block to block
  return spin;
}

// To round-off: asserted at 1e-12 a turn of some 730 steps, measured below 1e-13. Not with hat functions at a point:
// light nodes beside a particle make its second moment, and with it the angular momentum's share of the others, as
// small as it likes, and the disk flies apart; whether B or its gradient is kept.
TEST(AngularMomentum, IsKeptByApic) {
  for (const ShapeKind shape : kAllShapes) {
    if (shape == ShapeKind::dirac) continue;
    for (const UpdateScheme update : kAllUpdates) {
      const StepMethod method{shape, update, {TransferKind::apic, 1.0, 2}};
      EXPECT_LT(spin(method).change, 1e-12) << method.name();
    }
  }
}

// The sum over particles above is the grid's: D from the shape function drops out of it.
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
    // Of some 300 particles with 1 m/s a radius away.
    EXPECT_NEAR(grid_angular_momentum(disk), angular_momentum(disk), 1e-13 * disk.set().mass * 300 * kRadius)
        << shape_name(shape);
  }
}

// PIC smears velocities over a cell in every step: the rotation of a particle's surroundings is lost each time, and
// that of the whole before the turn ends (measured: 0.2 % left). FLIP keeps what the grid does not see; what the next
// step's weights see of it loses 3 to 5 % in the turn here, which no theory bounds: asserted twice as wide.
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

}  // namespace
}  // namespace mpm::test
