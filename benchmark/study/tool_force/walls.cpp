// A smooth wall beside a level bed on a smooth floor, as deep as the bed: Rankine's pressures, passive of a wall that
// turns about its foot into the bed, active of one that moves away. Where the wall turns, the wedge above the plane at
// 45 - phi/2 shears uniformly, so the load is that of a wall that moves as a whole. The sand is stiff, for near the
// foot it hardly moves. Cells count over the depth.
//
// And a silo between two rough walls that move up slowly, so that the sand hangs on them: what each wall bears is
// Janssen's, from the ratio K of horizontal to vertical stress, which is not known beyond the range from the active
// state to that at rest. Half of it is modelled; cells count over its width.
#include <fmt/format.h>

#include <cmath>

#include "mpm/math/constants.hpp"
#include "study/tool_force/problem.hpp"

namespace mpm::study::tool_force {
namespace wall_problems {

constexpr double kDepth = 0.2, kDensity = 1600.0, kGravity = 9.81, kYoung = 20e6, kPoisson = 0.3, kAngle = 30.0;

/// The wall's origin is its line at the surface; `sense`: 1 into the bed, -1 away from it.
std::string wall_scene(const Problem& problem, const Setup& setup, bool turns, double sense) {
  const double d = kDepth, h = kDepth / setup.cells;
  const double right = h * std::ceil(4.0 * setup.cells), left = -h * std::ceil(setup.cells);
  const std::string speed = fmt::format("{:g} * {}", sense, speed_expression(problem));
  const std::string turning = turns ? fmt::format(", rotation_rate: \"{} / {}\"", speed, d) : "";
  return fmt::format(
      "geometry: plane_strain\n"
      "gravity: [0, -{}]\n"
      "grid: {{cell: {:.17g}, min: [{:.17g}, -{}], max: [{:.17g}, {}]}}\n"
      "{}\n"
      "materials:\n  - {}\n"
      "bodies:\n"
      "  - {{name: bed, material: soil, shape: {{box: {{min: [0, -{}], max: [{:.17g}, 0]}}}}, initial: geostatic}}\n"
      "rigid_bodies:\n"
      "  - name: tool\n"
      "    shape: {{polygon: {{points: [[0, -{}], [0, {}], [-{}, {}], [-{}, -{}]]}}}}\n"
      "    friction: 0\n"
      "    motion: {{velocity: [\"{}\", 0]{}}}\n"
      "boundaries: {{x_min: slip, x_max: slip, z_min: slip}}\n",
      kGravity, h, left, d, right, d, time_section(problem, setup),
      soil_material(problem.law_of(setup), kDensity, kYoung, kPoisson, kAngle, kAngle, 0.0), d, right, 2.0 * d, d,
      0.8 * d, d, 0.8 * d, 2.0 * d, speed, turning);
}

Problem wall(const std::string& name, const std::string& title, const std::string& text, bool turns, double sense) {
  Problem problem;
  problem.name = name;
  problem.title = title;
  problem.text =
      text +
      " Sand (friction 30°, associated flow, 1600 kg/m³, E = 20 MPa = 6400 ρgd) at rest, depth 0.2 m. Cells: over "
      "the depth.";
  problem.push = Vec3::UnitX();
  problem.has_places = {true, false};
  problem.length = kDepth;
  problem.speed = 0.02;
  problem.ramp = 0.02;
  problem.wave_speed = elastic_wave(kDensity, kYoung, kPoisson);
  problem.pressed = {{0.0, 0.0, -0.75 * kDepth}, {0.5 * kDepth, 0.0, -0.25 * kDepth}};
  problem.scene = [turns, sense](const Problem& own, const Setup& setup) {
    return wall_scene(own, setup, turns, sense);
  };
  return problem;
}

constexpr double kWidth = 0.2, kFill = 2.0 * kWidth, kWallFriction = 0.4, kSoftYoung = 2e6;

/// Half a silo beside a plane of symmetry, on a smooth floor. The wall's origin is at the floor.
std::string silo_scene(const Problem& problem, const Setup& setup) {
  const double h = kWidth / setup.cells, wall = 0.5 * kWidth, thick = 2.0 * h;
  return fmt::format(
      "geometry: plane_strain\n"
      "gravity: [0, -{}]\n"
      "grid: {{cell: {:.17g}, min: [0, 0], max: [{:.17g}, {:.17g}]}}\n"
      "{}\n"
      "materials:\n  - {}\n"
      "bodies:\n"
      "  - {{name: bed, material: soil, shape: {{box: {{min: [0, 0], max: [{}, {}]}}}}, initial: geostatic}}\n"
      "rigid_bodies:\n"
      "  - name: tool\n"
      "    shape: {{polygon: {{points: [[0, -{}], [{:.17g}, -{}], [{:.17g}, {}], [0, {}]]}}}}\n"
      "    pose: {{position: [{}, 0]}}\n"
      "    friction: {}\n"
      "    motion: {{velocity: [0, \"{}\"]}}\n"
      "boundaries: {{x_min: symmetry, z_min: slip}}\n",
      kGravity, h, wall + thick, 1.5 * kFill, time_section(problem, setup),
      soil_material(problem.law_of(setup), kDensity, kSoftYoung, kPoisson, kAngle, 0.0, 0.0), wall, kFill, kWidth,
      2.0 * thick, kWidth, 2.0 * thick, 2.0 * kFill, 2.0 * kFill, wall, kWallFriction, speed_expression(problem));
}

/// Friction on one wall: that of silo_wall_pressure() over the height of the fill [N/m].
double janssen(double ratio) {
  const double depth = 1.0 / (2.0 * kWallFriction * ratio);  // over the width, on which the pressure reaches its limit
  return 0.5 * kDensity * kGravity * kWidth * kWidth *
         (kFill / kWidth - depth * (1.0 - std::exp(-kFill / (kWidth * depth))));
}

Problem silo() {
  Problem problem;
  problem.name = "silo";
  problem.title = "Silo with a moving wall";
  problem.text =
      "Walls with friction 0.4, 0.2 m apart, move up slowly along sand of 30° without dilation (1600 kg/m³, E = 2 MPa) "
      "0.4 m high: the friction on one of them. Cells: over the width.";
  problem.known = Known::estimate;
  problem.answer = {janssen(active_coefficient(kAngle * kPi / 180.0)), janssen(1.0 - std::sin(kAngle * kPi / 180.0))};
  problem.answer_text =
      "Janssen (1895), with K from K_a = 1/3, Rankine's active state, to 1 - sin φ = 1/2, that at rest (Jáky (1944))";
  problem.push = Vec3::UnitZ();
  problem.length = kWidth;
  problem.from = 0.02;
  problem.to = 0.05;
  problem.speed = 0.02;
  problem.ramp = 0.02;
  problem.quick = true;
  problem.wave_speed = elastic_wave(kDensity, kSoftYoung, kPoisson);
  problem.pressed = {{-0.5 * kWidth, 0.0, 0.0}, {0.0, 0.0, 0.5 * kFill}};
  problem.scene = silo_scene;
  return problem;
}

}  // namespace wall_problems

std::vector<Problem> walls() {
  using namespace wall_problems;
  const double unit = 0.5 * kDensity * kGravity * kDepth * kDepth, phi = kAngle * kPi / 180.0;
  Problem turning = wall("wall_turns", "Wall that turns about its foot",
                         "Smooth wall that turns about its foot into the bed.", true, 1.0);
  turning.answer_text = "½ ρ g K_p d² a metre, K_p = 3: Rankine (1857); associated flow";
  turning.answer.lower = turning.answer.upper = unit * passive_coefficient(phi);
  turning.from = 0.04;
  turning.to = 0.06;
  Problem active =
      wall("wall_active", "Wall that moves away", "Smooth wall that moves away from the bed.", false, -1.0);
  active.answer_text = "½ ρ g K_a d² a metre, K_a = 1/3: Rankine (1857); associated flow";
  active.answer.lower = active.answer.upper = unit * active_coefficient(phi);
  active.from = 0.003;
  active.to = 0.0045;
  active.speed = 0.004;
  return {turning, active, silo()};
}

}  // namespace mpm::study::tool_force
