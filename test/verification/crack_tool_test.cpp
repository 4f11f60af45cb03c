// A tool in a crack: a wedge driven between the two halves of a block, which a crack divides down to their foot,
// against the same halves as two bodies that meet the wedge at points.
//
// Source: the same problem without a crack. Contact at points knows nothing of the nodes' sides and meets the wedge's
// exact surface (its own tests: point contact); its force changes by 1 % from cells of 2 mm to 1 mm.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <string>

#include "crack_case.hpp"
#include "page.hpp"

namespace verification {
namespace crack_tool_test {

constexpr double kEnd = 12e-3;  // [s]

/// Two foam beams, 31 mm wide and 100 mm long, fixed at their feet; `left`: where the grid begins [m].
std::string halves(double cell, double left, const std::string& method, bool crack) {
  const std::string divided =
      "bodies: [{name: block, material: foam, shape: {box: {min: [-0.03, 0], max: [0.032, 0.1]}}}]\n"
      "contact: {method: nodes}\n"
      "cracks:\n  list: [{name: split, points: [[0.001, 0.1005], [0.001, 0.0001]], start: exterior, end: none}]\n";
  const std::string apart =
      "bodies:\n  - {name: left, material: foam, shape: {box: {min: [-0.03, 0], max: [0.001, 0.1]}}}\n"
      "  - {name: right, material: foam, shape: {box: {min: [0.001, 0], max: [0.032, 0.1]}}}\n"
      "contact: {method: points, pairs: [{between: [left, right], friction: 0}]}\n";
  return fmt::format(
             "geometry: plane_strain\nthickness: 0.02\n"
             "grid: {{cell: {}, min: [{}, 0], max: [{}, 0.13]}}\ntime: {{end: {}, cfl: 0.6, sync: 1e-4}}\n"
             "method: {{damping: {{grid: 500}}, transfer: {{{}}}}}\n"
             "materials: [{{name: foam, law: linear_elastic, density: 145, young: 67e6, poisson: 0.3}}]\n"
             "boundaries: {{z_min: fixed}}\n"
             "rigid_bodies:\n  - name: wedge\n    friction: 0.2\n"
             "    shape: {{polygon: {{points: [[0.001, 0.0985], [0.008, 0.1245], [-0.006, 0.1245]]}}}}\n"
             "    motion: {{velocity: [0, \"-0.4*min(1, t/0.002)\"]}}\n"
             "metrics: {{force: {{mean: impulse_z, of: wedge, rate: {{from: 0.009, to: 0.011}}}}}}\n",
             cell, left, 0.002 - left, kEnd, method) +
         (crack ? divided : apart);
}

/// Mean force that holds the wedge up, 2.8 to 3.6 mm deep [N].
double force(double cell, double left, const std::string& method, bool crack) {
  mpm::Simulation run = crack_case::made(halves(cell, left, method, crack));
  run_until(run, kEnd);
  return run.metrics().at(0).second;
}

// The wedge is felt at nodes: where a row of them lies in the crack's plane, a cell of 2 mm changes the force by 4 %;
// where the plane is in the middle of a cell the halves are reached only by a wedge that is a cell wide. About 25 s.
TEST(CrackTool, AWedgeDrivesHalvesApartAsItDoesTwoBodies) {
  const double bodies = force(2e-3, -0.041, "flip: 1", false);
  Page page("crack", "crack_tool", "A wedge in a crack");
  page.problem(
      "Two beams of foam (67 MPa, 31 mm wide, 100 mm long, 20 mm thick, fixed at the foot) that a crack divides over "
      "all of their length. A wedge of 30 degrees is driven between their ends at 0.4 m/s, with a friction of 0.2; the "
      "force on it is averaged from 2.8 to 3.6 mm of depth. Cells of 2 mm; contact is at nodes.");
  page.exact("the same beams as two bodies that meet the wedge at points",
             "another method of contact, without a crack");
  for (const char* method : {"flip: 1", "xpic: 2", "fmpm: 2"}) {
    page.near(fmt::format("force, {}", method), force(2e-3, -0.041, method, true), bodies, 0.05, "N");
  }
  page.report("force, crack in the middle of a cell", force(2e-3, -0.040, "flip: 1", true), "N");
  page.meaning(
      "Beside a crack a tool meets each side's material by the face that is turned to it. Where a row of nodes lies in "
      "the crack's plane the force is near that of two bodies; where the plane is in the middle of a cell, nodes "
      "beside "
      "it are reached only when the wedge is a cell wide there, and the force is too small: put nodes in the plane.");
}

// At 1 mm a cell is worth less. About 90 s.
TEST(FullCrackTool, AtFinerCells) {
  EXPECT_NEAR(force(1e-3, -0.040, "flip: 1", true) / force(1e-3, -0.040, "flip: 1", false), 1.0, 0.02);
}

}  // namespace crack_tool_test
}  // namespace verification
