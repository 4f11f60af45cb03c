// A manufactured solution along the axes: in a unit bar, square or cube whose faces are held along their normals, a
// body force makes every particle follow
//   u_i = s_i A sin(pi X_i) sin(c pi t),  c = sqrt(E / rho0),  s = +1 along x and y, -1 along z.
// Signs are phases of 0 and pi, with which displacement and F begin at rest and only velocities are given. With
// F_i = 1 + s_i A pi cos(pi X_i) sin(c pi t), and 1 along axes without motion, J = prod F_i, I = sum F_i^2:
//   b_i = pi^2 u_i { K/(2 rho0) (J^2 + 1)/F_i^2 + G/rho0 J^(-2/3) [5 I/(9 F_i^2) - 1/3] - c^2 }.
// Source: exact-solutions 2, with the neo-Hookean energy of Nairn & Guilkey (2015) eq. (64); the kind of
// problem of Wallstedt & Guilkey (2008).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mpm/math/constants.hpp"
#include "study/lattice.hpp"
#include "study/measures.hpp"
#include "study/problems.hpp"

namespace mpm::study {
namespace manufactured_problem {

constexpr double kDensity = 1000.0, kYoung = 1000.0;  // so that c is 1 m/s
constexpr double kPeriod = 2.0;                       // period of sin(c pi t) [s]

constexpr Elasticity kElasticity = {kYoung, 0.3};

struct Problem {
  std::string name;
  GeometryKind geometry;
  double amplitude;  // A [m]

  double sign(int axis) const { return axis == 2 ? -1.0 : 1.0; }
};

/// F_i as an expression.
std::string stretch(const Problem& problem, int axis) {
  return fmt::format("(1{:+.17g}*cos({:.17g}*{})*sin({:.17g}*t))", problem.sign(axis) * problem.amplitude * kPi, kPi,
                     "XYZ"[axis], kPi);
}

/// b_i, with J^2/F_i^2 written as the square of the other stretches.
std::string acceleration(const Problem& problem, int axis) {
  const std::string own = stretch(problem, axis);
  std::string product = own, others = "1", squares;
  for (const int other : axes_of(problem.geometry)) {
    if (other == axis) continue;
    const std::string stretched = stretch(problem, other);
    product += "*" + stretched;
    others += "*" + stretched + "^2";
    squares += "+" + stretched + "^2";
  }
  const double unmoved = 3.0 - dimensions(problem.geometry);
  const double bulk = kElasticity.bulk() / kDensity, shear = kElasticity.shear() / kDensity;
  return fmt::format(
      "{:.17g}*sin({:.17g}*{})*sin({:.17g}*t)*({:.17g}*({}+1/{}^2)+{:.17g}*({})^(-2/3)*({:.17g}+{:.17g}*({:.17g}{})/"
      "{}^2)-1)",
      problem.sign(axis) * problem.amplitude * kPi * kPi, kPi, "XYZ"[axis], kPi, 0.5 * bulk, others, own, shear,
      product, 5.0 / 9.0 - 1.0 / 3.0, 5.0 / 9.0, unmoved, squares, own);
}

SimulationDefinition make_definition(const Problem& problem, const MethodDefinition& method,
                                     const Discretisation& discretisation) {
  const double cell = 1.0 / discretisation.cells;
  const Vec3 size = Vec3::Ones();
  SimulationDefinition d = empty_definition(problem.name, problem.geometry, method, discretisation, cell, Vec3::Zero(),
                                            size, kPeriod / 20.0, kPeriod);
  for (WallDefinition& wall : d.walls) wall.kind = WallKind::slip;
  add_block(d, {"rubber", kDensity, NeoHookeanDefinition{kElasticity}}, {Vec3::Zero(), size}, {}, [&](const Vec3& X) {
    Vec3 v = Vec3::Zero();
    for (const int axis : axes_of(problem.geometry)) {
      v[axis] = problem.sign(axis) * problem.amplitude * kPi * std::sin(kPi * X[axis]);
    }
    return v;
  });
  BodyForceDefinition force;
  for (const int axis : axes_of(problem.geometry)) {
    force.acceleration[axis] =
        Function::parse(acceleration(problem, axis), FunctionUnits(), FunctionPlaces::present_and_start);
  }
  d.body_forces = {force};
  return d;
}

}  // namespace manufactured_problem

Suite manufactured(const std::string& name, GeometryKind geometry, double amplitude) {
  using namespace manufactured_problem;
  const Problem problem = {name, geometry, amplitude};
  const int directions = dimensions(geometry);
  const char* body = directions == 1 ? "bar" : directions == 2 ? "square" : "cube";
  Suite suite;
  suite.name = name;
  const char* axes = directions == 1 ? "its axis" : "its axes";
  suite.title =
      fmt::format("A {} that is driven along {}, {} strain", body, axes, amplitude > 0.01 ? "large" : "small");
  suite.problem = fmt::format(
      "A unit {} between smooth walls is driven by a body force along {}, for one period of 2 s; the strain reaches "
      "{:.2g}. Neo-Hookean, E = 1000 Pa, 1000 kg/m³, Poisson's ratio {}. Cells: along an edge.",
      body, axes, amplitude * kPi, kElasticity.poisson);
  suite.exact = fmt::format(
      "u = ± {} sin(πX) sin(πt) along each axis; the body force follows from ρ₀ü = Div P + ρ₀b, as in the problems of "
      "Wallstedt and Guilkey (2008)",
      amplitude);
  suite.measure_text = "largest RMS displacement error of the period over the amplitude";
  suite.geometry = geometry;
  suite.costly = directions == 3 || (directions == 2 && amplitude < 0.01);
  suite.definition = [problem](const MethodDefinition& method, const Discretisation& discretisation) {
    return make_definition(problem, method, discretisation);
  };
  suite.motion = [problem](double time, const Vec3& start) {
    Vec3 place = start;
    for (const int axis : axes_of(problem.geometry)) {
      place[axis] += problem.sign(axis) * problem.amplitude * std::sin(kPi * start[axis]) * std::sin(kPi * time);
    }
    return place;
  };
  // Over the RMS of directions as well: an error of the amplitude in each direction is 1.
  suite.measure = [geometry, motion = suite.motion, length = amplitude * std::sqrt(directions)] {
    return displacement_error(geometry, motion, length);
  };
  suite.quick = directions == 1   ? grids({8, 16, 32, 64}, 16)
                : directions == 2 ? grids({8, 16, 32}, 16)
                                  : std::vector<Discretisation>{{4}, {6}, {8}, {10}, {8, 0.8}};
  suite.full = directions == 1   ? grids({8, 16, 32, 64, 128, 256}, 32)
               : directions == 2 ? grids({8, 16, 32, 64}, 16)
                                 : grids({4, 8, 16}, 8);
  return suite;
}

}  // namespace mpm::study
