// A rigid strip is pressed slowly into weightless material, in a plane; half of it is modelled, x = 0 is a plane of
// symmetry. With associated flow the limit load is exact, smooth or rough: (2 + pi) c of clay, N_c c of soil with
// friction, N_q q where a pressure q acts on the surface beside the strip (Prandtl (1921), Reissner (1924)). Cells
// count over the width B; the strip's corner lies on a node.
#include <fmt/format.h>

#include <cmath>

#include "mpm/math/constants.hpp"
#include "mpm/study/tool_force/problem.hpp"

namespace mpm::study::tool_force {
namespace footing_problems {

constexpr double kWidth = 0.2, kDensity = 1600.0, kPoisson = 0.3, kAngle = 30.0;

struct Ground {
  double young, friction, dilation, cohesion;  ///< [Pa], [deg], [deg], [Pa]
  double surcharge;                            ///< on the surface beside the strip [Pa]
  double across, down;                         ///< extent of the half, over B
};
constexpr Ground kClay = {10e6, 0.0, 0.0, 10e3, 0.0, 3.0, 2.0};
constexpr Ground kCohesion = {20e6, kAngle, kAngle, 2e3, 0.0, 6.0, 2.5};
constexpr Ground kSurcharge = {20e6, kAngle, kAngle, 0.0, 2e3, 6.0, 2.5};
constexpr Ground kSurchargeStill = {20e6, kAngle, 0.0, 0.0, 2e3, 6.0, 2.5};

std::string strip_scene(const Problem& problem, const Setup& setup, const Ground& ground, bool rough) {
  const double h = kWidth / setup.cells;
  const double right = h * std::ceil(ground.across * setup.cells), low = -h * std::ceil(ground.down * setup.cells);
  const double q = ground.surcharge;
  const std::string initial =
      q > 0.0 ? fmt::format(", initial: {{stress: {{xx: -{0:g}, yy: -{0:g}, zz: -{0:g}}}}}", q) : "";
  const std::string loads =
      q > 0.0 ? fmt::format(
                    "loads:\n  - {{pressure: {{body: bed, edge: z_max, value: {:g}, region: {{box: {{min: [{:.17g}, "
                    "{:.17g}], max: [{:.17g}, 0]}}}}}}}}\n",
                    q, 0.5 * kWidth, -0.5 * h, right)
              : "";
  return fmt::format(
      "geometry: plane_strain\n"
      "grid: {{cell: {:.17g}, min: [0, {:.17g}], max: [{:.17g}, {:.17g}]}}\n"
      "{}\n"
      "materials:\n  - {}\n"
      "bodies:\n"
      "  - {{name: bed, material: soil, shape: {{box: {{min: [0, {:.17g}], max: [{:.17g}, 0]}}}}{}}}\n"
      "rigid_bodies:\n"
      "  - name: tool\n"
      "    shape: {{box: {{size: [{}, {}]}}}}\n"
      "    pose: {{position: [0, {}]}}\n"
      "    friction: {}\n"
      "    motion: {{velocity: [0, \"-{}\"]}}\n"
      "{}"
      "boundaries: {{x_min: symmetry, x_max: slip, z_min: fixed}}\n",
      h, low, right, h * std::ceil(setup.cells), time_section(problem, setup),
      soil_material(setup.law, kDensity, ground.young, kPoisson, ground.friction, ground.dilation, ground.cohesion),
      low, right, initial, kWidth, kWidth, 0.5 * kWidth, rough ? "stick" : "0", speed_expression(problem), loads);
}

Problem strip(const std::string& name, const std::string& title, const std::string& text, const Ground& ground,
              bool rough = true) {
  Problem problem;
  problem.name = name;
  problem.title = title;
  problem.text = text;
  problem.whole = 2.0;
  problem.push = -Vec3::UnitZ();
  problem.length = kWidth;
  problem.from = 0.03;
  problem.to = 0.05;
  problem.speed = 0.05;
  problem.ramp = 0.02;
  problem.wave_speed = elastic_wave(kDensity, ground.young, kPoisson);
  problem.scene = [ground, rough](const Problem& own, const Setup& setup) {
    return strip_scene(own, setup, ground, rough);
  };
  problem.pressed = {{0.0, 0.0, -0.75 * kWidth}, {0.25 * kWidth, 0.0, -0.5 * kWidth}};  // the origin is B/2 above
  return problem;
}

}  // namespace footing_problems

std::vector<Problem> footings() {
  using namespace footing_problems;
  const double phi = kAngle * kPi / 180.0;
  const char* size = " Width 0.2 m, 0.05 m/s. Cells: over the width.";
  std::vector<Problem> list;

  Problem clay = strip("strip_clay", "Rough strip on clay",
                       std::string("Rough strip on weightless clay, E = 1000 c, Poisson's ratio 0.3.") + size, kClay);
  clay.answer_text = "(2 + π) c: Prandtl (1921)";
  clay.answer.lower = clay.answer.upper = bearing_cohesion_factor(0.0) * kClay.cohesion * kWidth;
  list.push_back(clay);

  Problem smooth =
      strip("strip_clay_smooth", "Smooth strip on clay",
            std::string("Smooth strip on weightless clay, E = 1000 c, Poisson's ratio 0.3.") + size, kClay, false);
  smooth.answer_text = clay.answer_text;
  smooth.answer = clay.answer;
  list.push_back(smooth);

  Problem cohesion = strip(
      "strip_nc", "Strip on soil with cohesion and friction: N_c",
      std::string(
          "Rough strip on weightless soil with friction 30 degrees and cohesion, associated flow, E = 10,000 c.") +
          size,
      kCohesion);
  cohesion.answer_text = "N_c c with N_c = 30.14: Prandtl (1921)";
  cohesion.answer.lower = cohesion.answer.upper = bearing_cohesion_factor(phi) * kCohesion.cohesion * kWidth;
  list.push_back(cohesion);

  Problem surcharge = strip(
      "strip_nq", "Strip on sand with a surcharge: N_q",
      std::string(
          "Rough strip on weightless sand, friction 30 degrees, associated flow, with a pressure q on the surface "
          "beside it, E = 10,000 q.") +
          size,
      kSurcharge);
  surcharge.answer_text = "N_q q with N_q = 18.40: Reissner (1924)";
  surcharge.answer.lower = surcharge.answer.upper = bearing_surcharge_factor(phi) * kSurcharge.surcharge * kWidth;
  list.push_back(surcharge);

  Problem still =
      strip("strip_nq_0", "Strip on sand without dilation, with a surcharge",
            std::string("Rough strip on weightless sand, friction 30 degrees, no dilation, with a pressure q on the "
                        "surface beside it, E = 10,000 q.") +
                size,
            kSurchargeStill);
  still.answer = surcharge.answer;
  still.known = Known::estimate;
  still.answer_text =
      "above, N_q = 18.40 of associated flow; below, an estimate: N_q = 12.6 of Davis's (1968) reduced friction";
  still.answer.lower = bearing_surcharge_factor(davis_friction(phi, 0.0)) * kSurcharge.surcharge * kWidth;
  list.push_back(still);
  return list;
}

}  // namespace mpm::study::tool_force
