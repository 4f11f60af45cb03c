// Periodic axes: a standing shear wave, v_z = V sin(k x) cos(k c_s t), is exact in an endless body; material that
// crosses the faces is back at its start after each period; and the place of the domain's faces does not matter.
#include <fmt/core.h>

#include "boundary_run.hpp"
#include "mpm/grid/nodal_fields.hpp"
#include "mpm/math/constants.hpp"

namespace verification {
namespace boundary_periodic_test {

using mpm::kPi;

/// A domain of 16 by 8 cells of 0.05 m, full of material. `drift`: velocity along x [m/s]; `phase`: shift of the wave
/// along x [m].
std::string shear(const char* method, double drift = 0.0, double phase = 0.0) {
  return fmt::format(
      "geometry: plane_strain\ngrid: {{cell: 0.05, min: [0, 0], max: [0.8, 0.4]}}\ntime: {{end: 1, sync: 1 ms}}\n"
      "method: {}\nmaterials: [{{name: m, density: 1000, law: linear_elastic, young: 2.5 MPa, poisson: 0.25}}]\n"
      "bodies: [{{name: all, material: m, shape: {{box: {{min: [0, 0], max: [0.8, 0.4]}}}}, initial: {{velocity: [{}, "
      "\"0.01*sin(2*pi*(x-{})/0.8)\"]}}}}]\nboundaries: {{x: periodic, z: periodic}}\n",
      method, drift, phase);
}
const double kShearSpeed = std::sqrt(1e6 / 1000.0), kPeriod = 0.8 / kShearSpeed;

struct Method {
  const char* text;
  /// Tolerance over the amplitude. On a lattice of 16 cells a wave is slow by (2 pi / 16)^2 / 24 = 0.6 %, 5 degrees
  /// after two periods, and time steps double that. Splines spread mass with the variance h^2 / 4 and h^2 / 3, which
  /// makes the wave slow by 2 % and 2.6 %, up to 20 degrees.
  double tolerance;
};
class Around : public ::testing::TestWithParam<Method> {};

TEST_P(Around, AStandingShearWaveKeepsItsPeriod) {
  mpm::Simulation run = scene(shear(GetParam().text));
  const std::vector<double> x = field(run, "x");
  run_until(run, 0.05);  // nearly two periods, which take 0.0506 s
  const double amplitude = 0.01 * std::cos(2.0 * kPi * 0.05 / kPeriod);
  double worst = 0.0;
  const std::vector<double> vz = field(run, "vz");
  for (std::size_t p = 0; p < x.size(); ++p) {
    worst = std::max(worst, std::abs(vz[p] - amplitude * std::sin(2.0 * kPi * x[p] / 0.8)));
  }
  EXPECT_LT(worst, GetParam().tolerance * 0.01) << GetParam().text;
  const mpm::SolverState state = run.state();
  EXPECT_LT(state.audit.momentum.norm(), 1e-13 * 320.0);  // relative to mass times 1 m/s: there is no external force
  EXPECT_LT(state.audit.residual, 1e-10);
}
INSTANTIATE_TEST_SUITE_P(Methods, Around,
                         ::testing::Values(Method{"{shape: ugimp, update: usavg, transfer: flip}", 0.12},
                                           Method{"{shape: dirac, update: usavg, transfer: flip}", 0.12},
                                           Method{"{shape: ugimp, update: usf, transfer: {xpic: 2}}", 0.12},
                                           Method{"{shape: cpdi, update: usl, transfer: {fmpm: 2}}", 0.12},
                                           Method{"{shape: bspline2, update: usavg, transfer: apic}", 0.3},
                                           Method{"{shape: bspline3, update: usavg, transfer: flip}", 0.3}));

/// The periodic image of `x` in the domain.
double home(double x) { return x - 0.8 * std::floor(x / 0.8); }

// A body drifts through the domain three times, by a sixth of a cell a step or less. Particles far from the faces and
// particles that cross them move alike, and like those of a body at rest, except for the error of crossing cells.
TEST(Periodic, WhatFliesAroundComesBack) {
  const char* const method = "{shape: bspline2, update: usavg, transfer: apic}";
  mpm::Simulation run = scene(shear(method, 16.0));
  const std::vector<double> start = field(run, "x");
  const double energy = run.state().energy.of("kinetic");
  run_until(run, 0.15);  // 2.4 m
  const std::vector<double> x = field(run, "x"), vx = field(run, "vx");
  const double momentum = run.state().audit.momentum.x();
  EXPECT_NEAR(momentum, 16.0 * 320.0, 1e-11 * 16.0 * 320.0);
  EXPECT_NEAR(run.state().energy.of("kinetic"), energy, 1e-6 * energy);
  for (std::size_t p = 0; p < x.size(); ++p) {
    ASSERT_NEAR(std::remainder(x[p] - start[p], 0.8), 0.0, 1e-4) << p;
    ASSERT_GE(x[p], -0.5 * 0.05 - 0.06) << p;  // half a cell, and its travel until it is sorted
    ASSERT_LE(x[p], 0.8 + 0.06) << p;
  }
  EXPECT_LT(run.state().audit.residual, 1e-10);
}

// A wave that is shifted by half the domain along x gives the same particle by particle, to round-off, although other
// particles lie at the faces.
TEST(Periodic, FacesAreNoPlaces) {
  for (const char* method :
       {"{shape: ugimp, update: usavg, transfer: flip}", "{shape: cpdi, update: usf, transfer: apic}"}) {
    mpm::Simulation here = scene(shear(method, 3.0)), there = scene(shear(method, 3.0, 0.4));
    const std::vector<double> x = field(here, "x"), z = field(here, "z"), moved = field(there, "x");
    run_until(here, 0.03);
    run_until(there, 0.03);
    const std::vector<double> a = field(here, "vz"), b = field(there, "vz");
    // Rows along x have 32 particles: the partner lies half a row on.
    for (std::size_t p = 0; p < x.size(); ++p) {
      const std::size_t q = p / 32 * 32 + (p % 32 + 16) % 32;
      ASSERT_NEAR(home(moved[q] + 0.4 - x[p] + 0.1), 0.1, 1e-12);
      ASSERT_NEAR(a[p], b[q], 1e-12) << method << ' ' << p;
    }
  }
}

TEST(Periodic, HasTheSameBitsForAnyNumberOfThreads) {
  const char* const method = "{shape: ugimp, update: usavg, transfer: flip}";
  mpm::Simulation one = scene(shear(method, 5.0), 1), three = scene(shear(method, 5.0), 3);
  run_until(one, 0.03);
  run_until(three, 0.03);
  EXPECT_EQ(one.state_hash(), three.state_hash());
}

// A ball in free fall through the faces of a solid domain that is periodic along all three axes. What it gains by its
// fall is the work against gravity that puts it around.
TEST(Periodic, ASolidFallsThroughItsFaces) {
  mpm::Simulation run = scene(
      "grid: {cell: 0.1, min: [0, 0, 0], max: [0.8, 0.8, 0.8]}\ntime: {end: 1, sync: 1 ms}\ngravity: [0, 0, -10]\n"
      "method: {shape: ugimp, update: usavg, transfer: flip}\n"
      "materials: [{name: m, density: 1000, law: neo_hookean, young: 0.1 MPa, poisson: 0.3}]\n"
      "bodies: [{name: ball, material: m, shape: {sphere: {center: [0.4, 0.4, 0.4], radius: 0.25}}, initial: "
      "{velocity: [1, -2, 0]}}]\nboundaries: {x: periodic, y: periodic, z: periodic}\n");
  const mpm::EnergyReport before = run.state().energy;
  run_until(run, 0.5);
  const mpm::EnergyReport after = run.state().energy;
  EXPECT_NEAR(after.balance(), before.balance(), 1e-9 * after.of("kinetic"));
  const std::vector<double> vx = field(run, "vx"), vy = field(run, "vy"), vz = field(run, "vz");
  for (std::size_t p = 0; p < vx.size(); ++p) {
    ASSERT_NEAR(vx[p], 1.0, 1e-9);
    ASSERT_NEAR(vy[p], -2.0, 1e-9);
    ASSERT_NEAR(vz[p], -5.0, 1e-9);
  }
  EXPECT_LT(run.state().audit.residual, 1e-10);
}

// An endless slab under a pressure on its upper side: it moves alike everywhere along x, also where the corners of a
// particle's face lie on both sides of the domain's face.
TEST(Periodic, TractionsGoAround) {
  for (const char* shape : {"ugimp", "cpdi"}) {
    mpm::Simulation run = scene(fmt::format(
        "geometry: plane_strain\ngrid: {{cell: 0.1, min: [0, 0], max: [0.8, 1]}}\ntime: {{end: 1, sync: 1 ms}}\n"
        "method: {{shape: {}, update: usavg, transfer: flip}}\n"
        "materials: [{{name: m, density: 1000, law: neo_hookean, young: 0.1 MPa, poisson: 0.3}}]\n"
        "bodies: [{{name: slab, material: m, shape: {{box: {{min: [0, 0], max: [0.8, 0.4]}}}}, initial: {{velocity: "
        "[2, 0]}}}}]\nloads: [{{pressure: {{body: slab, edge: z_max, value: 2 kPa}}}}]\n"
        "boundaries: {{x: periodic, z_min: slip}}\n",
        shape));
    run_until(run, 0.1);
    const std::vector<double> vx = field(run, "vx"), vz = field(run, "vz");
    ASSERT_GT(largest(vz), 0.05);
    for (std::size_t p = 0; p < vx.size(); ++p) {
      // Particles of a row have two positions in a cell, in turns; their weights differ once the slab has moved.
      ASSERT_NEAR(vz[p], vz[p / 16 * 16 + p % 2], 1e-9) << shape << ' ' << p;
      ASSERT_NEAR(vx[p], 2.0, 0.02) << shape << ' ' << p;
    }
    EXPECT_LT(run.state().audit.residual, 1e-10);
  }
}

// Blocks at one face are neighbours of those at the opposite face and have a different colour.
TEST(Periodic, BlocksGoAround) {
  mpm::GridLayout layout(2, mpm::Vec3::Constant(0.1), mpm::Vec3::Zero(), mpm::Vec3::Constant(1.6));
  layout.make_periodic(0);
  mpm::BlockTable table(layout);
  table.rebuild({layout.key({0, 1, 0}), layout.key({3, 1, 0})});
  ASSERT_EQ(table.owners(), 2);
  for (int owner = 0; owner < 2; ++owner) {
    for (int s = 0; s < 9; ++s) {
      const std::array<int, 3> own = table.block(table.owner_block(owner)),
                               other = table.block(table.neighbours(owner)[s]);
      EXPECT_EQ(other[0], (own[0] + s / 3 - 1 + 4) % 4);
      EXPECT_EQ(other[1], own[1] + s % 3 - 1);
    }
  }
  EXPECT_EQ(table.size(), 4 * 3);  // columns 3, 0, 1 and 2, 3, 0
  for (int colour = 0; colour < 4; ++colour) EXPECT_LE(table.owners_of_colour(colour).size(), 1u);
  mpm::GridLayout odd(1, mpm::Vec3::Constant(0.1), mpm::Vec3::Zero(), mpm::Vec3::Constant(1.2));
  EXPECT_THROW(odd.make_periodic(0), mpm::GridError);
}

TEST(Periodic, RigidBodiesDoNotGoAround) {
  std::string text = shear("{shape: ugimp, update: usavg, transfer: flip}");
  const std::string full = "box: {min: [0, 0], max: [0.8, 0.4]}";
  text.replace(text.find(full), full.size(), "box: {min: [0, 0], max: [0.2, 0.2]}");
  const std::string ball =
      "rigid_bodies: [{name: ball, shape: {sphere: {radius: 0.05}}, pose: {position: [0.4, 0.25]}, "
      "motion: {velocity: [10, 0]}}]\n";
  mpm::Simulation run = scene(text + ball);
  EXPECT_THROW(run_until(run, 0.1), mpm::PhysicsError);
  const std::string near =
      "rigid_bodies: [{name: ball, shape: {sphere: {radius: 0.05}}, pose: {position: [0.7, 0.25]}}]\n";
  EXPECT_THROW(scene(text + near), mpm::RigidError);
}

}  // namespace boundary_periodic_test
}  // namespace verification
