// Velocities prescribed on the grid, and tractions, against d'Alembert's solution and uniform strain. A bar whose end
// x = 0 moves with v(t) carries v(t - x/c), and the pressure at its end is rho c v until the wave is back.
// Sources: the wave equation; Nairn, GIMP notes (3.1)-(3.11). A cylinder under pressure is in traction_test.cpp, a
// spinning disk in spinning_disk_test.cpp.
#include <fmt/core.h>

#include "boundary_run.hpp"
#include "mpm/math/constants.hpp"

namespace verification {
namespace boundary_conditions_test {

using mpm::kPi;
constexpr double kSpeed = 100.0, kDensity = 100.0, kArea = 4e-4;  // bar [m/s], [kg/m^3], [m^2]

/// A bar of 1 m in 100 cells, linear elastic, c = 100 m/s.
std::string bar(const std::string& rest) {
  return "geometry: line\narea: 4e-4\ngrid: {cell: 0.01, min: 0, max: 1.1}\ntime: {end: 1, sync: 0.1 ms}\n"
         "materials: [{name: m, density: 100, law: linear_elastic, young: 1 MPa, poisson: 0}]\n"
         "bodies: [{name: bar, material: m, shape: {box: {min: 0, max: 1}}}]\n" +
         rest;
}

/// Rises smoothly from 0 to 0.1 in 3 ms, in which the wave travels 30 cells.
double ramp(double t) { return t <= 0.0 ? 0.0 : (t < 3e-3 ? 0.05 * (1.0 - std::cos(kPi * t / 3e-3)) : 0.1); }
const char* const kRamp = "(t < 3e-3 ? 0.05*(1 - cos(pi*t/3e-3)) : 0.1)";

class Drive : public ::testing::TestWithParam<const char*> {};

TEST_P(Drive, AMovingEndSendsDAlembertsWave) {
  mpm::Simulation run =
      scene(bar(fmt::format("method: {}\nboundaries: {{conditions: [{{name: end, region: {{box: "
                            "{{min: -0.014, max: 0.004}}}}, direction: x, velocity: '{}'}}]}}\n",
                            GetParam(), kRamp)));
  const std::vector<double> start_x = field(run, "x");
  run_until(run, 8e-3);
  const std::vector<double> v = field(run, "vx");
  double worst = 0.0, work = 0.0, impulse_exact = 0.0;
  for (std::size_t p = 0; p < v.size(); ++p) worst = std::max(worst, std::abs(v[p] - ramp(8e-3 - start_x[p] / kSpeed)));
  for (int i = 0; i < 8000; ++i) {
    const double now = ramp((i + 0.5) * 1e-6), force = kDensity * kSpeed * kArea * now;
    impulse_exact += force * 1e-6;
    work += force * now * 1e-6;
  }
  // The ramp is 30 cells long and has travelled 50 cells. It is slow by (2 pi / 60)^2 / 24 = 0.05 %, a fortieth of a
  // cell, which is 0.2 % of the ramp; splines are five times as slow, and APIC smooths the ramp's ends. The end has
  // moved by 0.07 cells against the row of nodes that is driven, which delays the wave by as much, 0.4 %.
  EXPECT_LT(worst, 0.025 * 0.1);
  EXPECT_NEAR(impulse(run, "condition/end").x(), impulse_exact, 0.01 * impulse_exact);
  const mpm::SolverState state = run.state();
  EXPECT_NEAR(state.energy.of("load_work"), work, 0.01 * work);
  EXPECT_NEAR(state.energy.of("kinetic") + state.energy.of("elastic"), state.energy.of("load_work"), 0.01 * work);
  EXPECT_LT(state.audit.residual, 1e-10);
}
INSTANTIATE_TEST_SUITE_P(Methods, Drive,
                         ::testing::Values("{shape: ugimp, update: usavg, transfer: flip}",
                                           "{shape: ugimp, update: usf, transfer: flip}",
                                           "{shape: cpdi, update: usl, transfer: flip}",
                                           "{shape: bspline2, update: usavg, transfer: apic}",
                                           "{shape: ugimp, update: usavg, transfer: {fmpm: 2}}",
                                           "{shape: ugimp, update: usavg, transfer: {xpic: 2}}"));

// A pressure rho c v on the free end sends a wave of velocity v whose stress is the pressure.
TEST(Traction, AtTheEndOfABarSendsItsWave) {
  const double pressure = 0.1 * kDensity * kSpeed;
  mpm::Simulation run =
      scene(bar(fmt::format("method: {{shape: ugimp, update: usavg, transfer: flip}}\nloads: "
                            "[{{traction: {{body: bar, edge: x_min, traction: '{:g}*10*{}'}}}}]\n",
                            pressure, kRamp)));
  const std::vector<double> start_x = field(run, "x");
  run_until(run, 8e-3);
  const std::vector<double> v = field(run, "vx"), stress = field(run, "sxx");
  double worst = 0.0, worst_stress = 0.0;
  for (std::size_t p = 0; p < v.size(); ++p) {
    const double exact = ramp(8e-3 - start_x[p] / kSpeed);
    worst = std::max(worst, std::abs(v[p] - exact));
    worst_stress = std::max(worst_stress, std::abs(stress[p] + kDensity * kSpeed * exact));
  }
  EXPECT_LT(worst, 0.02 * 0.1);
  EXPECT_LT(worst_stress, 0.02 * pressure);
  EXPECT_LT(run.state().audit.residual, 1e-10);
}

/// A block of 8 by 8 cells; all its nodes lie in the regions of the conditions.
std::string block(const std::string& conditions) {
  return "geometry: plane_strain\ngrid: {cell: 0.1, min: [0, 0], max: [2, 2]}\ntime: {end: 1, sync: 1 ms}\n"
         "method: {shape: ugimp, update: usavg, transfer: flip}\n"
         "materials: [{name: m, density: 1000, law: linear_elastic, young: 1 MPa, poisson: 0.25}]\n"
         "bodies: [{name: block, material: m, shape: {box: {min: [0.6, 0.6], max: [1.4, 1.4]}}}]\n"
         "boundaries:\n  conditions:\n" +
         conditions;
}
const char* const kAll = "region: {box: {min: [0.3, 0.3], max: [1.7, 1.7]}}";

// Stretch along a direction that is turned by 30 degrees, and none across it: uniform uniaxial strain. Two conditions,
// one with the opposite direction, add up along one line; a third is orthogonal to them. Stress is M e along it and
// lambda e across, with the logarithmic strain e = 1e-3. Cauchy and Kirchhoff stress, and strain of second order,
// differ relatively by the order of e.
TEST(VelocityConditions, StretchAlongATurnedDirectionIsUniformStrain) {
  const double c = std::cos(kPi / 6.0), s = 0.5, strain = 1e-3;
  const std::string along = fmt::format("({:.17g}*x + 0.5*z)", c);
  mpm::Simulation run = scene(block(
      fmt::format("  - {{name: part, {0}, direction: [{1:.17g}, 0.5], velocity: '0.04*{2}'}}\n"
                  "  - {{name: rest, {0}, direction: [-{1:.17g}, -0.5], velocity: '-0.06*{2}'}}\n"
                  "  - {{name: across, shape: {{box: {{size: [4, 4]}}}}, direction: [-0.5, {1:.17g}], velocity: 0}}\n",
                  kAll, c, along)));
  run_until(run, 0.01);
  const double lame = 1e6 * 0.25 / (1.25 * 0.5), shear = 1e6 / 2.5;
  const double size = (lame + 2.0 * shear) * strain, tolerance = 2.0 * strain * size;
  const double xx = lame * strain + 2.0 * shear * strain * c * c, zz = lame * strain + 2.0 * shear * strain * s * s;
  const double xz = 2.0 * shear * strain * c * s;
  for (const auto& [name, exact] : {std::pair{"sxx", xx}, {"szz", zz}, {"sxz", xz}}) {
    for (const double value : field(run, name)) ASSERT_NEAR(value, exact, tolerance) << name;
  }
  EXPECT_LT(run.state().audit.residual, 1e-10);
  const mpm::Vec3 part = impulse(run, "condition/part"), rest = impulse(run, "condition/rest");
  EXPECT_NEAR((part - rest).norm(), 0.0, 1e-12 * part.norm());  // equal shares of one impulse
}

// All nodes move along the direction as prescribed; across it they are in free flight.
TEST(VelocityConditions, LeaveFreeWhatIsAcross) {
  const double c = std::cos(kPi / 6.0);
  std::string text =
      block(fmt::format("  - {{name: n, {}, direction: [{:.17g}, 0.5], velocity: '0.5*sin(20*t)'}}\n", kAll, c));
  text.replace(text.find("1.4]}}}"), 7, "1.4]}}, initial: {velocity: [-0.1, 0.17320508075688773]}}");
  mpm::Simulation run = scene(text);
  const mpm::Vec3 before = run.state().audit.momentum;
  run_until(run, 0.1);
  const double prescribed = 0.5 * std::sin(2.0);
  for (const double vx : field(run, "vx")) ASSERT_NEAR(vx, -0.1 + prescribed * c, 1e-12);
  for (const double vz : field(run, "vz")) ASSERT_NEAR(vz, 0.2 * c + prescribed * 0.5, 1e-12);
  const double mass = 1000.0 * 0.64;
  EXPECT_NEAR(impulse(run, "condition/n").x(), mass * prescribed * c, 1e-10 * mass);
  EXPECT_NEAR((run.state().audit.momentum - before).norm(), mass * prescribed, 1e-10 * mass);
  EXPECT_NEAR(run.state().energy.of("load_work"), 0.5 * mass * prescribed * prescribed,
              1e-3 * mass * prescribed * prescribed);  // trapezoids
}

// A condition without a velocity prescribes that of its region, which carries the material along.
TEST(VelocityConditions, ARegionTakesAlongWhatItHolds) {
  std::string text = block(
      "  - {name: grip, shape: {box: {size: [0.42, 4]}}, pose: {position: [0.8, 1]}, motion: {velocity: [1, 0]}, "
      "direction: x}\n");
  text.replace(text.find("transfer: flip"), 14, "transfer: apic");  // particles have the grid's velocity
  mpm::Simulation run = scene(text);
  run_until(run, 0.05);
  // The region prescribes the columns of nodes from 0.6 to 1.0 m and, after it has moved by 5 cm, from 0.7 to 1.0.
  const std::vector<double> x = field(run, "x"), vx = field(run, "vx");
  int counted = 0;
  for (std::size_t p = 0; p < x.size(); ++p) {
    if (x[p] < 0.75 || x[p] > 0.95) continue;
    ++counted;
    EXPECT_NEAR(vx[p], 1.0, 1e-9) << x[p];
  }
  EXPECT_GT(counted, 30);
  EXPECT_LT(run.state().audit.residual, 1e-10);
}

// Two bodies have velocity fields of their own. A condition prescribes both, and its account is their sum. Both cross
// the faces of a periodic axis in their fields.
TEST(VelocityConditions, HoldEveryVelocityField) {
  std::string text = block(fmt::format("  - {{name: n, {}, direction: x, velocity: '0.5*sin(20*t)'}}\n", kAll));
  text.replace(text.find("max: [2, 2]"), 11, "max: [2.4, 1.6]");
  text.replace(
      text.find("max: [1.4, 1.4]}}}"), 18,
      "max: [1.0, 1.4]}}}, {name: other, material: m, shape: {box: {min: [1.0, 0.6], max: [1.4, 1.4]}}, initial: "
      "{velocity: [0, -8]}}");
  text.replace(text.find("boundaries:\n"), 12, "boundaries:\n  z: periodic\n");
  mpm::SimulationDefinition d = mpm::build(mpm::parse_scene(text, "boundary.yaml"));
  d.bodies[1].field = 1;
  mpm::Simulation run(std::move(d), {1});
  run_until(run, 0.03);  // the other has fallen by 0.24 m, and is still in the region
  const double prescribed = 0.5 * std::sin(0.6), mass = 1000.0 * 0.64;
  for (const double vx : field(run, "vx")) ASSERT_NEAR(vx, prescribed, 1e-12);
  EXPECT_NEAR(impulse(run, "condition/n").x(), mass * prescribed, 1e-10 * mass);
  run_until(run, 0.2);  // all of it has left through the lower face and come back from above
  const auto [first, last] = run.body_ids("other");
  const std::vector<double> vz = field(run, "vz"), z = field(run, "z");
  for (std::size_t p = 0; p < vz.size(); ++p) {
    ASSERT_NEAR(vz[p], p >= first && p < last ? -8.0 : 0.0, 0.4) << p;
    ASSERT_LT(z[p], 1.65) << p;
  }
  EXPECT_LT(run.state().audit.residual, 1e-10);
}

TEST(VelocityConditions, ThatContradictEachOtherAreRefused) {
  const auto refusal = [](const std::string& text) -> std::string {
    try {
      scene(text);
    } catch (const mpm::Error& error) {
      return error.what();
    }
    return "no error";
  };
  const std::string oblique =
      block(fmt::format("  - {{name: a, {0}, direction: x, velocity: 1}}\n"
                        "  - {{name: b, {0}, direction: [1, 1], velocity: 1}}\n",
                        kAll));
  const std::string found = refusal(oblique);
  EXPECT_EQ(found.find("boundary.yaml:10: boundaries.conditions.b: condition 'b': at the node ("), 0u) << found;
  EXPECT_NE(found.find("that of condition 'a'; conditions on one node must be orthogonal"), std::string::npos) << found;
  std::string wall = block(
      "  - {name: a, region: {box: {min: [0.3, 0], max: [1.7, 1.7]}}, direction: [1, 1], velocity: "
      "1}\n");
  wall.replace(wall.find("boundaries:\n"), 12, "boundaries:\n  z_min: slip\n");
  wall.replace(wall.find("min: [0.6, 0.6]"), 15, "min: [0.6, 0.0]");
  EXPECT_NE(refusal(wall).find("neither along nor across the normal of the slip wall z_min"), std::string::npos)
      << refusal(wall);
}

}  // namespace boundary_conditions_test
}  // namespace verification
