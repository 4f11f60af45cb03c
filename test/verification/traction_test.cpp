// Tractions on faces of particles, in bodies at rest under them: stress is uniform, with CPDI at any strain, because
// its internal force is the integral of the same interpolants over the faces. Source: Nairn & Guilkey (2015) eq.
// (40)-(55); for a tube under pressure Lamé's solution (Timoshenko & Goodier, Theory of Elasticity, art. 28).
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "mpm/math/constants.hpp"
#include "mpm/simulation/simulation.hpp"
#include "scene_run.hpp"

namespace traction_test {

using mpm::Function;
using mpm::GeometryKind;
using mpm::ShapeKind;
using mpm::Vec3;
using verification::field;

constexpr double kCell = 0.1, kYoung = 1e5, kPoisson = 0.3;

// A box of `cells` cells from `low`, two particles along each edge of a cell, of soft neo-Hookean material with
// damping.
mpm::SimulationDefinition block(GeometryKind geometry, ShapeKind shape, const Vec3& low, const Vec3& cells) {
  mpm::SimulationDefinition d;
  d.geometry = geometry;
  d.method.shape = shape;
  d.method.damping = 30.0;
  d.grid = {Vec3::Constant(kCell), Vec3::Zero(), Vec3::Constant(2.4)};
  d.time.sync = 20'000'000;
  d.materials = {{"m", 1000.0, mpm::NeoHookeanDefinition{{kYoung, kPoisson}}}};
  mpm::DeformableBody body;
  body.name = "block";
  body.material = "m";
  const bool solid = geometry == GeometryKind::solid;
  const double spacing = kCell / 2;
  body.particle_volume = std::pow(spacing, solid ? 3 : 2);
  for (int i = 0; i < 2 * cells.x(); ++i) {
    for (int j = 0; j < (solid ? 2 * cells.y() : 1); ++j) {
      for (int k = 0; k < 2 * cells.z(); ++k) {
        body.positions.push_back(low + spacing * Vec3(i + 0.5, solid ? j + 0.5 : 0.0, k + 0.5));
      }
    }
  }
  d.bodies = {body};
  return d;
}

// Grows smoothly to its value over many times the 0.07 s in which a wave crosses the blocks. Uneven strain, from
// damping or waves while cells are crossed, remains in part, because the grid does not resolve all of it: a slower ramp
// is more even.
Function ramp(double value, int seconds = 1) {
  return Function::parse(fmt::format("{0}*(t < {1} ? 0.5 - 0.5*cos(pi*t/{1}) : 1)", value, seconds));
}

mpm::TractionDefinition on(int face, const std::array<Function, 3>& value, bool follows = false) {
  mpm::TractionDefinition load;
  load.body = "block";
  load.face = face;
  load.value = value;
  load.follows = follows;
  return load;
}
mpm::TractionDefinition pressure(int face, const Function& value) { return on(face, {value}, true); }

struct Range {
  double least, most;
};
/// Range of a stress over all particles [Pa].
Range range(const mpm::Simulation& simulation, const std::string& name) {
  const std::vector<double> values = field(simulation, name);
  return {*std::min_element(values.begin(), values.end()), *std::max_element(values.begin(), values.end())};
}
void expect_even(const mpm::Simulation& simulation, const std::string& name, double value, double tolerance) {
  const Range found = range(simulation, name);
  EXPECT_NEAR(found.least, value, tolerance) << name;
  EXPECT_NEAR(found.most, value, tolerance) << name;
}

// A block is pulled by a fifth of Young's modulus against smooth walls on two sides: every particle has that Cauchy
// stress, and none along z. The section shrinks by 8 %: a nominal stress would show.
TEST(Traction, GivesEvenStress) {
  auto d = block(GeometryKind::plane_strain, ShapeKind::cpdi, Vec3::Zero(), {8, 1, 4});
  d.thickness = 0.5;
  d.bodies[0].particle_volume *= d.thickness;
  d.walls[0].kind = d.walls[4].kind = mpm::WallKind::slip;
  const double stress = 0.2 * kYoung;
  d.tractions = {on(1, {ramp(stress, 20)})};
  mpm::Simulation simulation(d, {1});
  verification::run_until(simulation, 21.0);
  expect_even(simulation, "sxx", stress, 1e-3 * stress);
  expect_even(simulation, "szz", 0.0, 1e-3 * stress);
  expect_even(simulation, "sxz", 0.0, 1e-3 * stress);
  EXPECT_LT(simulation.state().audit.residual, 1e-10);
}

// Pressure on all faces of a free block: no net force, and the same pressure inside, although every face has shrunk.
TEST(Traction, PressureOnAllFacesIsPressureInside) {
  for (const GeometryKind geometry : {GeometryKind::plane_strain, GeometryKind::solid}) {
    const bool solid = geometry == GeometryKind::solid;
    auto d = block(geometry, ShapeKind::cpdi, {1.0, solid ? 1.0 : 0.0, 1.0}, {4, 4, 4});
    const double p = 0.3 * kYoung;
    for (int face = 0; face < 6; ++face) {
      if (solid || face / 2 != 1) d.tractions.push_back(pressure(face, ramp(p)));
    }
    mpm::Simulation simulation(d, {1});
    verification::run_until(simulation, 2.0);
    for (const char* name : {"sxx", "szz"}) expect_even(simulation, name, -p, 1e-3 * p);
    if (solid) expect_even(simulation, "syy", -p, 1e-3 * p);
    expect_even(simulation, "sxz", 0.0, 1e-3 * p);
    const mpm::SolverState state = simulation.state();
    // Relative to the impulse of one face.
    EXPECT_LT(state.audit.momentum.norm(), 1e-12 * p * std::pow(4 * kCell, solid ? 2 : 1));
    EXPECT_LT(state.audit.residual, 1e-10);
  }
}

// In axisymmetry: a cylinder under pressure on its side and its end, on a smooth plane.
TEST(Traction, PressureOnACylinderIsPressureInside) {
  auto d = block(GeometryKind::axisymmetric, ShapeKind::cpdi, Vec3::Zero(), {4, 1, 4});
  d.walls[4].kind = mpm::WallKind::slip;
  const double p = 0.1 * kYoung;
  d.tractions = {pressure(1, ramp(p)), pressure(5, ramp(p))};
  mpm::Simulation simulation(d, {1});
  verification::run_until(simulation, 2.0);
  for (const char* name : {"sxx", "syy", "szz"}) expect_even(simulation, name, -p, 1e-3 * p);
  EXPECT_LT(simulation.state().audit.residual, 1e-10);
}

// A tube from r = a to b = 2 a, fixed along z, under pressure inside. Strain is almost constant over a cell, so stress
// is compared cell by cell, of which there are 8 across the wall: it is second order, and the square of a cell over the
// inner radius is 1.6 %.
TEST(Traction, TubeUnderPressureIsLames) {
  for (const ShapeKind shape : {ShapeKind::ugimp, ShapeKind::cpdi}) {
    constexpr double kInner = 0.8, kOuter = 1.6;
    constexpr int kCells = 8;
    auto d = block(GeometryKind::axisymmetric, shape, {kInner, 0.0, 0.0}, {kCells, 1, 4});
    d.grid.max.z() = 0.4;
    d.walls[4].kind = d.walls[5].kind = mpm::WallKind::slip;
    d.method.damping = 15.0;  // the tube oscillates radially at 8 rad/s; damping is about critical
    const double p = 1e-3 * kYoung;
    d.tractions = {pressure(0, ramp(p))};
    mpm::Simulation simulation(d, {1});
    verification::run_until(simulation, 2.5);
    const double a2 = kInner * kInner, b2 = kOuter * kOuter, mean = p * a2 / (b2 - a2), part = mean * b2;
    const std::vector<double> x = field(simulation, "x"), radial = field(simulation, "sxx"),
                              hoop = field(simulation, "syy");
    std::array<double, kCells> radial_error{}, hoop_error{};
    double motion = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const double r = d.bodies[0].positions[i].x();
      const double u = (1.0 + kPoisson) / kYoung * ((1.0 - 2.0 * kPoisson) * mean * r + part / r);
      const auto cell = static_cast<std::size_t>((r - kInner) / kCell);
      radial_error[cell] += (radial[i] - (mean - part / (r * r))) * kCells / static_cast<double>(x.size());
      hoop_error[cell] += (hoop[i] - (mean + part / (r * r))) * kCells / static_cast<double>(x.size());
      motion = std::max(motion, std::abs((x[i] - r) / u - 1.0));
    }
    for (int cell = 0; cell < kCells; ++cell) {
      EXPECT_NEAR(radial_error[cell], 0.0, 0.01 * p) << mpm::shape_name(shape) << ", cell " << cell;
      EXPECT_NEAR(hoop_error[cell], 0.0, 0.01 * p) << mpm::shape_name(shape) << ", cell " << cell;
    }
    EXPECT_LT(motion, 0.005) << mpm::shape_name(shape);
    EXPECT_LT(simulation.state().audit.residual, 1e-10);
  }
}

