// The gap at which contact first acts. Nodes in or on a tool take its velocity as soon as they carry mass, that is when
// the support of the particle next to the surface reaches the first row of nodes under the tool's surface. With a
// support of half-width r about the particle's centre, half a particle's box b between centre and surface, and nodes at
// a depth d under the tool's surface, this is at a gap of r - b - d. Source: geometry of the shape functions (method
// reference 2); contact by nodes (contact/rigid_contact.hpp).
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "methods.hpp"
#include "page.hpp"
#include "scenes.hpp"

namespace stability {
namespace gap_test {

using verification::Map;
using verification::Numbers;
using verification::Outcome;
using verification::Page;

constexpr double kNode = 4.0;    // row of nodes under the plate's surface [cells]
constexpr double kStep = 0.005;  // fall of the block between two observations [cells]
constexpr double kTolerance = 2.01 * kStep;
constexpr double kSpeed = 0.01 * kWaveSpeed;

/// Half-width of the support about the particle's centre [cells].
double reach(mpm::ShapeKind shape, double half) {
  switch (shape) {
    case mpm::ShapeKind::dirac:
      return 1.0;
    case mpm::ShapeKind::bspline2:
      return 1.5;
    case mpm::ShapeKind::bspline3:
      return 2.0;
    default:
      return 1.0 + half;  // the box's border reaches a cell further
  }
}

mpm::SimulationDefinition fall(const mpm::MethodDefinition& method, double depth,
                               mpm::ContactMethod contact = mpm::ContactMethod::nodes) {
  mpm::SimulationDefinition d = domain(method, Vec3::Zero(), {12.0, 0.0, 12.0}, kStep * kCell / kSpeed);
  const double low = kNode + depth + 2.5;
  add_body(d, "block", {4.0, 0.0, low}, {8.0, 0.0, low + 2.0}, linear_elastic(0.3),
           [](const Vec3&) { return Vec3(0.0, 0.0, -kSpeed); });
  d.contact.method = contact;
  d.rigid_bodies = {box("plate", {1.0, 0.0, 0.5}, {11.0, 0.0, kNode + depth})};
  return d;
}

/// Distance between the block's lower surface and the plate when contact force first acts [cells].
double gap(const mpm::SimulationDefinition& d, double depth) {
  mpm::Simulation simulation(d, {1});
  const double half = 0.5 / d.method.particles_per_direction;
  while (simulation.time() < 1000 * simulation.sync_period()) {
    simulation.advance();
    if (simulation.take_contact(0).nodes == 0) continue;
    const std::vector<double> z = field(simulation, "z");
    return *std::min_element(z.begin(), z.end()) / kCell - half - (kNode + depth);
  }
  return -kInfinity;
}

TEST(EarlyContact, GapIsThatOfTheSupport) {
  Page page("contact", "early_contact", "Contact at nodes is felt before it is made");
  page.problem(
          "A block falls slowly on a fixed plate whose surface lies 0 to 0.9 cells above a row of nodes; 4 and 9 "
          "particles a cell. Early: the plate feels the block while there is a gap of half a cell or more.")
      .exact(
          "The gap is r - b - d: r half the width of the particle's support (1 cell for Dirac, 1 + b for domains, 1.5 "
          "and 2 for splines), b half a particle's box, d the depth of the nodes under the surface.",
          "geometry of the shape functions")
      .meaning(
          "This is contact at nodes. At points of the surface (the default) the first force comes when the surfaces "
          "meet, with every method and at every place, which the same test checks. The smoother the function, the "
          "earlier the contact: up to a cell with uGIMP and CPDI, 1.75 cells with cubic splines. The first force is "
          "tiny, as is the mass that reaches the node; it grows while the gap closes. A plate whose surface lies "
          "just below a row of nodes loses nearly a cell of it.");
  const Numbers depths = {0.0, 0.1, 0.25, 0.5, 0.75, 0.9};
  Map map("depth d of the nodes under the surface [cells]", depths);
  for (const int ppc : {2, 3}) {
    for (Method method : shapes()) {
      method.definition.particles_per_direction = ppc;
      const std::string label = fmt::format("{}, {}", method.name, ppc * ppc);
      if (!possible(fall(method.definition, 0.0), method.definition)) {
        map.impossible(label);
        continue;
      }
      const double half = 0.5 / ppc, free = reach(method.definition.shape, half) - half;
      std::vector<Outcome> cells;
      for (const double depth : depths) {
        const double found = gap(fall(method.definition, depth), depth);
        // With contact at points the surfaces have met: the particle's reach is half its box.
        EXPECT_NEAR(gap(fall(method.definition, depth, mpm::ContactMethod::points), depth), 0.0, kTolerance)
            << label << " at points, " << depth;
        // The block falls by kStep between two observations, and by as much in the step that first reaches the node.
        EXPECT_NEAR(found, free - depth, kTolerance) << label << " at " << depth;
        cells.push_back(found < 0.5 ? Outcome::stable : Outcome::fails);
        if (depth == 0.0)
          page.near_absolute("gap at the first force, d = 0, " + label, found, free, kTolerance, "cells");
      }
      map.column(label, cells).theory(free - 0.5).note(fmt::format("{:.2f}", free));
    }
  }
  page.figure().panel("Felt at less than half a cell (above: gap for d = 0)", "", "").map(map);
}

}  // namespace gap_test
}  // namespace stability
