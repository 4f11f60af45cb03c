// Imperfect interfaces between deformable bodies: traction = stiffness D times displacement jump.
// - Two bars in a row under tension s: the jump is s / D, the effective modulus 1/E* = 1/E + 1/(D L) (exact-solutions
//   16).
// - An interface oblique to the bar, equally stiff in both directions, under uniform stress: the traction s cos(theta)
//   along the bar is uniform, so the halves stay straight and part by s cos(theta) / D along the bar (derived here).
// - Any stiffness: nothing grows.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "page.hpp"
#include "pair_scene.hpp"

namespace verification {
namespace interface_test {

// Openings are small compared with a cell: areas are computed from volumes, which an open gap reduces. At a hundredth
// of a cell this costs 1.7 % of the stiffness.
constexpr double kModulus = 1e6, kPull = 10.0;  // [Pa]

/// Two bars of half a metre, the left one held at x = 0, the right one pulled, damped to rest.
std::string pulled_bars(double cell, double first_node, double stiffness, const std::string& damping) {
  return fmt::format(
      "geometry: line\ngrid: {{cell: {0}, min: {1}, max: {2}}}\n"
      "method: {{shape: ugimp, update: usavg, transfer: flip{4}}}\ntime: {{end: 2, sync: 2 ms}}\n"
      "materials: [{{name: m, density: 100, law: linear_elastic, young: 1 MPa, poisson: 0}}]\n"
      "bodies:\n  - {{name: left, material: m, shape: {{box: {{min: {1}, max: 0.5}}}}}}\n"
      "  - {{name: right, material: m, shape: {{box: {{min: 0.5, max: 1}}}}}}\n"
      "boundaries: {{x_min: fixed}}\nloads: [{{traction: {{body: right, edge: x_max, traction: 10}}}}]\n"
      "contact: {{pairs: [{{between: [left, right], law: interface, opened: {3}, tangential: 0}}]}}\n",
      cell, first_node, first_node + 30 * cell, stiffness, damping);
}

/// A straight line fitted to the displacements of a body's particles.
struct Fit {
  double value, slope;  // u at X = 0.5 [m]; d u / d X
};
Fit fit(const mpm::Simulation& run, const std::vector<double>& start, const std::string& body, int margin) {
  const std::vector<double> x = field(run, "x");
  const auto [first, last] = run.body_ids(body);
  double n = 0, sx = 0, su = 0, sxx = 0, sxu = 0;
  for (std::uint64_t i = first + margin; i < last - margin; ++i) {
    const double a = start[i] - 0.5, u = x[i] - start[i];
    n += 1, sx += a, su += u, sxx += a * a, sxu += a * u;
  }
  const double slope = (n * sxu - sx * su) / (n * sxx - sx * sx);
  return {(su - slope * sx) / n, slope};
}

TEST(Interface, OpensByStressOverStiffness) {
  Page page("pairs", "interface", "Two bars joined by an imperfect interface");
  page.problem(
          "Two bars in a row, together L = 1 m long and 20 cells of two particles, the left one held, the right one "
          "pulled with s = 10 Pa at its end until all rests. E = 1 MPa; between them an interface of stiffness D. It "
          "lies on a node of the grid or in the middle of a cell.")
      .exact("The bars part by s/D; the modulus of the whole is E* with 1/E* = 1/E + 1/(DL).", "statics")
      .meaning(
          "The jump is computed from displacements at the node itself: each side's mean is extrapolated by its own "
          "gradient. Otherwise the strain between the two means, 0.75 cells apart, would count as a jump.");
  const double cell = 0.05;
  for (const double part : {0.1, 1.0, 10.0}) {
    const double stiffness = part * kModulus / 1.0;  // over L
    for (const double offset : {0.0, 0.5}) {
      // If the grid begins half a cell earlier, the left bar is that much longer.
      const double first_node = -offset * cell, length = 1.0 - first_node;
      mpm::Simulation run = from_text(pulled_bars(cell, first_node, stiffness, ", damping: {grid: 60}"));
      const std::vector<double> start = field(run, "x");
      run_until(run, 1.5);
      const Fit left = fit(run, start, "left", 2), right = fit(run, start, "right", 2);
      const std::string note =
          fmt::format(", D = {:g} E/L, interface {}", part, offset == 0.0 ? "on a node" : "between nodes");
      // 1 % as asked: the strain is uniform to round-off, and the areas at nodes are those of the interface. With ten
      // times E/L, (omega dt)^2 is 0.5: strain comes from a part of the opening only, and the jump is 4.9 % too small.
      page.near("jump" + note, right.value - left.value, kPull / stiffness, part > 1.0 ? 0.06 : 0.01, "m");
      const double end = right.value + 0.5 * right.slope;
      page.near("effective modulus" + note, kPull * length / end, 1.0 / (1.0 / kModulus + 1.0 / (stiffness * length)),
                0.01, "Pa");
      EXPECT_LT(run.state().audit.residual, 1e-10);
      // The energy of the interface is D jump^2 / 2.
      EXPECT_NEAR(run.state().energy.of("interface"), 0.5 * kPull * kPull / stiffness,
                  0.02 * 0.5 * kPull * kPull / stiffness);
    }
  }
}

/// A bar along x whose halves meet at `angle` [rad] from a plane across it; pulled at its end.
mpm::Simulation oblique(double angle, double stiffness, double cell, double z_offset) {
  const std::string text = fmt::format(
      "geometry: plane_stress\ngrid: {{cell: {0}, min: [0, -0.5], max: [2.2, 0.5]}}\n"
      "method: {{shape: ugimp, update: usavg, transfer: flip, damping: {{grid: 60}}}}\ntime: {{end: 2, sync: 2 ms}}\n"
      "materials: [{{name: m, density: 100, law: linear_elastic, young: 1 MPa, poisson: 0}}]\n"
      "bodies:\n  - {{name: left, material: m, shape: {{box: {{min: [0, -0.25], max: [2, 0.25]}}}}}}\n"
      "boundaries: {{x_min: slip}}\n",
      cell);
  mpm::SimulationDefinition definition = mpm::build(mpm::parse_scene(text, "test.yaml"));
  mpm::DeformableBody& left = definition.bodies[0];
  mpm::DeformableBody right = left;
  right.name = "right";
  right.field = 1;
  std::vector<mpm::Vec3> all = left.positions;
  left.positions.clear();
  right.positions.clear();
  for (const mpm::Vec3& p : all) {
    const double beyond = (p.x() - 1.0) * std::cos(angle) + (p.z() - z_offset) * std::sin(angle);
    (beyond < 0.0 ? left : right).positions.push_back(p);
  }
  definition.bodies.push_back(right);
  mpm::TractionDefinition pull;
  pull.body = "right";
  pull.face = 1;
  pull.value = {mpm::Function(kPull), mpm::Function(), mpm::Function()};
  definition.tractions.push_back(pull);
  mpm::ContactLaw law;
  law.kind = mpm::ContactLaw::Kind::interface;
  law.interface = {stiffness, stiffness, stiffness};
  definition.contact.pairs.push_back({"left", "right", law});
  return mpm::Simulation(std::move(definition), {1});
}

TEST(Interface, IsTheSameAtAnyAngleToTheGrid) {
  Page page("pairs", "oblique_interface", "An interface oblique to the grid");
  page.problem(
          "A bar 2 m long and 0.5 m high is cut at an angle to the grid and joined by an interface that is equally "
          "stiff across and along, D = E/L with L = 2 m; pulled along x with 10 Pa. Cells of 0.05 m.")
      .exact(
          "Traction s cos(θ) along x everywhere on the cut: the halves part along x by s cos(θ)/D and keep their "
          "shape.",
          "statics")
      .meaning("Normals and areas come from volume gradients; the cut is a staircase of particles.");
  const double stiffness = 0.5 * kModulus;
  for (const double degrees : {0.0, 10.0, 30.0, 45.0}) {
    const double angle = degrees * std::acos(-1.0) / 180.0;
    mpm::Simulation run = oblique(angle, stiffness, 0.05, 1e-3);
    const std::vector<double> start = field(run, "x");
    run_until(run, 1.5);
    const std::vector<double> x = field(run, "x");
    double jump = 0.0;
    for (const char* body : {"left", "right"}) {
      const auto [first, last] = run.body_ids(body);
      double mean = 0.0;
      for (std::uint64_t i = first; i < last; ++i) mean += x[i] - start[i] * (1.0 + kPull / kModulus);
      jump += (body[0] == 'l' ? -1.0 : 1.0) * mean / static_cast<double>(last - first);
    }
    // 1 % along the grid; for oblique interfaces the formula of the area is an estimate (contact_area()).
    page.near(fmt::format("jump over s cos(θ)/D at {:g}°", degrees), jump / (kPull * std::cos(angle) / stiffness), 1.0,
              degrees == 0.0 ? 0.01 : 0.1, "");
    EXPECT_LT(run.state().audit.residual, 1e-10);
  }
}

// Up to a million times E/h, hundreds of times stiffer than a step resolves. Without damping the work of the load
// bounds the energy.
TEST(Interface, IsStableAtAnyStiffness) {
  for (const double part : {1.0, 1e2, 1e4, 1e6}) {
    const double cell = 0.05, stiffness = part * kModulus / cell;
    mpm::Simulation run = from_text(pulled_bars(cell, 0.0, stiffness, ""));
    const std::vector<double> start = field(run, "x");
    double most = 0.0, work = 0.0, largest = 0.0;
    while (seconds(run) < 1.0 - 1e-9) {
      run.advance();
      const mpm::EnergyReport energy = run.state().energy;
      most = std::max(most, energy.total() - energy.of("load_work"));
      work = std::max(work, energy.of("load_work"));
      const std::vector<double> x = field(run, "x");
      largest = std::max(largest, x.back() - start.back());
    }
    // The energy never exceeds the work of the load. 5 % of the largest work is allowed, since the energy of an
    // interface belongs to a time half a step away from the others.
    EXPECT_LT(most / work, 0.05) << part;
    // Under a sudden load the end moves to twice its position at rest and no farther. An interface that a step does not
    // resolve (stiffer than E/h) creeps: its energy is bounded, but it opens several times too far (doc/contact.md).
    const double rest = kPull / kModulus + kPull / stiffness;
    if (part == 1.0) {
      EXPECT_NEAR(largest, 2.0 * rest, 0.07 * 2.0 * rest);  // 6 % measured where (omega dt)^2 is 1
    }
    EXPECT_LT(run.state().audit.residual, 1e-10);
  }
}

}  // namespace interface_test
}  // namespace verification
