// A smooth rigid sphere pressed onto an elastic block about its axis (Hertz's problem in a finite block), and the same
// sphere in three dimensions.
//
// The block is a cylinder in a smooth wall, for which layer_contact.hpp is exact: base and wall need not be far away.
// As in hertz_test.cpp cells are thin (a quarter of their width), the sphere goes down through six rows of nodes in
// five steps, each followed by rest, and one offset of its depth is fitted to all steps but the first. Source: Johnson,
// Contact Mechanics (1985) 3.4, 4.2, 5.8; Lebedev and Ufliand (1958).
#include <fmt/core.h>

#include <cmath>
#include <string>
#include <vector>

#include "hertz_curve.hpp"
#include "mpm/advice/memory.hpp"
#include "page.hpp"
#include "scene_run.hpp"

namespace verification {
namespace axisymmetric_hertz_test {

constexpr int kThreads = 1;  // tests run side by side
// Numbers of the scenes axisymmetric_hertz and hertz_sphere.
constexpr double kToolRadius = 0.5;                // [m]
constexpr double kCell = 0.0125, kRow = 0.003125;  // width and height of a cell [m]
constexpr double kStep = 0.04, kMeasure = 0.0075;  // motion and rest; the mean at its end [s]
constexpr int kSteps = 5;
const ElasticBlock kRound{1e6, 0.3, 0.2, 0.225, true}, kSquare{1e6, 0.3, 0.2, 0.2};
constexpr double kAsked = 0.03;     // relative tolerance of the force with eight cells to a radius of the contact
constexpr double kCells = 3.5;      // cells to a radius of the contact, from which on kTogether is checked
constexpr double kTogether = 0.05;  // relative tolerance against the force in three dimensions

/// Depth of the tool, and force on the whole tool, at the end of each rest.
struct Pressed {
  Numbers depth, force;  ///< [m], [N]
  Numbers r, pressure;   ///< at particles 2.5 to 3.5 rows below the sphere, at the end [m], [Pa]
  double particles = 0.0, particle_steps = 0.0, seconds = 0.0, bytes = 0.0;
};

/// Runs the scene with cells that are `refine` times smaller.
Pressed press(bool solid, double refine) {
  const std::string wide = fmt::format("{}", kCell / refine), high = fmt::format("{}", kRow / refine);
  const std::string cell = "grid.cell=[" + wide + ", " + (solid ? wide + ", " : "") + high + "]";
  mpm::Simulation simulation = start(solid ? "hertz_sphere" : "axisymmetric_hertz", {cell}, kThreads);
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
  const mpm::SimulationDefinition& definition = simulation.definition();
  result.bytes = result.particles * mpm::least_bytes_of_particle(definition.method, definition.geometry);
  result.particle_steps = result.particles * static_cast<double>(state.step.steps);
  result.seconds = state.wall_seconds;
  // Rows at the sphere's nodes keep the stress that they had when contact began, so the pressure is read below them.
  const double middle = simulation.rigid_body(0).pose().position.z(), row = kRow / refine;
  const Numbers x = field(simulation, "x"), z = field(simulation, "z"), szz = field(simulation, "szz");
  for (std::size_t p = 0; p < x.size() && !solid; ++p) {
    const double below = middle - std::sqrt(kToolRadius * kToolRadius - x[p] * x[p]) - z[p];
    if (below < 2.5 * row || below > 3.5 * row || x[p] > 0.15) continue;
    result.r.push_back(x[p]);
    result.pressure.push_back(-szz[p]);
  }
  return result;
}

TEST(AxisymmetricHertz, Sphere) {
  Page page("axisymmetric", "axisymmetric_hertz", "Sphere on a block about its axis");
  page.problem(
          "A smooth rigid sphere of radius 0.5 m is pressed 20 mm into an elastic block (E = 1 MPa, nu = 0.3, 0.2 m "
          "high, 0.225 m in radius, in a smooth wall) on a smooth base, in five steps with rests. Cells 12.5 mm wide "
          "and 3.125 mm high.")
      .exact(
          "Force and depth of the block itself for each contact radius: a pressure J0(kr) deflects the face by 2 "
          "K(kH) / (E* k) times itself, with k at the zeros of J1(kL); the half space has F = 4 E* a^3 / (3 R), "
          "delta = a^2 / R. The sphere is taken as a paraboloid; at the edge of the contact that is 1 % of the "
          "profile.",
          "Hertz; Lebedev and Ufliand (1958); Johnson, Contact Mechanics (1985) 3.4, 4.2, 5.8")
      .scene("axisymmetric_hertz");
  const HertzCurve curve(kRound, ToolShape::circular, kToolRadius, 0.02, 0.13);
  const Pressed run = press(false, 1.0);
  const double offset = fit_offset(curve, run.depth, run.force, kRow);
  page.report("offset of the depth, fitted", offset / kRow, "rows");
  for (int i = 1; i < kSteps; ++i) {
    const double exact = curve.force_at_depth(run.depth[i] - offset);
    const double across = curve.radius_at_force(exact) / kCell;
    const std::string name =
        fmt::format("force at a depth of {:.0f} mm, {:.1f} cells a contact radius", 1e3 * run.depth[i], across);
    if (across >= 7.5) {
      page.near(name, run.force[i], exact, kAsked, "N");
      page.report("its error without an offset", 100.0 * (run.force[i] / curve.force_at_depth(run.depth[i]) - 1.0),
                  "%");
    } else {
      page.beside(name, run.force[i], exact, "N");
    }
  }
  const double last = curve.radius_at_force(run.force.back());
  const HertzCurve half_space({1e6, 0.3}, ToolShape::circular, kToolRadius, 0.05, 0.15);
  page.report("exact force at 20 mm over that on the half space",
              curve.force_at_depth(0.02) / half_space.force_at_depth(0.02), "");
  Numbers depth, exact, millimetres, r, pressure;
  for (double d = 0.001; d < 0.0221; d += 0.0005) {
    if (d < curve.approach.front()) continue;
    depth.push_back(1e3 * d);
    exact.push_back(curve.force_at_depth(d));
  }
  for (const double d : run.depth) millimetres.push_back(1e3 * d);
  page.figure()
      .panel("Force", "depth [mm]", "force [N]")
      .exact("exact", depth, exact)
      .points("measured", millimetres, run.force);
  const PressedTool tool = LayerContact(kRound, ToolShape::circular, last).paraboloid(kToolRadius);
  for (int i = 0; i <= 60; ++i) {
    r.push_back(last * i / 60.0);
    pressure.push_back(i == 60 ? 0.0 : tool.pressure(r.back()));
  }
  double near = 0.0, count = 0.0;
  for (std::size_t p = 0; p < run.r.size(); ++p) {
    if (run.r[p] < 0.25 * last) near += run.pressure[p], count += 1.0;
  }
  page.beside("pressure within a quarter of the contact radius, 2.5 to 3.5 rows below the sphere", 1e-3 * near / count,
              1e-3 * tool.pressure(0.0), "kPa");
  page.figure()
      .panel("Pressure at 20 mm", "r [m]", "pressure [Pa]")
      .exact("exact, of the measured force", r, pressure)
      .points("particles 2.5 to 3.5 rows below the sphere", run.r, run.pressure);
  page.meaning(
      "Force against depth holds to 3 % at 8 cells, and to 4 % without the offset, which is a twentieth of a row. "
      "With half as many cells to the radius the force is within 7 %, with twice as many within 2 %. The contact is "
      "1.8 times as stiff as on a half space: a base two contact radii away matters. Particles between nodes in "
      "contact with the sphere keep the stress that they had when contact began, here 2.6 times the pressure: read "
      "the pressure a few rows below.");
}

/// Compares the axisymmetric run with the one in three dimensions; `refine` as in press().
void beside_solid(double refine) {
  Page page("axisymmetric", "axisymmetric_hertz_cost", "The same sphere in three dimensions");
  page
      .problem(fmt::format(
          "The sphere of the page before, and a quarter of it in three dimensions on a square block of the same "
          "area between smooth walls, cells {:.4g} mm wide and {:.4g} mm high, one thread each.",
          1e3 * kCell / refine, 1e3 * kRow / refine))
      .exact("the two blocks differ in the shape of their walls; the exact forces at the same depth are given below.",
             "layer_contact.hpp")
      .scene("hertz_sphere");
  const HertzCurve round(kRound, ToolShape::circular, kToolRadius, 0.02, 0.13);
  const Pressed ring = press(false, refine), solid = press(true, refine);
  for (int i = 1; i < kSteps; ++i) {
    const std::string name =
        fmt::format("force about the axis at {:.0f} mm, beside that in three dimensions", 1e3 * ring.depth[i]);
    // With fewer cells the edge of the contact, known to a cell on either side, matters too much.
    if (round.radius_at_depth(ring.depth[i]) >= kCells * kCell / refine) {
      page.near(name, ring.force[i], solid.force[i], kTogether, "N");
    } else {
      page.beside(name, ring.force[i], solid.force[i], "N");
    }
  }
  const PressedTool square = LayerContact(kSquare, ToolShape::circular, 0.11).paraboloid(kToolRadius);
  page.report("exact force on the round block over that on the square one",
              round.force_at_depth(square.approach) / square.force, "");
  page.report("particles about the axis", ring.particles, "");
  page.report("particles of the quarter", solid.particles, "");
  page.report("particle-steps of the quarter over those about the axis", solid.particle_steps / ring.particle_steps,
              "");
  page.report("seconds of the quarter over those about the axis", solid.seconds / ring.seconds, "");
  page.report("memory of the particles about the axis, at least", 1e-6 * ring.bytes, "MB");
  page.report("memory of the particles of the quarter, at least", 1e-6 * solid.bytes, "MB");
  Numbers depth;
  for (const double d : ring.depth) depth.push_back(1e3 * d);
  page.figure()
      .panel("Force", "depth [mm]", "force [N]")
      .points("about the axis", depth, ring.force)
      .points("a quarter in three dimensions", depth, solid.force);
  page.meaning(
      "Axisymmetric problems need no third coordinate: the forces agree within 5 %, for a small part of the "
      "particles and of the time. Seconds depend on other work of the machine; particle-steps do not.");
}

TEST(FullAxisymmetricHertz, ShippedScene) {
  Page page("axisymmetric", "sphere_indentation", "Sphere on a block, as shipped");
  page.problem(
          "The scene sphere_indentation: a sphere of 40 mm, 1.42 mm deep, in a block of 32 mm; no offset is fitted.")
      .exact("as on the page before, for a block of this size.", "Lebedev and Ufliand (1958); layer_contact.hpp")
      .scene("sphere_indentation");
  mpm::Simulation simulation = start("sphere_indentation", {}, kThreads);
  run_until(simulation, 0.024);  // it rests from 0.02 s on
  simulation.take_contact(0);
  run_until(simulation, 0.026);
  const HertzCurve curve({1e6, 0.3, 0.032, 0.032, true}, ToolShape::circular, 0.04, 0.006, 0.01);
  const double depth = 0.072 - simulation.rigid_body(0).pose().position.z();
  page.near("force", simulation.take_contact(0).mean.force.z(), curve.force_at_depth(depth), kAsked, "N");
  page.report("contact radius", curve.radius_at_depth(depth) / 1e-3, "cells");
  page.meaning("What the scene's first lines promise.");
}

TEST(AxisymmetricHertz, AgreesWithAQuarterInThreeDimensions) { beside_solid(0.5); }
TEST(FullAxisymmetricHertz, AgreesWithAQuarterInThreeDimensions) { beside_solid(1.0); }

}  // namespace axisymmetric_hertz_test
}  // namespace verification
