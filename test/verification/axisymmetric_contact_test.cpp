// Smooth rigid tools pressed onto an elastic block about their axis: a flat round punch (Boussinesq's problem) and a
// sphere (Hertz's), and the same sphere in three dimensions.
//
// The block is a cylinder in a smooth wall, for which layer_contact.hpp is exact: neither the depth nor the wall are
// taken to be far away. As in flat_punch_test.cpp the punch goes a small part of a cell deep and its edge lies between
// two nodes; as in hertz_test.cpp cells are thin under the sphere, which goes down through six rows of nodes in five
// steps, and one offset of its depth is fitted to all steps but the first.
// Source: Johnson, Contact Mechanics (1985) 3.4, 3.8, 4.2, 5.8; Lebedev and Ufliand (1958).
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "layer_contact.hpp"
#include "page.hpp"
#include "scene_run.hpp"

namespace verification {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kThreads = 1;  // tests run side by side
// Asked of the force at eight cells a radius of the contact.
constexpr double kAsked = 0.03;

// --- flat punch: of the scene axisymmetric_punch ---
constexpr double kSide = 0.3;                     // height and radius of the block [m]
constexpr double kDepth = 2e-4;                   // [m]
constexpr double kRest = 0.14, kPunchEnd = 0.16;  // the ramp ends at 0.1 s; force is the mean between [s]

struct Punched {
  double cells = 0.0;  ///< to the radius
  double force = 0.0;  ///< [N]
  double told = 0.0;   ///< the radius whose exact force this is [cells]
  PressedTool exact;
  Numbers r, pressure;  ///< of the particles nearest the face, up to 1.5 radii
  double error() const { return force / exact.force - 1.0; }
};

/// A punch whose edge lies half a cell beyond the node number `count` / 3.
Punched punch(const std::string& shape, int count) {
  const ElasticBlock block{1e6, 0.3, kSide, kSide, true};
  const double cell = kSide / count, edge = count / 3 + 0.5, radius = edge * cell;
  Punched result;
  result.cells = edge;
  result.exact = LayerContact(block, ToolShape::circular, radius).flat_punch(kDepth);
  mpm::Simulation simulation =
      start("axisymmetric_punch",
            {fmt::format("grid.cell={}", cell), fmt::format("rigid_bodies.punch.shape.cylinder.radius={}", radius),
             "method.shape=" + shape},
            kThreads);
  run_until(simulation, kRest);
  simulation.take_contact(0);
  run_until(simulation, kPunchEnd);
  result.force = simulation.take_contact(0).mean.force.z();
  // Between radii half a cell apart the exact force is a power of the radius.
  const double smaller = LayerContact(block, ToolShape::circular, radius - 0.5 * cell).flat_punch(kDepth).force;
  const double power = std::log(result.exact.force / smaller) / std::log(radius / (radius - 0.5 * cell));
  result.told = edge * std::pow(result.force / result.exact.force, 1.0 / power);
  const Numbers x = field(simulation, "x"), z = field(simulation, "z"), szz = field(simulation, "szz");
  for (std::size_t p = 0; p < x.size(); ++p) {
    if (z[p] < kSide - 0.5 * cell || x[p] > 1.5 * radius) continue;
    result.r.push_back(x[p] / radius);
    result.pressure.push_back(-szz[p]);
  }
  return result;
}

TEST(AxisymmetricContact, FlatPunch) {
  Page page("axisymmetric", "axisymmetric_punch", "Flat round punch about its axis");
  page.problem(
          "A smooth rigid round punch is pressed 0.2 mm into an elastic block (E = 1 MPa, nu = 0.3, 0.3 m high, 0.3 m "
          "in "
          "radius, in a smooth wall) on a smooth base, slowly, and held. The edge lies midway between two nodes.")
      .exact(
          "F / delta of the block itself: a pressure J0(kr) presses the face down by 2 K(kH) / (E* k) of itself, K(u) "
          "= "
          "2 sinh^2 u / (2 u + sinh 2u), with k at the zeros of J1(kL); the half space has F = 2 E* a delta.",
          "Boussinesq; Lebedev and Ufliand (1958); Johnson, Contact Mechanics (1985) 3.8")
      .scene("axisymmetric_punch");
  Numbers cells, errors, cpdi;
  std::vector<Punched> runs;
  for (const int count : {12, 24, 48}) {
    runs.push_back(punch("ugimp", count));
    const Punched& run = runs.back();
    const std::string at = fmt::format(" at {} cells a radius", run.cells);
    page.beside("force" + at, run.force, run.exact.force, "N");
    page.report("its error" + at, 100.0 * run.error(), "%");
    // A node is in contact or not, so the punch's edge is known to half a cell to either side.
    page.near_absolute("radius whose exact force this is," + at, run.told, run.cells, 0.5, "cells");
    cells.push_back(1.0 / run.cells);
    errors.push_back(std::abs(run.error()));
  }
  const double half_space =
      LayerContact({1e6, 0.3}, ToolShape::circular, runs[1].exact.radius).flat_punch(kDepth).force;
  page.report("exact stiffness over that of the half space, at 8.5 cells", runs[1].exact.force / half_space, "");
  const double mean = runs[2].exact.force / (kPi * runs[2].exact.radius * runs[2].exact.radius);
  Numbers r, exact, measured;
  for (int i = 0; i <= 95; ++i) {
    r.push_back(0.01 * i);
    exact.push_back(runs[2].exact.pressure(0.01 * i * runs[2].exact.radius) / mean);
  }
  for (const double p : runs[2].pressure) measured.push_back(p / mean);
  page.figure()
      .panel("Pressure under the punch, 16.5 cells a radius", "r / a", "pressure / mean pressure")
      .exact("exact, on the face", r, exact)
      .points("particles a quarter of a cell below", runs[2].r, measured);
  page.figure()
      .panel("Error of the force", "cell / radius", "relative error")
      .log_x()
      .log_y()
      .order(1.0)
      .points("force", cells, errors);
  page.meaning("MEANING");
}

// --- sphere: of the scenes axisymmetric_hertz and hertz_sphere ---
constexpr double kToolRadius = 0.5;                // [m]
constexpr double kCell = 0.0125, kRow = 0.003125;  // width and height of a cell [m]
constexpr double kStep = 0.04, kMeasure = 0.0075;  // of motion and rest; at the end of each rest [s]
constexpr int kSteps = 5;
const ElasticBlock kRound{1e6, 0.3, 0.2, 0.225, true}, kSquare{1e6, 0.3, 0.2, 0.2};

/// Depth, radius and force of the exact solution as a table.
struct Curve {
  Numbers radius, approach, force;
  explicit Curve(const ElasticBlock& block) {
    for (double a = 0.02; a < 0.1301; a += 0.005) {
      const PressedTool tool = LayerContact(block, ToolShape::circular, a).paraboloid(kToolRadius);
      radius.push_back(a);
      approach.push_back(tool.approach);
      force.push_back(tool.force);
    }
  }
  /// A power law between two entries: within 1e-3 of the curve.
  static double at(const Numbers& xs, const Numbers& ys, double x) {
    const auto above = std::clamp<std::ptrdiff_t>(std::upper_bound(xs.begin(), xs.end(), x) - xs.begin(), 1,
                                                  static_cast<std::ptrdiff_t>(xs.size()) - 1);
    const double x0 = xs[above - 1], x1 = xs[above], y0 = ys[above - 1], y1 = ys[above];
    return y0 * std::pow(y1 / y0, std::log(x / x0) / std::log(x1 / x0));
  }
  double force_at(double depth) const { return at(approach, force, depth); }
  double radius_at(double depth) const { return at(approach, radius, depth); }
};

/// At the end of each rest; of the whole tool.
struct Pressed {
  Numbers depth, force;  ///< [m], [N]
  double particle_steps = 0.0, seconds = 0.0, particles = 0.0;
};

/// `refine`: cells are this many times smaller.
Pressed press(const std::string& scene, double refine, const std::string& shape = "ugimp") {
  const bool solid = scene == "hertz_sphere";
  const std::string cell = solid ? fmt::format("[{0}, {0}, {1}]", kCell / refine, kRow / refine)
                                 : fmt::format("[{}, {}]", kCell / refine, kRow / refine);
  mpm::Simulation simulation = start(scene, {"grid.cell=" + cell, "method.shape=" + shape}, kThreads);
  const double height = simulation.rigid_body(0).pose().position.z();
  Pressed result;
  for (int step = 1; step <= kSteps; ++step) {
    run_until(simulation, step * kStep - kMeasure);
    simulation.take_contact(0);
    run_until(simulation, step * kStep);
    result.depth.push_back(height - simulation.rigid_body(0).pose().position.z());
    result.force.push_back(simulation.take_contact(0).mean.force.z() * (solid ? 4.0 : 1.0));
  }
  const mpm::SolverState state = simulation.state();
  result.particles = static_cast<double>(state.particles);
  result.particle_steps = result.particles * static_cast<double>(state.step.steps);
  result.seconds = state.wall_seconds;
  return result;
}

/// The offset in [0, 1.25 rows] with the least squares of the relative errors, all steps but the first [m].
double fit_offset(const Curve& curve, const Pressed& run, double row) {
  double best = 0.0, least = 1e300;
  for (double offset = 0.0; offset <= 1.25 * row; offset += 0.001 * row) {
    double squares = 0.0;
    for (int i = 1; i < kSteps; ++i) {
      squares += std::pow(run.force[i] / curve.force_at(run.depth[i] - offset) - 1.0, 2);
    }
    if (squares < least) {
      least = squares;
      best = offset;
    }
  }
  return best;
}

TEST(Probe, Hertz) {
  const Curve curve(kRound);
  for (const char* shape : {"ugimp", "cpdi"}) {
    for (const double refine : {0.5, 1.0, 2.0}) {
      const Pressed run = press("axisymmetric_hertz", refine, shape);
      const double offset = fit_offset(curve, run, kRow / refine);
      fmt::print("{} {} offset {:.3f} rows, {} s:", shape, refine, offset / kRow * refine, run.seconds);
      for (int i = 0; i < kSteps; ++i) {
        fmt::print(" [{:.1f} cells {:+.4f} {:+.4f}]", curve.radius_at(run.depth[i]) / kCell * refine,
                   run.force[i] / curve.force_at(run.depth[i]) - 1.0,
                   run.force[i] / curve.force_at(std::max(1e-5, run.depth[i] - offset)) - 1.0);
      }
      fmt::print("\n");
    }
  }
}

}  // namespace
}  // namespace verification
