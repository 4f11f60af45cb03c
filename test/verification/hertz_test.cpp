// A smooth rigid sphere, and a cylinder in plane strain, pressed into an elastic block between smooth walls (Hertz's
// problem in a finite block).
//
// The exact solution is that of layer_contact.hpp for the block of the scene. A node is in contact when it lies in the
// tool, so the force of a curved tool is right only once the tool has passed some rows of nodes. Therefore cells are
// thin (a quarter of their width), and the tool goes down through six rows, in steps that are each followed by rest.
//
// One offset of the depth, between zero and 1.25 rows, is fitted to all steps but the first. The contact radius, which
// has no offset, is computed from the centre of pressure that contact reports for the computed part of the tool: under
// p = p0 sqrt(1 - r^2/a^2) it lies at 4 a / (3 pi) for half a strip, and at 3 a / 8 along x for a quarter of a circle.
// Source: Johnson, Contact Mechanics (1985) 3.4, 4.2, 5.8; the sums over walls: layer_contact.hpp.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "hertz_curve.hpp"
#include "mpm/math/constants.hpp"
#include "page.hpp"
#include "scene_run.hpp"

namespace verification {
namespace hertz_test {

using mpm::kPi;
constexpr int kThreads = 1;  // tests run side by side
// Numbers of the scenes.
constexpr double kSide = 0.2;        // height of the block and distance from its middle to the walls [m]
constexpr double kToolRadius = 0.5;  // [m]
constexpr double kCell = 0.0125;     // along x and y [m]
constexpr double kRow = 0.003125;    // height of a cell [m]
constexpr double kStep = 0.04;       // 0.02 s of motion and as long at rest [s]
constexpr double kMeasure = 0.0075;  // duration of the mean at the end of each rest [s]
constexpr int kSteps = 5;
const ElasticBlock kBlock{1e6, 0.3, kSide, kSide};
constexpr double kAsked = 0.05;  // relative tolerance of the force with eight cells to a contact radius

/// Depth of the tool, force on the whole tool and contact radius at the end of each rest.
struct Pressed {
  Numbers depth, force, radius;  // [m], [N] or [N/m], from the centre of pressure [m]
};

Pressed press(ToolShape shape) {
  const bool strip = shape == ToolShape::strip;
  mpm::Simulation simulation = start(strip ? "hertz_cylinder" : "hertz_sphere", {}, kThreads);
  const double height = simulation.rigid_body(0).pose().position.z();
  Pressed result;
  for (int step = 1; step <= kSteps; ++step) {
    run_until(simulation, step * kStep - kMeasure);
    simulation.take_contact(0);
    run_until(simulation, step * kStep);
    const mpm::ContactReport report = simulation.take_contact(0);
    result.depth.push_back(height - simulation.rigid_body(0).pose().position.z());
    result.force.push_back(report.mean.force.z() * (strip ? 2.0 : 4.0));
    result.radius.push_back(report.arm.x() * (strip ? 0.75 * kPi : 8.0 / 3.0));
  }
  return result;
}

/// Runs the problem and fills the rows and figures of a page.
void compare(Page& page, ToolShape shape, const std::string& unit) {
  const HertzCurve curve(kBlock, shape, kToolRadius, 0.02, 0.13);
  const Pressed run = press(shape);
  const double offset = fit_offset(curve, run.depth, run.force, kRow);
  page.report("offset of the depth, fitted", offset / kRow, "rows");
  Numbers by_radius, cells;
  for (int i = 1; i < kSteps; ++i) {
    const double exact = curve.force_at_depth(run.depth[i] - offset);
    const double across = curve.radius_at_force(exact) / kCell;
    const std::string name =
        fmt::format("force at a depth of {:.0f} mm, {:.1f} cells a contact radius", 1e3 * run.depth[i], across);
    // The force is checked with eight cells; with fewer cells, and fewer rows passed, it is only shown.
    if (across >= 7.5) {
      page.near(name, run.force[i], exact, kAsked, unit);
    } else {
      page.beside(name, run.force[i], exact, unit);
    }
  }
  for (int i = 0; i < kSteps; ++i) {
    by_radius.push_back(run.force[i] / curve.force_at_radius(run.radius[i]));
    cells.push_back(curve.radius_at_force(run.force[i]) / kCell);
  }
  for (const int i : {kSteps - 2, kSteps - 1}) {
    page.beside(fmt::format("contact radius from the centre of pressure at a depth of {:.0f} mm", 1e3 * run.depth[i]),
                1e3 * run.radius[i], 1e3 * curve.radius_at_force(run.force[i]), "mm");
  }
  page.report(fmt::format("force over the exact force at that radius, {:.1f} cells", cells[kSteps - 2]),
              by_radius[kSteps - 2], "");
  page.near(fmt::format("force over the exact force at that radius, {:.1f} cells", cells[kSteps - 1]),
            by_radius[kSteps - 1], 1.0, kAsked, "");
  // The radius converges from above as the tool passes rows of nodes: it is never too small, and less and less too
  // large.
  for (int i = 0; i < kSteps; ++i) {
    EXPECT_LT(by_radius[i], 1.0 + kAsked);
    if (i > 0) {
      EXPECT_GT(by_radius[i], by_radius[i - 1]);
    }
  }

  Numbers depth, exact, shifted;
  for (double d = 0.001; d < 0.0221; d += 0.0005) {
    if (d < curve.approach.front()) continue;
    depth.push_back(1e3 * d);
    exact.push_back(curve.force_at_depth(d));
    if (d - offset > 0.0) shifted.push_back(curve.force_at_depth(std::max(d - offset, 1e-6)));
  }
  Numbers millimetres;
  for (const double d : run.depth) millimetres.push_back(1e3 * d);
  page.figure()
      .panel("Force", "depth [mm]", "force [" + unit + "]")
      .exact("exact", depth, exact)
      .line(fmt::format("exact, {:.2f} rows later", offset / kRow), depth, shifted)
      .points("measured", millimetres, run.force);
  page.figure()
      .panel("Force against contact radius", "cells to the contact radius", "force / exact force at this radius")
      .exact("exact", {cells.front(), cells.back()}, {1.0, 1.0})
      .points("radius from the centre of pressure", cells, by_radius);
}

TEST(Hertz, Cylinder) {
  Page page("contact", "hertz_cylinder", "Cylinder on a block, plane strain");
  page.problem(
          "A smooth rigid cylinder of radius 0.5 m is pressed 20 mm into an elastic block (E = 1 MPa, nu = 0.3, 0.2 m "
          "high, 0.4 m wide between smooth walls) on a smooth base, in five steps with rests. Cells 12.5 mm wide and "
          "3.125 mm high; half is computed.")
      .exact(
          "Force and depth of the block itself for each contact width, from the sum over its walls "
          "(layer_contact.hpp). "
          "The cylinder is taken as a parabola; at the edge of the contact that is 1 % of the profile.",
          "Johnson, Contact Mechanics (1985) 4.2, 5.8")
      .scene("hertz_cylinder");
  compare(page, ToolShape::strip, "N/m");
  page.meaning(
      "Force against depth follows the exact curve to a tenth of a row. The pressure extends too far while the tool "
      "has passed few rows, because a node just inside the tool acts on material that has not yet reached its "
      "surface: for its own contact radius the force is 7 % low at 8 cells, when five rows are passed, and within 5 "
      "% from nine cells and six rows on. With cells as high as wide, of which a tool of 1 m radius passes less than "
      "one, contact was found 1.3 to 1.4 times too wide.");
}

TEST(FullHertz, Sphere) {
  Page page("contact", "hertz_sphere", "Sphere on a block");
  page.problem(
          "A smooth rigid sphere of radius 0.5 m is pressed 20 mm into an elastic block (E = 1 MPa, nu = 0.3, 0.2 m "
          "high, 0.4 m x 0.4 m between smooth walls) on a smooth base, in five steps with rests. Cells 12.5 mm wide "
          "and "
          "3.125 mm high; a quarter is computed, 131,072 particles.")
      .exact(
          "Force and depth of the block itself for each contact radius, from the lattice sum over its walls "
          "(layer_contact.hpp); the half space has F = 4 E* a^3 / (3 R), delta = a^2 / R. The sphere is taken as a "
          "paraboloid; at the edge of the contact that is 1 % of the profile.",
          "Hertz; Johnson, Contact Mechanics (1985) 3.4, 4.2, 5.8")
      .scene("hertz_sphere");
  compare(page, ToolShape::circular, "N");
  page.meaning(
      "Force against depth holds to 2 % with an offset below a tenth of a row. The cube of the contact radius is "
      "also asked, to 5 % at 8 cells: 5.4 % is reached at 8.2 cells and 2.9 % at 9.3.");
}

}  // namespace hertz_test
}  // namespace verification
