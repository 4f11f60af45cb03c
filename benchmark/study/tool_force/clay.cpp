// Tools in weightless clay (friction 0), in a plane: a long cylinder that is pressed sideways through clay without end,
// and a smooth wedge that is pressed into its surface. Half of each is modelled beside a plane of symmetry. The clay
// around the cylinder starts under a pressure of 20 c, so that none parts from it behind. Cells count over the
// diameter, and over the depth that the wedge reaches.
//
// And a smooth cone with a smooth shaft, about its axis, three diameters deep at the start. Estimates of its force come
// from the pressure that opens a spherical cavity, 4/3 (1 + ln(G/c)) c.
#include <fmt/format.h>

#include <cmath>

#include "mpm/math/constants.hpp"
#include "study/tool_force/problem.hpp"

namespace mpm::study::tool_force {
namespace clay_problems {

constexpr double kLength = 0.2, kDensity = 1600.0, kYoung = 10e6, kPoisson = 0.3, kCohesion = 10e3;
constexpr double kPressure = 20.0 * kCohesion, kHalfAngle = kPi / 6.0;

std::string clay(const Problem& problem, const Setup& setup) {
  return soil_material(problem.law_of(setup), kDensity, kYoung, kPoisson, 0.0, 0.0, kCohesion);
}

std::string pile_scene(const Problem& problem, const Setup& setup, bool rough) {
  const double h = kLength / setup.cells, reach = h * std::ceil(3.0 * setup.cells);
  return fmt::format(
      "geometry: plane_strain\n"
      "grid: {{cell: {0:.17g}, min: [-{1:.17g}, 0], max: [{1:.17g}, {1:.17g}]}}\n"
      "{2}\n"
      "materials:\n  - {3}\n"
      "bodies:\n"
      "  - {{name: bed, material: soil, shape: {{box: {{min: [-{1:.17g}, 0], max: [{1:.17g}, {1:.17g}]}}}}, "
      "cut_out: [tool], initial: {{stress: {{xx: -{4:g}, yy: -{4:g}, zz: -{4:g}}}}}}}\n"
      "rigid_bodies:\n"
      "  - name: tool\n"
      "    shape: {{cylinder: {{radius: {5}}}}}\n"
      "    friction: {6}\n"
      "    motion: {{velocity: [\"{7}\", 0]}}\n"
      "boundaries: {{x_min: slip, x_max: slip, z_min: symmetry, z_max: slip}}\n",
      h, reach, time_section(problem, setup), clay(problem, setup), kPressure, 0.5 * kLength, rough ? "stick" : "0",
      speed_expression(problem));
}

std::string wedge_scene(const Problem& problem, const Setup& setup) {
  const double h = kLength / setup.cells, slope = std::tan(kHalfAngle), height = 3.0 * kLength;
  const double right = h * std::ceil(5.0 * setup.cells), low = -h * std::ceil(4.0 * setup.cells);
  return fmt::format(
      "geometry: plane_strain\n"
      "grid: {{cell: {:.17g}, min: [0, {:.17g}], max: [{:.17g}, {:.17g}]}}\n"
      "{}\n"
      "materials:\n  - {}\n"
      "bodies:\n  - {{name: bed, material: soil, shape: {{box: {{min: [0, {:.17g}], max: [{:.17g}, 0]}}}}}}\n"
      "rigid_bodies:\n"
      "  - name: tool\n"
      "    shape: {{polygon: {{points: [[0, 0], [{:.17g}, {}], [-{:.17g}, {}]]}}}}\n"
      "    friction: 0\n"
      "    motion: {{velocity: [0, \"-{}\"]}}\n"
      "boundaries: {{x_min: symmetry, x_max: slip, z_min: fixed}}\n",
      h, low, right, h * std::ceil(setup.cells), time_section(problem, setup), clay(problem, setup), low, right,
      slope * height, height, slope * height, height, speed_expression(problem));
}

Problem tool(const std::string& name, const std::string& title) {
  Problem problem;
  problem.name = name;
  problem.title = title;
  problem.whole = 2.0;
  problem.length = kLength;
  problem.wave_speed = elastic_wave(kDensity, kYoung, kPoisson);
  return problem;
}

Problem pile(bool rough) {
  Problem problem = tool(rough ? "pile" : "pile_smooth", rough ? "Rough pile in clay" : "Smooth pile in clay");
  problem.text =
      std::string(rough ? "Rough" : "Smooth") +
      " cylinder pressed sideways through weightless clay, E = 1000 c, diameter 0.2 m, 0.05 m/s. Cells: over "
      "the diameter.";
  const double exact = lateral_pile_factor(rough ? 1.0 : 0.0) * kCohesion * kLength;
  problem.answer = {exact, exact};
  problem.answer_text = "11.94 c D a metre: Randolph and Houlsby (1984)";
  if (!rough) {
    problem.known = Known::bounds;
    problem.answer.upper = exact * 9.20 / 9.14;
    problem.answer_text =
        "between 9.14 (Randolph and Houlsby (1984)) and 9.20 c D (Martin and Randolph (2006)) a metre";
  }
  problem.push = Vec3::UnitX();
  problem.has_places = {true, false};
  problem.from = 0.08;
  problem.to = 0.14;
  problem.moves_on = true;
  problem.speed = 0.05;
  problem.ramp = 0.02;
  problem.pressed = {{0.5 * kLength, 0.0, 0.0}, {kLength, 0.0, 0.5 * kLength}};
  problem.scene = [rough](const Problem& own, const Setup& setup) { return pile_scene(own, setup, rough); };
  return problem;
}

Problem wedge() {
  Problem problem = tool("wedge", "Smooth wedge pressed into clay");
  problem.text =
      "Smooth wedge of 60° pressed into weightless clay to a depth of 0.2 m, E = 1000 c, 0.3 m/s. Cells: over that "
      "depth.";
  const WedgeIndentation exact = wedge_indentation(kHalfAngle);
  problem.answer.lower = problem.answer.upper = exact.force * kCohesion * kLength;
  problem.answer_text =
      fmt::format("{:.2f} c a metre of depth and of length, rigid-plastic: Hill, Lee and Tupper (1947)", exact.force);
  problem.push = -Vec3::UnitZ();
  problem.has_places = {false, true};
  problem.grows = true;
  problem.from = 0.6;
  problem.to = 1.0;
  problem.speed = 0.3;
  problem.ramp = 0.02;
  problem.pressed = {{0.0, 0.0, -0.5 * kLength}, {0.5 * kLength, 0.0, 0.0}};
  problem.scene = wedge_scene;
  return problem;
}

constexpr double kConeYoung = 200.0 * kCohesion;

std::string cone_scene(const Problem& problem, const Setup& setup) {
  const double h = kLength / setup.cells, right = h * std::ceil(4.0 * setup.cells),
               low = -h * std::ceil(7.0 * setup.cells);
  return fmt::format(
      "geometry: axisymmetric\n"
      "grid: {{cell: {:.17g}, min: [0, {:.17g}], max: [{:.17g}, {:.17g}]}}\n"
      "{}\n"
      "materials:\n  - {}\n"
      "bodies:\n"
      "  - {{name: bed, material: soil, shape: {{box: {{min: [0, {:.17g}], max: [{:.17g}, 0]}}}}, cut_out: [tool]}}\n"
      "rigid_bodies:\n"
      "  - name: tool\n"
      "    shape: {{cone: {{radius: {}, angle: 60 deg, shaft: {}}}}}\n"
      "    pose: {{position: [0, -{}]}}\n"
      "    friction: 0\n"
      "    motion: {{velocity: [0, \"-{}\"]}}\n"
      "boundaries: {{x_max: slip, z_min: fixed}}\n",
      h, low, right, h * std::ceil(setup.cells), time_section(problem, setup),
      soil_material(problem.law_of(setup), kDensity, kConeYoung, kPoisson, 0.0, 0.0, kCohesion), low, right,
      0.5 * kLength, 6.0 * kLength, 3.0 * kLength, speed_expression(problem));
}

Problem cone() {
  Problem problem = tool("cone_clay", "Smooth cone in clay");
  problem.text =
      "Smooth cone of 60°, 0.2 m wide, with a smooth shaft, pressed on at 0.3 m/s from a depth of three diameters in "
      "weightless clay of Tresca's law, E = 200 c. Cells: over the diameter.";
  problem.known = Known::estimate;
  const double area = 0.25 * kPi * kLength * kLength, stiffness = 200.0 / (2.0 * (1.0 + kPoisson));
  const double cavity = 4.0 / 3.0 * (1.0 + std::log(stiffness));
  problem.answer = {cavity * kCohesion * area, (cavity + 2.57) * kCohesion * area};
  problem.answer_text = fmt::format(
      "estimates between {:.2f} c, the pressure that opens a sphere (Bishop, Hill and Mott (1945)), and {:.2f} c, 2.57 "
      "c "
      "more (Vesic (1977))",
      cavity, cavity + 2.57);
  problem.whole = 1.0;
  problem.wave_speed = elastic_wave(kDensity, kConeYoung, kPoisson);
  problem.law = "mohr_coulomb";
  problem.push = -Vec3::UnitZ();
  problem.has_places = {false, true};
  problem.from = 0.3;
  problem.to = 0.6;
  problem.moves_on = true;
  problem.speed = 0.3;
  problem.ramp = 0.02;
  problem.finest = 16.0;
  problem.pressed = {{0.0, 0.0, -0.5 * kLength}, {0.5 * kLength, 0.0, 0.0}};
  problem.scene = cone_scene;
  return problem;
}

}  // namespace clay_problems

std::vector<Problem> clay_tools() {
  using namespace clay_problems;
  return {pile(true), pile(false), wedge(), cone()};
}

}  // namespace mpm::study::tool_force
