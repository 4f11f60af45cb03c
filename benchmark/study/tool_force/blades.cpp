// A blade cuts level sand, in a plane: its front is upright and its edge lies at a depth d; behind it the bed is cut
// down to the edge. What is exact for an associated soil at the start is Rankine's passive pressure on the front,
// 1/2 rho g K_p d^2: the wedge above the plane that rises from the edge at 45 - phi/2 moves as a block, and the
// stresses of that wedge go on below it. With the travel x the soil that the blade has swept, d x, adds its weight to
// the wedge's: the force grows by the part swept_soil_growth() x / d, 11.5 % of a smooth blade on the stretch of the
// mean. Under a smooth blade nothing is lifted but what little the sand below the edge presses on the bottom.
//
// flat: the bottom is level and 0.8 d long. chisel: the bottom rises from the edge backwards at 15 degrees, so that it
// need not touch. Cells count over d.
#include <fmt/format.h>

#include <cmath>

#include "mpm/math/constants.hpp"
#include "study/tool_force/problem.hpp"

namespace mpm::study::tool_force {
namespace blade_problems {

constexpr double kDepth = 0.2, kDensity = 1600.0, kGravity = 9.81, kYoung = 2e6, kPoisson = 0.3, kAngle = 30.0;
constexpr double kThickness = 0.8 * kDepth, kTop = 1.5 * kDepth, kRise = 0.267949192431123;  // tan(15 degrees)

constexpr double kMean = 0.1;  ///< travel over depth, in the mean over the stretch on which force is taken

constexpr double kHalfWidth = kDepth;  ///< half the width of the blade in space, of which a half is modelled

struct Kind {
  bool chisel = false, rough = false;
  double dilation = kAngle;  ///< [deg]
  bool solid = false;        ///< in space: a level bottom, and ends
};

/// Text of a vector: of a plane without y.
std::string at(bool solid, double x, double y, double z) {
  return solid ? fmt::format("[{:.17g}, {:.17g}, {:.17g}]", x, y, z) : fmt::format("[{:.17g}, {:.17g}]", x, z);
}

std::string tool_section(const Problem& problem, const Kind& kind) {
  const double thick = kThickness, height = kTop + kDepth, back = kind.chisel ? kRise * kThickness : 0.0;
  const std::string shape =
      kind.solid
          ? fmt::format("box: {{size: [{}, {}, {}]}}", thick, 2.0 * kHalfWidth, height)
          : fmt::format("polygon: {{points: [[0, 0], [0, {0}], [-{1}, {0}], [-{1}, {2:.17g}]]}}", height, thick, back);
  // The origin is the edge; of a box its middle.
  const std::string place =
      kind.solid ? at(true, -0.5 * thick, 0.0, 0.5 * height - kDepth) : at(false, 0.0, 0.0, -kDepth);
  return fmt::format(
      "rigid_bodies:\n"
      "  - name: tool\n"
      "    shape: {{{}}}\n"
      "    pose: {{position: {}}}\n"
      "    friction: {:.17g}\n"
      "    motion: {{velocity: [\"{}\"{}, 0]}}\n",
      shape, place, kind.rough ? std::tan(kAngle * kPi / 180.0) : 0.0, speed_expression(problem),
      kind.solid ? ", 0" : "");
}

std::string blade_scene(const Problem& problem, const Setup& setup, const Kind& kind) {
  const double h = kDepth / setup.cells;
  const auto cells = [&](double lengths) { return h * std::ceil(lengths * setup.cells); };
  const double low = -cells(2.0), left = -cells(1.5), right = cells(4.0), side = cells(3.0), high = cells(1.5);
  const bool solid = kind.solid;
  return fmt::format(
             "geometry: {}\n"
             "gravity: {}\n"
             "grid: {{cell: {:.17g}, min: {}, max: {}}}\n"
             "{}\n"
             "materials:\n  - {}\n"
             "bodies:\n"
             "  - {{name: bed, material: soil, shape: {{box: {{min: {}, max: {}}}}}, initial: geostatic}}\n"
             "  - {{name: cut, material: soil, shape: {{box: {{min: {}, max: {}}}}}, initial: geostatic}}\n",
             solid ? "solid" : "plane_strain", at(solid, 0.0, 0.0, -kGravity), h, at(solid, left, 0.0, low),
             at(solid, right, side, high), time_section(problem, setup),
             soil_material(problem.law_of(setup), kDensity, kYoung, kPoisson, kAngle, kind.dilation, 0.0),
             at(solid, 0.0, 0.0, low), at(solid, right, side, 0.0), at(solid, left, 0.0, low),
             at(solid, 0.0, side, -kDepth)) +
         tool_section(problem, kind) +
         fmt::format("boundaries: {{x_min: slip, x_max: slip, {}z_min: fixed}}\n",
                     solid ? "y_min: symmetry, y_max: slip, " : "");
}

Problem blade(const std::string& name, const std::string& title, const std::string& text, const Kind& kind) {
  Problem problem;
  problem.name = name;
  problem.title = title;
  problem.text = text +
                 " Sand (friction 30 degrees, 1600 kg/m³, E = 2 MPa = 640 ρgd) at rest, depth 0.2 m, 0.05 m/s = 0.04 "
                 "√(gd). Cells: over the depth.";
  problem.push = Vec3::UnitX();
  problem.length = kDepth;
  problem.from = 0.6 * kMean;
  problem.to = 1.4 * kMean;
  problem.moves_on = true;
  problem.quick = true;
  problem.has_places = {true, true};
  problem.speed = 0.05;
  problem.ramp = 0.02;
  problem.wave_speed = elastic_wave(kDensity, kYoung, kPoisson);
  problem.scene = [kind](const Problem& own, const Setup& setup) { return blade_scene(own, setup, kind); };
  problem.pressed = {{0.0, 0.0, 0.0}, {0.5 * kDepth, 0.0, 0.5 * kDepth}};
  return problem;
}

}  // namespace blade_problems

std::vector<Problem> blades() {
  using namespace blade_problems;
  const double unit = 0.5 * kDensity * kGravity * kDepth * kDepth, phi = kAngle * kPi / 180.0;
  // In the mean over the stretch.
  const auto swept = [](double friction, bool is_rough) { return 1.0 + kMean * swept_soil_growth(friction, is_rough); };
  const double start = unit * passive_coefficient(phi), rankine = start * swept(phi, false);
  const char* exact =
      "½ ρ g K_p d² a metre, K_p = 3: Rankine (1857), and the weight of the swept soil, +11.5 %; associated flow";
  std::vector<Problem> list;

  Problem flat =
      blade("blade_flat", "Smooth blade, level bottom", "Smooth blade with a level bottom, associated flow.", {});
  flat.answer_text = exact;
  flat.answer = {rankine, rankine};
  flat.free = Vec3::UnitZ();
  list.push_back(flat);

  Problem chisel = blade("blade_chisel", "Smooth blade, chisel edge",
                         "Smooth blade with a bottom that rises behind the edge, associated flow.", {true});
  chisel.answer_text = exact;
  chisel.answer = {rankine, rankine};
  chisel.free = Vec3::UnitZ();
  list.push_back(chisel);

  Problem still = blade("blade_flat_0", "Smooth blade in sand without dilation",
                        "Smooth blade with a level bottom, sand without dilation.", {false, false, 0.0});
  still.known = Known::estimate;
  still.answer_text =
      "above, K_p = 3 of associated flow (Radenkovic (1961)); below, an estimate: K_p = 2.62 of Davis's (1968) reduced "
      "friction; both with the weight of the swept soil, +11.5 % and +12.4 %";
  const double reduced = davis_friction(phi, 0.0);
  still.answer = {unit * passive_coefficient(reduced) * swept(reduced, false), rankine};
  still.free = Vec3::UnitZ();
  list.push_back(still);

  Problem rough =
      blade("blade_rough", "Blade as rough as the sand",
            "Blade with a bottom that rises behind the edge, as rough as the sand, associated flow.", {true, true});
  rough.known = Known::bounds;
  rough.answer_text = fmt::format(
      "along the push: K_p between 5.03 (Lancellotta (2002)) and 6.00 (log spiral, Terzaghi (1943)); tables "
      "of Kérisel and Absi: 6.5 cos 30° = 5.6; with the weight of the swept soil, {:+.1f} %",
      100.0 * (swept(phi, true) - 1.0));
  const Bounds coefficient = rough_wall_coefficient(phi);
  rough.answer = {unit * coefficient.lower * swept(phi, true), unit * coefficient.upper * swept(phi, true)};
  list.push_back(rough);

  Kind in_space;
  in_space.solid = true;
  Problem ends =
      blade("blade_3d", "Smooth blade with ends, in space",
            "Smooth blade of twice its depth in width, with a level bottom, associated flow, in space.", in_space);
  // Ovesen's factor of an anchor at the surface, of breadth over height 2.
  const double difference = passive_coefficient(phi) - active_coefficient(phi);
  const double factor = 1.0 + std::cbrt(difference * difference) * 1.6 / (1.0 + 5.0 * 2.0 * kHalfWidth / kDepth);
  ends.known = Known::estimate;
  ends.answer_text = fmt::format(
      "below, the force of a plane at the start, K_p = 3; above, an estimate: {:.2f} times that, for the wedges at the "
      "ends (Ovesen (1964), Anchor slabs, Danish Geotechnical Institute, Bulletin 16), and the weight of the swept "
      "soil, of which a part goes round the ends",
      factor);
  ends.answer = {start * 2.0 * kHalfWidth, rankine * 2.0 * kHalfWidth * factor};
  ends.whole = 2.0;
  ends.free = Vec3::UnitZ();
  ends.quick = false;
  ends.finest = 8.0;
  ends.pressed = {{0.5 * kThickness, 0.0, -0.5 * (kTop + kDepth)},
                  {0.5 * kThickness + 0.5 * kDepth, 0.5 * kHalfWidth, -0.5 * (kTop + kDepth) + 0.5 * kDepth}};
  list.push_back(ends);
  return list;
}

}  // namespace mpm::study::tool_force
