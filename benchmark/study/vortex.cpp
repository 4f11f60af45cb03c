// Generalised vortex: the points of a ring 0.75 m <= R <= 1.25 m turn about its axis by
//   alpha(R, t) = A g(t) h(R),  h = (1 - 16 D^2)^2 with D = R - 1 m,  g = (1 - cos 2 pi t) / 2,
// so that r = R, J = 1, and the ring is sheared by up to R |d alpha / dR|. Components along the turned directions:
//   b_R = -R alpha_t^2 + G/rho0 [R alpha'^2 + 2/3 R alpha' (alpha' + R alpha'')],
//   b_theta = R alpha_tt - G/rho0 (3 alpha' + R alpha''),
// a dash for d/dR. At both rims h = h' = 0: the material around the ring stays at rest without stress, and is there so
// that no free surface limits the error. Source: exact-solutions 3, with the neo-Hookean energy of Nairn & Guilkey
// (2015) eq. (64); the problem is that of Kamojjala et al. (2015).
#include <fmt/format.h>

#include <cmath>

#include "mpm/math/constants.hpp"
#include "study/lattice.hpp"
#include "study/measures.hpp"
#include "study/problems.hpp"

namespace mpm::study {
namespace vortex_problem {

constexpr double kDensity = 1000.0;
constexpr Elasticity kElasticity = {1000.0, 0.3};
constexpr double kInner = 0.625, kOuter = 1.375;  // radii of the body, around the ring [m]
constexpr double kEnd = 1.0;                      // one turn there and back [s]

double angle(double turn, double time, double R) {
  const double D = R - 1.0;
  if (std::abs(D) > 0.25) return 0.0;
  return turn * 0.5 * (1.0 - std::cos(2.0 * kPi * time)) * std::pow(1.0 - 16.0 * D * D, 2);
}

// muParser has no local names, so that the expression is put together from parts in brackets.
struct Parts {
  std::string R = "sqrt(X^2+Z^2)";
  std::string along, across;  // b_R and b_theta
  std::string alpha;

  explicit Parts(double turn) {
    const std::string q = "(1-16*(" + R + "-1)^2)", D = "(" + R + "-1)";
    const double shear = kElasticity.shear() / kDensity, w = 2.0 * kPi;
    const std::string g = fmt::format("({:.17g}*(1-cos({:.17g}*t)))", 0.5 * turn, w);
    const std::string rate = fmt::format("({:.17g}*sin({:.17g}*t))", 0.5 * turn * w, w);
    const std::string second = fmt::format("({:.17g}*cos({:.17g}*t))", 0.5 * turn * w * w, w);
    alpha = "(" + g + "*" + q + "^2)";
    // R alpha' = a, R alpha'' = c: h' = -64 D (1 - 16 D^2), h'' = -64 (1 - 48 D^2).
    const std::string slope = "(" + g + "*(-64)*" + D + "*" + q + ")";
    const std::string curve = "(" + g + "*(-64)*" + R + "*(1-48*" + D + "^2))";
    along = fmt::format("(-{0}*({1}*{2}^2)^2+{3:.17g}*{0}*{4}*({4}*{5:.17g}+{6:.17g}*{7}))", R, rate, q, shear, slope,
                        5.0 / 3.0, 2.0 / 3.0, curve);
    across = fmt::format("({0}*{1}*{2}^2-{3:.17g}*(3*{4}+{5}))", R, second, q, shear, slope, curve);
  }
  // b_R cos - b_theta sin of Theta + alpha, with cos Theta = first/R, sin Theta = other/R; along z, a quarter turn on.
  std::string component(const char* first, const char* other) const {
    const std::string cosine = fmt::format("({0}*cos({2})-({1})*sin({2}))", first, other, alpha);
    const std::string sine = fmt::format("(({1})*cos({2})+{0}*sin({2}))", first, other, alpha);
    return fmt::format("abs({0}-1)<0.25 ? ({1}*{2}-{3}*{4})/{0} : 0", R, along, cosine, across, sine);
  }
  std::string x() const { return component("X", "Z"); }
  std::string z() const { return component("Z", "-X"); }
};

SimulationDefinition make_definition(const std::string& name, double turn, const MethodDefinition& method,
                                     const Discretisation& discretisation) {
  const double edge = 1.5;
  SimulationDefinition d =
      empty_definition(name, GeometryKind::plane_strain, method, discretisation, 1.0 / discretisation.cells,
                       {-edge, 0.0, -edge}, {edge, 0.0, edge}, kEnd / 40.0, kEnd);
  add_block(d, {"rubber", kDensity, NeoHookeanDefinition{kElasticity}}, {d.grid.min, d.grid.max},
            [](const Vec3& X) { return X.norm() > kInner && X.norm() < kOuter; });
  const Parts parts(turn);
  BodyForceDefinition force;
  force.acceleration[0] = Function::parse(parts.x(), FunctionUnits(), FunctionPlaces::present_and_start);
  force.acceleration[2] = Function::parse(parts.z(), FunctionUnits(), FunctionPlaces::present_and_start);
  d.body_forces = {force};
  return d;
}

}  // namespace vortex_problem

Suite vortex(const std::string& name, double turn) {
  using namespace vortex_problem;
  Suite suite;
  suite.name = name;
  suite.title = "Generalised vortex";
  suite.problem = fmt::format(
      "The middle of a ring turns by {} rad and back in 1 s, its rims stay: shear of up to {:.2g}, without change of "
      "volume. Neo-Hookean, E = 1000 Pa, 1000 kg/m³, Poisson's ratio 0.3, plane strain. Cells: a metre, which is two "
      "widths of the ring.",
      turn, 6.16 * turn);
  suite.exact =
      "every point turns about the axis by α = A (1 - cos 2πt)/2 (1 - 16(R - 1)²)²; the body force follows from "
      "ρ₀ü = Div P + ρ₀b (Kamojjala et al. 2015)";
  suite.measure_text = "largest RMS displacement error of the turn over the way of the ring's middle";
  suite.geometry = GeometryKind::plane_strain;
  suite.costly = true;
  suite.definition = [name, turn](const MethodDefinition& method, const Discretisation& discretisation) {
    return make_definition(name, turn, method, discretisation);
  };
  suite.motion = [turn](double time, const Vec3& start) {
    const double alpha = angle(turn, time, start.norm()), c = std::cos(alpha), s = std::sin(alpha);
    return Vec3(c * start.x() - s * start.z(), 0.0, s * start.x() + c * start.z());
  };
  suite.measure = [motion = suite.motion, turn] {
    return displacement_error(GeometryKind::plane_strain, motion, 2.0 * std::sin(0.5 * turn));
  };
  suite.quick = {{8}, {12}, {16}, {20}, {16, 0.8}};
  suite.full = grids({8, 16, 32, 48}, 16);
  return suite;
}

}  // namespace mpm::study
