// A square turns as a rigid body through a quarter turn: x = Q(w t) X. The body force b = -w^2 Q X is what keeps it on
// its way, so that stress is zero, and what a method makes up in stress or loses in spin shows in the motion.
// Source: exact-solutions 4 with U = I: b = F'' X for any law.
#include <fmt/format.h>

#include <cmath>

#include "mpm/math/constants.hpp"
#include "study/lattice.hpp"
#include "study/measures.hpp"
#include "study/problems.hpp"

namespace mpm::study {
namespace rotation_problem {

constexpr double kDensity = 1000.0, kSpin = 0.2;  // w [rad/s]; a corner moves at a quarter of the wave speed
constexpr double kHalf = 1.0, kEnd = 0.5 * kPi / kSpin;

SimulationDefinition definition(const MethodDefinition& method, const Discretisation& discretisation) {
  const double edge = 1.75 * kHalf;
  SimulationDefinition d =
      empty_definition("rotation", GeometryKind::plane_strain, method, discretisation,
                       2.0 * kHalf / discretisation.cells, {-edge, 0.0, -edge}, {edge, 0.0, edge}, kEnd / 20.0, kEnd);
  add_block(d, {"rubber", kDensity, NeoHookeanDefinition{{1000.0, 0.3}}}, {{-kHalf, 0.0, -kHalf}, {kHalf, 0.0, kHalf}},
            {}, [](const Vec3& X) { return Vec3(-kSpin * X.z(), 0.0, kSpin * X.x()); });
  const auto parse = [](const char* expression) {
    return Function::parse(fmt::format(expression, kSpin * kSpin, kSpin), FunctionUnits(),
                           FunctionPlaces::present_and_start);
  };
  BodyForceDefinition force;
  force.acceleration[0] = parse("-{0:.17g}*(cos({1:.17g}*t)*X-sin({1:.17g}*t)*Z)");
  force.acceleration[2] = parse("-{0:.17g}*(sin({1:.17g}*t)*X+cos({1:.17g}*t)*Z)");
  d.body_forces = {force};
  return d;
}

Vec3 motion(double time, const Vec3& start) {
  const double c = std::cos(kSpin * time), s = std::sin(kSpin * time);
  return {c * start.x() - s * start.z(), 0.0, s * start.x() + c * start.z()};
}

}  // namespace rotation_problem

Suite rotation() {
  using namespace rotation_problem;
  Suite suite;
  suite.name = "rotation";
  suite.title = "A quarter turn";
  suite.problem =
      "A square of 2 m turns by 90 degrees as a rigid body, held on its way by a body force. Neo-Hookean, E = 1000 Pa, "
      "1000 kg/m³, Poisson's ratio 0.3, plane strain. Cells: along an edge.";
  suite.exact = "x = Q(ωt)X without any stress; b = -ω²x";
  suite.measure_text = "largest RMS displacement error of the quarter turn over half an edge";
  suite.geometry = GeometryKind::plane_strain;
  suite.definition = definition;
  suite.motion = motion;
  suite.measure = [] { return displacement_error(GeometryKind::plane_strain, motion, kHalf); };
  suite.quick = grids({8, 16, 32}, 16);
  suite.full = grids({8, 16, 32, 64}, 16);
  return suite;
}

}  // namespace mpm::study