// Without damping all work of the load becomes energy of the block, except for the little that FLIP loses (at most 0.3
// % here); and the state has the same bits for any number of threads, with every shape function. With dirac the work is
// an exception (1.1 %): corners of its particles' boxes lie in other cells than the particles, whose nodes move
// differently.
TEST(Traction, WorksAndRepeats) {
  for (std::size_t kind = 0; kind < mpm::kShapeTraits.size(); ++kind) {
    const auto shape = static_cast<ShapeKind>(kind);
    auto d = block(GeometryKind::plane_strain, shape, Vec3::Constant(1.0), {4, 1, 4});
    d.method.damping = 0.0;
    d.bodies[0].velocities.assign(d.bodies[0].positions.size(), Vec3(1.0, 0.0, 0.5));
    d.tractions = {on(1, {ramp(0.02 * kYoung), Function(), Function::parse("-1e3*t")}),
                   pressure(4, ramp(0.02 * kYoung))};
    std::vector<std::uint64_t> hashes;
    for (const int threads : {1, 3}) {
      mpm::Simulation simulation(d, {threads});
      const double before = simulation.state().energy.of("kinetic");
      verification::run_until(simulation, 0.3);
      const mpm::SolverState state = simulation.state();
      const double gained = state.energy.of("kinetic") + state.energy.of("elastic") - before;
      if (shape != ShapeKind::dirac) {
        EXPECT_NEAR(state.energy.of("load_work"), gained, 0.005 * gained) << mpm::shape_name(shape);
      }
      EXPECT_LT(state.audit.residual, 1e-10) << mpm::shape_name(shape);
      hashes.push_back(simulation.state_hash());
    }
    EXPECT_EQ(hashes[0], hashes[1]) << mpm::shape_name(shape);
  }
}

