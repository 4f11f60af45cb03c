// Contact between two deformable bodies: Coulomb's law on a slope (exact-solutions 14), and the two rules of detection
// that have exact answers, the least volume at a node and displacements since the start.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "mpm/math/constants.hpp"
#include "pair_scene.hpp"

namespace verification {
namespace pair_laws_test {

constexpr double kGravity = 10.0;  // [m/s^2]
using mpm::kPi;

constexpr double kAngle = kPi / 6.0, kFrom = 0.1, kUntil = 0.6;  // angle of the slope; interval of the means [s]

/// A block on a bed of the same material whose underside is fixed, with gravity at kAngle to the bed's normal.
std::string on_a_slope(double cell, const std::string& normals, const std::string& law) {
  return fmt::format(
      "geometry: plane_strain\ngrid: {{cell: {}, min: [0, 0], max: [2, 0.8]}}\n"
      "method: {{shape: ugimp, update: usavg, transfer: flip}}\ntime: {{end: 1, sync: 10 ms}}\n"
      "gravity: [{}, {}]\nmaterials: [{{name: m, density: 1000, law: neo_hookean, young: 10 MPa, poisson: 0.3}}]\n"
      "bodies:\n  - {{name: bed, material: m, shape: {{box: {{min: [0, 0], max: [2, 0.2]}}}}}}\n"
      "  - {{name: block, material: m, shape: {{box: {{min: [0.3, 0.2], max: [0.7, 0.4]}}}}}}\n"
      "boundaries: {{z_min: fixed, x_min: slip, x_max: slip}}\n"
      "contact: {{normals: {}, pairs: [{{between: [bed, block], {}}}]}}\n"
      "metrics: {{acceleration: {{mean: vx, of: block, rate: {{from: {}, to: {}}}}}}}\n",
      cell, kGravity * std::sin(kAngle), -kGravity * std::cos(kAngle), normals, law, kFrom, kUntil);
}

struct Slide {
  double acceleration = 0.0;            ///< acceleration of the block, by least squares [m/s^2]
  mpm::Vec3 force = mpm::Vec3::Zero();  ///< mean force on the block [N]
};
Slide slide(const std::string& text) {
  mpm::Simulation run = from_text(text);
  run_until(run, kFrom);
  const mpm::Vec3 impulse = run.take_pairs().at(0).impulse;
  run_until(run, kUntil);
  EXPECT_LT(run.state().audit.residual, 1e-10);
  return {run.metrics().at(0).second, (run.take_pairs().at(0).impulse - impulse) / (kUntil - kFrom)};
}

// With mu < tan 30 degrees the block slides with g (sin - mu cos). With a larger mu it sticks, and the surfaces carry
// g sin. Asked: 1 % of g sin and of the weight, the best that the reference expects. Normals are those of the side with
// more volume, which is the flat bed at the block's edges; the next test has other normals. 5 s.
TEST(PairLaws, ABlockOnABedSlidesOrSticks) {
  constexpr double kWeight = 1000.0 * 0.4 * 0.2 * kGravity;  // [N]
  struct Case {
    const char* law;
    double friction;
  };
  for (const Case& one :
       {Case{"friction: 0", 0.0}, Case{"friction: 0.3", 0.3}, Case{"friction: 0.6", 0.6}, Case{"law: stick", 9.0}}) {
    const Slide found = slide(on_a_slope(0.05, "larger_volume", one.law));
    const double along = std::min(one.friction * std::cos(kAngle), std::sin(kAngle));  // force over the weight
    EXPECT_NEAR(found.acceleration, kGravity * (std::sin(kAngle) - along), 0.01 * kGravity * std::sin(kAngle))
        << one.law;
    EXPECT_NEAR(-found.force.x(), kWeight * along, 0.01 * kWeight) << one.law;
    EXPECT_NEAR(found.force.z(), kWeight * std::cos(kAngle), 0.01 * kWeight) << one.law;
  }
}

// The mean of both sides' normals, the default, leans at the block's edges, where the block's gradient points outwards:
// the front edge ploughs. The error is of first order in the cell, since the nodes of an edge are a fraction cell /
// length of the surface.
TEST(PairLaws, MeanNormalsPloughAtTheEdges) {
  for (const double cell : {0.05, 0.025}) {
    const double exact = kGravity * (std::sin(kAngle) - 0.3 * std::cos(kAngle));
    EXPECT_NEAR(slide(on_a_slope(cell, "average", "friction: 0.3")).acceleration, exact,
                0.2 * cell / 0.4 * kGravity * std::sin(kAngle))
        << cell;
  }
}

/// Two bars that come together about the node at x = 1 with 1 m/s each, `gap` apart [m].
constexpr double kCell = 0.02, kSpeed = 1.0, kSync = 1e-5;  // [m], [m/s], [s]
std::string closing(double gap, const std::string& contact) {
  return fmt::format(
      "geometry: line\ngrid: {{cell: {}, min: 0, max: 2}}\nmethod: {{shape: ugimp, update: usavg, transfer: flip}}\n"
      "time: {{end: 1, sync: {}}}\n"
      "materials: [{{name: m, density: 100, law: linear_elastic, young: 1 MPa, poisson: 0}}]\nbodies:\n"
      "  - {{name: left, material: m, shape: {{box: {{min: {}, max: {}}}}}, initial: {{velocity: {}}}}}\n"
      "  - {{name: right, material: m, shape: {{box: {{min: {}, max: {}}}}}, initial: {{velocity: {}}}}}\n"
      "contact: {{detection: approach, pairs: [{{between: [left, right], friction: 0}}], {}}}\n",
      kCell, kSync, 0.5 - 0.5 * gap, 1.0 - 0.5 * gap, kSpeed, 1.0 + 0.5 * gap, 1.5 + 0.5 * gap, -kSpeed, contact);
}

/// Time at which two bodies first press on each other, or `latest` if they do not until then [s].
double first_touch(mpm::Simulation& run, double latest) {
  while (seconds(run) < latest) {
    run.advance();
    if (run.take_pairs().at(0).pressing > 0.0) return seconds(run);
  }
  return latest;
}

// Manual, Vmin: a node where all materials together have less than this fraction of a cell's undeformed volume is not
// in contact. Boxes of uGIMP spread their volume like a continuum weighted with the hat function. With a gap g about
// the node its volume is therefore (1 - g / 2h)^2 of a cell's, and bodies meet at g = 2 h (1 - sqrt(Vmin)). Only one
// body reaches each of the other nodes, so they have no contact. Nothing deforms before.
TEST(PairLaws, TheLeastVolumeSaysAtWhichGapTheyMeet) {
  constexpr double kGap = 3.0 * kCell;
  for (const double least : {0.0, 0.25, 0.5, 0.9}) {
    mpm::Simulation run = from_text(closing(kGap, fmt::format("minimum_volume: {}", least)));
    const double meets = (kGap - 2.0 * kCell * (1.0 - std::sqrt(least))) / (2.0 * kSpeed);
    // It is found at the first sync point after the contact, and the step of the contact may begin earlier.
    EXPECT_NEAR(first_touch(run, 0.05) / meets, 1.0, 3.0 * kSync / meets) << least;
  }
}

// Manual, Dcheck with displacements: of two bodies that touch at the start one leaves with v and returns under an
// acceleration a. They touch again when it is back, at 2 v / a, although they approach from v / a on and share nodes
// all the time (the gap never exceeds half a cell). The motion is rigid, so mean displacements at nodes are exact.
TEST(PairLaws, DisplacementsSayWhenItIsBack) {
  constexpr double kLeaves = 0.5, kBack = 2.0 * kLeaves / 0.04;  // [m/s], [m/s^2]: back after 40 ms, 5 mm away
  const auto scene = [&](const char* detection) {
    return fmt::format(
        "geometry: line\ngrid: {{cell: {}, min: 0, max: 2}}\nmethod: {{shape: ugimp, update: usavg, transfer: flip}}\n"
        "time: {{end: 1, sync: {}}}\n"
        "materials: [{{name: m, density: 100, law: linear_elastic, young: 1 MPa, poisson: 0}}]\nbodies:\n"
        "  - {{name: left, material: m, shape: {{box: {{min: 0.5, max: 1}}}}}}\n"
        "  - {{name: right, material: m, shape: {{box: {{min: 1, max: 1.5}}}}, initial: {{velocity: {}}}}}\n"
        "loads: [{{body_force: {{acceleration: {}, body: right}}}}]\n"
        "contact: {{detection: {}, pairs: [{{between: [left, right], friction: 0}}]}}\n",
        kCell, kSync, kLeaves, -kBack, detection);
  };
  mpm::Simulation displaced = from_text(scene("displacements")), approaching = from_text(scene("approach"));
  EXPECT_NEAR(first_touch(displaced, 0.1), 2.0 * kLeaves / kBack, 3.0 * kSync);
  EXPECT_NEAR(first_touch(approaching, 0.1), kLeaves / kBack, 3.0 * kSync);
}

}  // namespace pair_laws_test
}  // namespace verification
