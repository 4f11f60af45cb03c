// A tool that travels far in one step. Contact gives the tool's velocity to the nodes that lie in the tool when the
// step begins; material swept within the step is not considered, and nothing pushes out material that is inside. The
// solver takes a tool's speed into account in its time step, so this occurs only beyond its limit, in single steps.
//
// Nodes are a cell apart: a tool that travels more than a cell in a step sweeps material that no node in the tool has
// moved, and each such step leaves a particle behind by half of the tool's travel, since its position moves with the
// mean of its old and its new velocity.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "methods.hpp"
#include "page.hpp"
#include "probe.hpp"
#include "scenes.hpp"

namespace stability {
namespace fast_tool_test {

using verification::Map;
using verification::Numbers;
using verification::Outcome;
using verification::Page;

constexpr double kDt = 1e-4;     // [s]
constexpr double kThick = 6.0;   // thickness of the tool [cells]
constexpr double kSheet = 14.0;  // position of the sheet of material [cells]
constexpr double kFront = 10.0;  // front of the tool at the start [cells]
constexpr double kWay = 16.0;    // distance that it travels [cells]
constexpr double kInside = 1.0;  // depth in the tool that counts as overrun [cells]

mpm::SimulationDefinition sheet(const mpm::MethodDefinition& method, double cells_a_step) {
  mpm::SimulationDefinition d = domain(method, Vec3::Zero(), {48.0, 0.0, 8.0}, 1e-2);
  d.time.cfl = 0.5;
  // The sheet is so soft that only contact acts.
  add_body(d, "sheet", {kSheet, 0.0, 2.0}, {kSheet + 1.0, 0.0, 6.0}, linear_elastic(0.0, 1e-6 * kCell / kDt));
  d.rigid_bodies = {
      box("tool", {kFront - kThick, 0.0, -10.0}, {kFront, 0.0, 18.0}, {cells_a_step * kCell / kDt, 0.0, 0.0})};
  return d;
}

/// Largest depth of a particle in the tool after the tool has travelled kWay [cells].
double depth(const std::vector<double>& x, double front) {
  return front - *std::min_element(x.begin(), x.end()) / kCell;
}
double unguarded(const mpm::MethodDefinition& method, double cells_a_step) {
  Probe probe(sheet(method, cells_a_step));
  const int steps = static_cast<int>(std::ceil(kWay / cells_a_step));
  for (int i = 0; i < steps; ++i) probe.step(kDt);
  return depth(field(probe.simulation(), "x"), kFront + steps * cells_a_step);
}

TEST(FastTool, RunsOverWhatItSweepsInOneStep) {
  Page page("contact", "fast_tool", "A tool that is faster than a cell a step");
  page.problem(
          "A tool six cells thick meets a sheet of soft material one cell thick and pushes it along; 4 particles a "
          "cell, FLIP, USAVG. Steps are forced to a size in which the tool travels 0.1 to 8 cells. Broken: material is "
          "more than a cell deep inside the tool.")
      .exact("The limit is a cell a step: no step sees material that a tool sweeps beyond the next row of nodes.",
             "the order of a step: contact nodes are found once, at its start")
      .meaning(
          "Below a cell a step the tool pushes all material along, and the solver's time step keeps every tool below "
          "`time.cfl` cells a step.");
  const Numbers rows = {0.1, 0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 8.0};
  Map map("cells that the tool travels in a step", rows);
  verification::Panel& panel = page.figure().panel("Depth in the tool", "cells a step", "depth [cells]");
  for (const Method& method : shapes()) {
    if (!possible(sheet(method.definition, 1.0), method.definition)) {
      map.impossible(method.name);
      continue;
    }
    Numbers depths;
    std::vector<Outcome> cells;
    for (const double row : rows) {
      depths.push_back(unguarded(method.definition, row));
      cells.push_back(depths.back() < kInside ? Outcome::stable : Outcome::fails);
      if (row <= 1.0) {
        EXPECT_LT(depths.back(), kInside) << method.name << ", " << row << " cells a step";
      }
    }
    panel.points(method.name, rows, depths);
    map.column(method.name, cells).theory(1.0);

    // The solver itself, at a speed of 20 cells per sync period.
    mpm::SimulationDefinition d = sheet(method.definition, 1.0);
    d.time.sync = 1'000'000;
    d.rigid_bodies[0].velocity[0] = mpm::Function(20.0 * kCell * 1e3);
    mpm::Simulation simulation(d, {1});
    simulation.advance();
    page.below("travel of the tool in a step of the solver, " + method.name,
               simulation.state().step.dt_max * 20.0 * 1e3, d.time.cfl * (1.0 + 1e-9), "cells");
    page.below("depth in it after 20 cells, " + method.name,
               depth(field(simulation, "x"), simulation.bodies()[0].pose.position.x() / kCell + 0.5 * kThick), kInside,
               "cells");
  }
  page.figure().panel("Nothing deeper than a cell in the tool", "", "").map(map);
}

}  // namespace fast_tool_test
}  // namespace stability