// A force that is shared among rings by mass accelerates them equally.
TEST(Traction, ForceOnRingsIsSharedByMass) {
  auto d = block(GeometryKind::axisymmetric, ShapeKind::ugimp, {0.0, 0.0, 1.0}, {4, 1, 4});
  d.method.damping = 0.0;
  mpm::ParticleForceDefinition load;
  load.body = "block";
  load.force[2] = Function(50.0);
  d.particle_forces = {load};
  mpm::Simulation simulation(d, {1});
  verification::run_until(simulation, 0.2);
  const double mass = 1000.0 * mpm::kPi * 0.4 * 0.4 * 0.4;  // mass of the cylinder
  const double velocity = 50.0 * 0.2 / mass;
  for (const double vz : field(simulation, "vz")) EXPECT_NEAR(vz, velocity, 1e-12 * velocity);
  EXPECT_NEAR(simulation.state().audit.momentum.z(), 10.0, 1e-11);
}

TEST(Traction, IsRefusedWhereItCannotBe) {
  auto d = block(GeometryKind::axisymmetric, ShapeKind::ugimp, {0.0, 0.0, 1.0}, {4, 1, 4});
  const auto refusal = [&](const mpm::TractionDefinition& load) -> std::string {
    d.tractions = {load};
    try {
      mpm::Simulation simulation(d, {1});
    } catch (const mpm::DefinitionError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(refusal(pressure(0, Function(1.0))),
            "traction on 'block': its x_min lies on the axis r = 0 and has no area; use another face");
  EXPECT_EQ(refusal(pressure(2, Function(1.0))),
            "traction on 'block': its particles have no face y_min in this geometry, axisymmetric");
  auto load = pressure(1, Function(1.0));
  load.particles = {64};
  EXPECT_EQ(refusal(load), "traction on 'block': it has no particle 64, but 64");
  load = pressure(1, Function(1.0));
  load.body = "nobody";
  EXPECT_EQ(refusal(load), "traction: no deformable body is called 'nobody'; name one of 'bodies'");
  d.tractions = {pressure(1, Function::parse("t < 0.1 ? 0 : sqrt(-1)"))};
  mpm::Simulation simulation(d, {1});
  EXPECT_THROW(verification::run_until(simulation, 0.3), mpm::PhysicsError);
}

}  // namespace traction_test
