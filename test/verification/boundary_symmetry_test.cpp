// A symmetry plane: half of a problem with a symmetry plane equals half of the whole problem. And particles that leave
// the grid.
#include <fmt/core.h>

#include "boundary_run.hpp"
#include "mpm/grid/symmetry_planes.hpp"

namespace verification {
namespace {

/// A block under a tool that presses on it: the whole, or its right half.
std::string pressed(bool half) {
  return fmt::format(
      "geometry: plane_strain\ngrid: {{cell: 0.05, min: [{0}, 0], max: [0.8, 0.8]}}\ntime: {{end: 1, sync: 1 ms}}\n"
      "method: {{shape: ugimp, update: usavg, transfer: flip}}\n"
      "materials: [{{name: m, density: 1000, law: neo_hookean, young: 0.2 MPa, poisson: 0.3}}]\n"
      "bodies: [{{name: block, material: m, shape: {{box: {{min: [{1}, 0], max: [0.4, 0.4]}}}}}}]\n"
      "rigid_bodies: [{{name: die, shape: {{sphere: {{radius: 0.2}}}}, pose: {{position: [0, 0.61]}}, friction: 0.3, "
      "motion: {{velocity: [0, -1]}}}}]\n"
      "contact: {{method: nodes}}\nboundaries: {{z_min: slip, x_min: {2}}}\n",
      half ? "0" : "-0.8", half ? "0" : "-0.4", half ? "symmetry" : "none");
}

TEST(Symmetry, TheHalfIsHalfOfTheWhole) {
  mpm::Simulation whole = scene(pressed(false)), half = scene(pressed(true));
  run_until(whole, 0.06);
  run_until(half, 0.06);
  const mpm::Vec3 all = whole.take_contact(0).impulse, part = half.take_contact(0).impulse;
  ASSERT_GT(all.z(), 0.0);
  // Contact is at nodes, whose sums mirror to round-off. The two runs differ only where the boxes of particles beside
  // the plane reach across it: there the wall constrains the nodes beyond, whereas in the whole problem they carry
  // material of the other side.
  EXPECT_NEAR(part.z(), 0.5 * all.z(), 1e-3 * all.z());
  EXPECT_NEAR(all.x(), 0.0, 1e-9 * all.z());
  EXPECT_NEAR(half.state().energy.elastic, 0.5 * whole.state().energy.elastic, 1e-3 * whole.state().energy.elastic);
  EXPECT_LT(half.state().audit.residual, 1e-10);
}

TEST(Symmetry, PlanesAreKnownAtTheirNodes) {
  const mpm::GridLayout layout(2, mpm::Vec3::Constant(0.1), mpm::Vec3::Zero(), mpm::Vec3::Constant(0.8));
  mpm::SymmetryPlanes planes;
  EXPECT_FALSE(planes.any());
  planes.add(0);  // x_min
  planes.add(3);  // z_max
  EXPECT_TRUE(planes.any());
  EXPECT_EQ(planes.axes_at(layout, {4, 4, 0}), 0u);
  EXPECT_EQ(planes.axes_at(layout, {0, 0, 0}), 1u);
  EXPECT_EQ(planes.axes_at(layout, {8, 0, 0}), 0u);
  EXPECT_EQ(planes.axes_at(layout, {3, 8, 0}), 2u);
  EXPECT_EQ(planes.axes_at(layout, {-1, 8, 0}), 3u);
}

/// A block of four cells, 16 particles, that flies out of the grid.
std::string flying(int limit) {
  return fmt::format(
      "geometry: plane_strain\ngrid: {{cell: 0.1, min: [0, 0], max: [1, 1], leave: {{limit: {}}}}}\n"
      "time: {{end: 1, sync: 1 ms}}\nmethod: {{shape: ugimp, update: usavg, transfer: flip}}\n"
      "materials: [{{name: m, density: 1000, law: neo_hookean, young: 0.1 MPa, poisson: 0.3}}]\n"
      "bodies: [{{name: block, material: m, shape: {{box: {{min: [0.6, 0.4], max: [0.8, 0.6]}}}}, initial: {{velocity: "
      "[2, 0.1]}}}}]\n",
      limit);
}

TEST(Leaving, ParticlesArePutBackAndCounted) {
  mpm::Simulation run = scene(flying(16));
  run_until(run, 0.2);
  const mpm::SolverState state = run.state();
  EXPECT_GE(state.returned, 4u);  // at least the outer column
  EXPECT_LE(state.returned, 16u);
  for (const double x : field(run, "x")) EXPECT_LE(x, 1.0);
  EXPECT_LT(impulse(run, "returned").x(), 0.0);
  EXPECT_LT(state.audit.residual, 1e-10);
}

TEST(Leaving, MoreThanTheLimitEndsTheRun) {
  mpm::Simulation run = scene(flying(3));
  try {
    run_until(run, 0.2);
    FAIL() << "nothing was said";
  } catch (const mpm::PhysicsError& error) {
    EXPECT_EQ(std::string(error.what()).find("more than 3 particles have left the grid (grid.leave.limit): particle "),
              0u)
        << error.what();
  }
  mpm::Simulation none = scene(flying(0));
  EXPECT_THROW(run_until(none, 0.2), mpm::PhysicsError);
}

}  // namespace
}  // namespace verification
