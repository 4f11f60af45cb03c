// A tool made of particles in a crack: a wedge driven between two halves that a crack parts, against the same halves as
// two bodies with velocity fields of their own. Such a tool meets what each field has at its nodes, so both are the
// same to the round-off of sums, whatever the field that a side of the crack has at a node.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "crack_case.hpp"

namespace verification {
namespace crack_particle_tool_test {

/// Two foam beams, fixed at their feet, and the wedge between their ends.
std::string halves(const std::string& bodies, const std::string& friction) {
  return fmt::format(
      "geometry: plane_strain\nthickness: 0.02\n"
      "grid: {{cell: 0.002, min: [-0.041, 0.04], max: [0.043, 0.13]}}\ntime: {{end: 1, cfl: 0.6, sync: 1e-4}}\n"
      "method: {{damping: {{grid: 500}}, transfer: {{flip: 1}}}}\ncontact: {{method: nodes}}\n"
      "materials: [{{name: foam, law: linear_elastic, density: 145, young: 67e6, poisson: 0.3}}]\n"
      "boundaries: {{z_min: fixed}}\n"
      "rigid_bodies:\n  - {{name: wedge, normals: particles, friction: {}, "
      "shape: {{polygon: {{points: [[0.001, 0.0985], [0.008, 0.1245], [-0.006, 0.1245]]}}}}, "
      "motion: {{velocity: [0, \"-0.8*min(1, t/0.001)\"]}}}}\n"
      "metrics: {{force: {{mean: impulse_z, of: wedge, rate: {{from: 0.002, to: 0.003}}}}}}\n{}",
      friction, bodies);
}

using ByPlace = std::map<std::pair<double, double>, double>;

/// The displacement along x of all particles after 3 ms, by their places at the start; and the force on the wedge [N].
std::pair<ByPlace, double> driven(mpm::Simulation run) {
  const std::vector<double> x = field(run, "x"), z = field(run, "z");
  run_until(run, 3e-3);
  const std::vector<double> now = field(run, "x");
  ByPlace moved;
  for (std::size_t p = 0; p < x.size(); ++p) moved[{x[p], z[p]}] = now[p] - x[p];
  return {moved, run.metrics().at(0).second};
}

// Before the wedge has left the exterior end of the crack behind, whose line is not in the middle any more. About 5 s.
TEST(CrackParticleTool, AWedgeOfParticlesPartsHalvesAsItDoesTwoBodies) {
  for (const char* friction : {"0", "0.3"}) {
    const auto [cracked, force] = driven(crack_case::made(halves(
        "bodies: [{name: block, material: foam, shape: {box: {min: [-0.03, 0.04], max: [0.032, 0.1]}}}]\n"
        "cracks: {list: [{name: split, line: {from: [0.001, 0.0995], to: [0.001, 0.0405]}, start: exterior, end: "
        "exterior, faces: ignored}]}\n",
        friction)));
    mpm::SimulationDefinition apart = mpm::build(mpm::parse_scene(
        halves("bodies:\n  - {name: left, material: foam, shape: {box: {min: [-0.03, 0.04], max: [0.001, 0.1]}}}\n"
               "  - {name: right, material: foam, shape: {box: {min: [0.001, 0.04], max: [0.032, 0.1]}}}\n",
               friction),
        "apart"));
    apart.bodies[1].field = 1;
    const auto [bodies, other_force] = driven(mpm::Simulation(apart, {1}));
    ASSERT_EQ(cracked.size(), bodies.size());
    double most = 0.0, widest = 0.0;
    for (const auto& [place, moved] : bodies) {
      most = std::max(most, std::abs(moved - cracked.at(place)));
      widest = std::max(widest, std::abs(moved));
    }
    EXPECT_GT(widest, 1e-4) << friction;
    EXPECT_LT(most, 1e-9 * widest) << friction;
    EXPECT_GT(std::abs(force), 1.0) << friction;
    EXPECT_NEAR(other_force / force, 1.0, 1e-8) << friction;
  }
}

}  // namespace crack_particle_tool_test
}  // namespace verification
