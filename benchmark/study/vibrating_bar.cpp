// A bar, held at x = 0 and free at x = L, vibrates in its first axial mode:
//   u = v0 / (beta c) sin(beta X) sin(beta c t),  beta = pi / 2L,  c = sqrt(E / rho).
// Poisson's ratio 0, so that uniaxial strain is the same as a bar. Exact for small strain, whose amplitude is v0 / c.
// Source: exact-solutions 1 (it solves rho u_tt = E u_xx).
#include <cmath>

#include "mpm/math/constants.hpp"
#include "study/lattice.hpp"
#include "study/measures.hpp"
#include "study/problems.hpp"

namespace mpm::study {
namespace vibrating_bar_problem {

constexpr double kLength = 1.0, kSpeed = 1.0, kDensity = 1000.0;  // L [m], c [m/s], rho [kg/m^3]
constexpr double kVelocity = 1e-4 * kSpeed;                       // v0
constexpr double kBeta = kPi / (2.0 * kLength);
constexpr double kAmplitude = kVelocity / (kBeta * kSpeed);
constexpr double kPeriod = 4.0 * kLength / kSpeed;
constexpr GeometryKind kGeometry = GeometryKind::line;

SimulationDefinition definition(const MethodDefinition& method, const Discretisation& discretisation) {
  const double cell = kLength / discretisation.cells;
  SimulationDefinition d = empty_definition("bar_small", kGeometry, method, discretisation, cell, Vec3::Zero(),
                                            {1.25 * kLength, 0.0, 0.0}, kPeriod / 40.0, 2.0 * kPeriod);
  d.walls[0].kind = WallKind::slip;
  const MaterialDefinition material = {"spring", kDensity, LinearElasticDefinition{{kDensity * kSpeed * kSpeed, 0.0}}};
  add_block(d, material, {Vec3::Zero(), {kLength, 0.0, 0.0}}, {},
            [](const Vec3& X) { return Vec3(kVelocity * std::sin(kBeta * X.x()), 0.0, 0.0); });
  return d;
}

Vec3 motion(double time, const Vec3& start) {
  return start + Vec3(kAmplitude * std::sin(kBeta * start.x()) * std::sin(kBeta * kSpeed * time), 0.0, 0.0);
}

}  // namespace vibrating_bar_problem

Suite vibrating_bar() {
  using namespace vibrating_bar_problem;
  Suite suite;
  suite.name = "bar_small";
  suite.title = "A bar that vibrates freely";
  suite.problem =
      "A bar of 1 m, held at one end, vibrates in its first axial mode for two periods at a strain of 1e-4. Linear "
      "elastic, E = 1000 Pa, 1000 kg/m³, Poisson's ratio 0. Cells: along the bar.";
  suite.exact = "u = v0/(βc) sin(βX) sin(βct), β = π/2L, c = √(E/ρ): the wave equation";
  suite.measure_text = "largest RMS displacement error of two periods over the amplitude at the tip";
  suite.geometry = kGeometry;
  suite.definition = definition;
  suite.motion = motion;
  suite.measure = [] { return displacement_error(kGeometry, motion, kAmplitude); };
  suite.quick = grids({8, 16, 32, 64}, 16);
  suite.full = grids({8, 16, 32, 64, 128, 256}, 32);
  return suite;
}

}  // namespace mpm::study
