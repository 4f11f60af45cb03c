// A symmetry plane: half of a problem with a symmetry plane equals half of the whole problem. And particles that leave
// the grid.
#include <fmt/core.h>

#include "boundary_run.hpp"
#include "mpm/grid/nodal_fields.hpp"

namespace verification {
namespace boundary_symmetry_test {

/// A tool on a block, and the method of its contact.
struct Press {
  const char* name;
  bool deformable;
  const char* normals;  ///< method of the normals, for a rigid die
  const char* contact;
};

/// A block under a die or a deformable punch: the whole, or its right half.
std::string pressed(const Press& press, bool half) {
  const std::string punch = fmt::format(
      "  - {{name: punch, material: m, shape: {{box: {{min: [{}, 0.41], max: [0.2, 0.61]}}}}, "
      "initial: {{velocity: [0, -1]}}}}\n",
      half ? "0" : "-0.2");
  const std::string die = fmt::format(
      "rigid_bodies: [{{name: die, shape: {{sphere: {{radius: 0.2}}}}, pose: {{position: [0, 0.61]}}, "
      "normals: {}, motion: {{velocity: [0, -1]}}}}]\n",
      press.normals);
  return fmt::format(
      "geometry: plane_strain\ngrid: {{cell: 0.05, min: [{0}, 0], max: [0.8, 0.8]}}\ntime: {{end: 1, sync: 1 ms}}\n"
      "method: {{shape: ugimp, update: usavg, transfer: flip}}\n"
      "materials: [{{name: m, density: 1000, law: neo_hookean, young: 0.2 MPa, poisson: 0.3}}]\nbodies:\n"
      "  - {{name: block, material: m, shape: {{box: {{min: [{1}, 0], max: [0.4, 0.4]}}}}}}\n{3}"
      "contact: {4}\nboundaries: {{z_min: slip, x_min: {2}}}\n",
      half ? "0" : "-0.8", half ? "0" : "-0.4", half ? "symmetry" : "none", press.deformable ? punch : die,
      press.contact);
}

// A node on the plane holds half of its material, which minimum_volume would take for a corner without the mirror image
// (Nairn & Guilkey (2015) section 3.3).
TEST(Symmetry, TheHalfIsHalfOfTheWhole) {
  const Press presses[] = {
      {"at nodes", false, "surface", "{method: nodes, friction: 0.3}"},
      {"particles", false, "particles", "{friction: 0.3, minimum_volume: 0.8}"},
      {"deformable", true, "", "{law: coulomb, friction: 0.3, minimum_volume: 0.8}"},
  };
  for (const Press& press : presses) {
    SCOPED_TRACE(press.name);
    mpm::Simulation whole = scene(pressed(press, false)), half = scene(pressed(press, true));
    run_until(whole, 0.06);
    run_until(half, 0.06);
    const auto given = [&](mpm::Simulation& run) {
      return press.deformable ? run.take_pairs().at(0).impulse : run.take_contact(0).impulse;
    };
    const mpm::Vec3 all = given(whole), part = given(half);
    ASSERT_GT(all.z(), 1.0);  // [N s]
    // Contact is at nodes, whose sums mirror to round-off. The two runs differ only where the boxes of particles beside
    // the plane reach across it: there the wall constrains the nodes beyond, whereas in the whole problem they carry
    // material of the other side.
    EXPECT_NEAR(part.z(), 0.5 * all.z(), 1e-3 * std::abs(all.z()));
    EXPECT_NEAR(all.x(), 0.0, 1e-9 * std::abs(all.z()));
    EXPECT_NEAR(half.state().energy.of("elastic"), 0.5 * whole.state().energy.of("elastic"),
                1e-3 * whole.state().energy.of("elastic"));
    EXPECT_LT(half.state().audit.residual, 1e-10);
  }
}

TEST(Symmetry, MirrorsAreKnownAtTheirNodes) {
  mpm::Grid grid(mpm::GridLayout(2, mpm::Vec3::Constant(0.1), mpm::Vec3::Zero(), mpm::Vec3::Constant(0.8)));
  const auto at = [&](int i, int k) {
    const std::array<bool, 3> across = grid.mirrored({i, k, 0});
    return std::pair{across[0], across[1]};
  };
  EXPECT_EQ(at(0, 8), std::pair(false, false));
  grid.mirrors[0] = grid.mirrors[3] = true;  // x_min and z_max
  EXPECT_EQ(at(4, 4), std::pair(false, false));
  EXPECT_EQ(at(0, 0), std::pair(true, false));
  EXPECT_EQ(at(8, 0), std::pair(false, false));
  EXPECT_EQ(at(3, 8), std::pair(false, true));
  EXPECT_EQ(at(-1, 8), std::pair(true, true));
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
  EXPECT_GE(state.number("returned"), 4.0);  // at least the outer column
  EXPECT_LE(state.number("returned"), 16.0);
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

}  // namespace boundary_symmetry_test
}  // namespace verification
