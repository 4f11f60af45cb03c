// A plate and a rod are dragged sideways through level sand, upright and in it from the surface to a depth d: the force
// grows with the width and with the square of the depth, and does not depend on the speed while inertia is small,
// v^2 / (g d) below 0.01. A wide plate, in a plane, meets the passive pressure of the sand in front of it and is
// pressed by the active one of the sand behind it; sand below its edge gives a little more. A rod in space meets the
// wedge at its sides, too. Weak: sand heaps up in front. Cells count over the depth of the plate and over the width of
// the rod.
#include <fmt/format.h>

#include <cmath>

#include "mpm/math/constants.hpp"
#include "study/tool_force/problem.hpp"

namespace mpm::study::tool_force {
namespace drag_problems {

constexpr double kDepth = 0.2, kDensity = 1600.0, kGravity = 9.81, kYoung = 2e6, kPoisson = 0.3, kAngle = 30.0;
constexpr double kThickness = 0.4 * kDepth;  ///< thickness of the plate
constexpr double kRod = 0.1;                 ///< width of the rod, of which a half is modelled; it is twice as deep

std::string bed(const std::string& min, const std::string& max) {
  return fmt::format(
      "bodies:\n"
      "  - {{name: bed, material: soil, shape: {{box: {{min: {}, max: {}}}}}, cut_out: [tool], initial: geostatic}}\n",
      min, max);
}

std::string material(const Problem& problem, const Setup& setup) {
  return soil_material(problem.law_of(setup), kDensity, kYoung, kPoisson, kAngle, 0.0, 0.0);
}

std::string plate_scene(const Problem& problem, const Setup& setup) {
  const double h = kDepth / setup.cells;
  const auto cells = [&](double lengths) { return h * std::ceil(lengths * setup.cells); };
  const double left = -cells(2.0), right = cells(4.0), low = -cells(2.0);
  return fmt::format(
             "geometry: plane_strain\n"
             "gravity: [0, -{}]\n"
             "grid: {{cell: {:.17g}, min: [{:.17g}, {:.17g}], max: [{:.17g}, {:.17g}]}}\n"
             "{}\n"
             "materials:\n  - {}\n",
             kGravity, h, left, low, right, cells(1.0), time_section(problem, setup), material(problem, setup)) +
         bed(fmt::format("[{:.17g}, {:.17g}]", left, low), fmt::format("[{:.17g}, 0]", right)) +
         fmt::format(
             "rigid_bodies:\n"
             "  - name: tool\n"
             "    shape: {{polygon: {{points: [[0, 0], [0, {0}], [-{1}, {0}], [-{1}, 0]]}}}}\n"
             "    pose: {{position: [0, -{2}]}}\n"
             "    friction: 0\n"
             "    motion: {{velocity: [\"{3}\", 0]}}\n"
             "boundaries: {{x_min: slip, x_max: slip, z_min: fixed}}\n",
             1.8 * kDepth, kThickness, kDepth, speed_expression(problem));
}

std::string rod_scene(const Problem& problem, const Setup& setup) {
  const double h = kRod / setup.cells, depth = 2.0 * kRod;
  const auto cells = [&](double lengths) { return h * std::ceil(lengths * setup.cells); };
  const double left = -cells(3.0), right = cells(6.0), low = -cells(3.5), side = cells(4.0);
  return fmt::format(
             "geometry: solid\n"
             "gravity: [0, 0, -{}]\n"
             "grid: {{cell: {:.17g}, min: [{:.17g}, 0, {:.17g}], max: [{:.17g}, {:.17g}, {:.17g}]}}\n"
             "{}\n"
             "materials:\n  - {}\n",
             kGravity, h, left, low, right, side, cells(1.0), time_section(problem, setup), material(problem, setup)) +
         bed(fmt::format("[{:.17g}, 0, {:.17g}]", left, low), fmt::format("[{:.17g}, {:.17g}, 0]", right, side)) +
         fmt::format(
             "rigid_bodies:\n"
             "  - name: tool\n"
             "    shape: {{box: {{size: [{0}, {0}, {1}]}}}}\n"
             "    pose: {{position: [0, 0, {2}]}}\n"
             "    friction: 0\n"
             "    motion: {{velocity: [\"{3}\", 0, 0]}}\n"
             "boundaries: {{x_min: slip, x_max: slip, y_min: symmetry, y_max: slip, z_min: fixed}}\n",
             kRod, 1.8 * depth, 0.9 * depth - depth, speed_expression(problem));
}

Problem drag(const std::string& name, const std::string& title, double length) {
  Problem problem;
  problem.name = name;
  problem.title = title;
  problem.known = Known::estimate;
  problem.push = Vec3::UnitX();
  problem.length = length;
  problem.moves_on = true;
  problem.has_places = {true, true};
  problem.speed = 0.05;
  problem.ramp = 0.02;
  problem.wave_speed = elastic_wave(kDensity, kYoung, kPoisson);
  return problem;
}

}  // namespace drag_problems

std::vector<Problem> drags() {
  using namespace drag_problems;
  const double phi = kAngle * kPi / 180.0, passive = passive_coefficient(phi), active = active_coefficient(phi);
  const double unit = 0.5 * kDensity * kGravity;

  Problem plate = drag("drag_plate", "Plate dragged through sand", kDepth);
  plate.text =
      "Smooth upright plate, 0.4 d thick, in sand of 30° without dilation (1600 kg/m³, E = 2 MPa) to a depth d = 0.2 "
      "m, "
      "dragged at 0.05 m/s, v²/(gd) = 0.001. Cells: over the depth.";
  plate.answer = {unit * kDepth * kDepth * (passive_coefficient(davis_friction(phi, 0.0)) - active),
                  unit * kDepth * kDepth * passive};
  plate.answer_text =
      "½ρg d² a metre times, above, K_p = 3 alone; below, an estimate: K_p - K_a with K_p = 2.62 of Davis's (1968) "
      "reduced friction: Rankine (1857)";
  plate.from = 0.06;
  plate.to = 0.14;
  plate.pressed = {{0.0, 0.0, 0.0}, {0.5 * kDepth, 0.0, 0.5 * kDepth}};
  plate.scene = plate_scene;

  Problem rod = drag("drag_rod", "Rod dragged through sand, in space", kRod);
  const double force = unit * kRod * 4.0 * kRod * kRod;
  rod.text =
      "Smooth upright rod, 0.1 m square, in the same sand to a depth of twice its width, dragged at 0.05 m/s, v²/(gd) "
      "= "
      "0.001. Cells: over the width.";
  rod.answer = {force * (passive - active), 3.0 * force * passive};
  rod.answer_text =
      "½ρg w d² times, below, K_p - K_a of a plane; above, 3 K_p, which holds for slender rods: Broms (1964), J. Soil "
      "Mech. Found. Div. ASCE 90(3), 123-156";
  rod.whole = 2.0;
  rod.from = 0.12;
  rod.to = 0.28;
  rod.finest = 4.0;
  rod.pressed = {{0.5 * kRod, 0.0, -1.8 * kRod}, {kRod, 0.5 * kRod, -0.8 * kRod}};
  rod.scene = rod_scene;
  return {plate, rod};
}

}  // namespace mpm::study::tool_force
