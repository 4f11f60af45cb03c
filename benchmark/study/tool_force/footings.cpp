// A rigid footing is pressed slowly into level ground: a strip, of which half is modelled beside a plane of symmetry,
// or a disc about the axis. With associated flow the limit load is exact: of clay (2 + pi) c under a strip and 5.69 c
// (smooth) or 6.05 c (rough) under a disc; N_c c and N_q q of weightless soil with friction, where a pressure q acts on
// the surface beside the strip; N_gamma of sand with weight. Cells count over the width B; the footing's edge lies on a
// node. A strip on soil that dilates must be slow, for the soil in its fan is much faster than it. The soil is so stiff
// that the limit is reached before the mean begins, at 0.75 % of the width. Soil rises beside a footing that sinks, up
// to three times as far at 30 degrees, and the exact loads leave that out. Weak: where it has sunk by 1 % of the width,
// this adds 0.6 % to the load on clay and 1.3 % to N_q, and N_q rho g s where sand has weight.
#include <fmt/format.h>

#include <cmath>

#include "mpm/math/constants.hpp"
#include "study/tool_force/problem.hpp"

namespace mpm::study::tool_force {
namespace footing_problems {

constexpr double kWidth = 0.2, kDensity = 1600.0, kGravity = 9.81, kPoisson = 0.3;

struct Ground {
  double young = 0.0;                     ///< [Pa]
  double friction = 0.0, dilation = 0.0;  ///< [deg]
  double cohesion = 0.0;                  ///< [Pa]
  double surcharge = 0.0;                 ///< on the surface beside the footing [Pa]
  bool heavy = false;                     ///< it has weight
  double across = 3.0, down = 2.0;        ///< extent of the half, over B
};

struct Footing {
  Ground ground;
  bool rough = true, round = false;
};

std::string bed_section(const Ground& ground, double low, double right) {
  const std::string start =
      ground.surcharge > 0.0
          ? fmt::format(", initial: {{stress: {{xx: -{0:g}, yy: -{0:g}, zz: -{0:g}}}}}", ground.surcharge)
      : ground.heavy ? ", initial: geostatic"
                     : "";
  return fmt::format(
      "bodies:\n  - {{name: bed, material: soil, shape: {{box: {{min: [0, {:.17g}], max: [{:.17g}, 0]}}}}{}}}\n", low,
      right, start);
}

std::string surcharge_section(const Ground& ground, double cell, double right) {
  if (ground.surcharge == 0.0) return "";
  return fmt::format(
      "loads:\n"
      "  - {{pressure: {{body: bed, edge: z_max, value: {:g}, region: {{box: {{min: [{:.17g}, {:.17g}], max: [{:.17g}, "
      "0]}}}}}}}}\n",
      ground.surcharge, 0.5 * kWidth, -0.3 * cell, right);
}

std::string footing_scene(const Problem& problem, const Setup& setup, const Footing& footing) {
  const Ground& ground = footing.ground;
  const double h = kWidth / setup.cells;
  const double right = h * std::ceil(ground.across * setup.cells), low = -h * std::ceil(ground.down * setup.cells);
  const std::string shape = footing.round ? fmt::format("cylinder: {{radius: {}, height: {}}}", 0.5 * kWidth, kWidth)
                                          : fmt::format("box: {{size: [{}, {}]}}", kWidth, kWidth);
  return fmt::format(
             "geometry: {}\n{}"
             "grid: {{cell: {:.17g}, min: [0, {:.17g}], max: [{:.17g}, {:.17g}]}}\n"
             "{}\n"
             "materials:\n  - {}\n",
             footing.round ? "axisymmetric" : "plane_strain",
             ground.heavy ? fmt::format("gravity: [0, -{}]\n", kGravity) : "", h, low, right,
             h * std::ceil(setup.cells), time_section(problem, setup),
             soil_material(problem.law_of(setup), kDensity, ground.young, kPoisson, ground.friction, ground.dilation,
                           ground.cohesion)) +
         bed_section(ground, low, right) +
         fmt::format(
             "rigid_bodies:\n"
             "  - name: tool\n"
             "    shape: {{{}}}\n"
             "    pose: {{position: [0, {}]}}\n"
             "    friction: {}\n"
             "    motion: {{velocity: [0, \"-{}\"]}}\n",
             shape, 0.5 * kWidth, footing.rough ? "stick" : "0", speed_expression(problem)) +
         surcharge_section(ground, h, right) +
         fmt::format("boundaries: {{{}x_max: slip, z_min: fixed}}\n", footing.round ? "" : "x_min: symmetry, ");
}

Problem make(const std::string& name, const std::string& title, const std::string& text, const std::string& answer_text,
             Bounds answer, const Footing& footing) {
  Problem problem;
  problem.name = name;
  problem.title = title;
  problem.text = text + " Width 0.2 m, Poisson's ratio 0.3. Cells: over the width.";
  problem.answer_text = answer_text;
  problem.answer = answer;
  problem.whole = footing.round ? 1.0 : 2.0;
  problem.push = -Vec3::UnitZ();
  problem.has_places = {false, true};
  problem.length = kWidth;
  problem.from = 0.0075;
  problem.to = 0.0125;
  problem.speed = 0.05;
  problem.ramp = 0.005;
  problem.wave_speed = elastic_wave(kDensity, footing.ground.young, kPoisson);
  problem.scene = [footing](const Problem& own, const Setup& setup) { return footing_scene(own, setup, footing); };
  problem.pressed = {{0.0, 0.0, -0.75 * kWidth}, {0.25 * kWidth, 0.0, -0.5 * kWidth}};  // the origin is B/2 above
  return problem;
}

void add_clay(std::vector<Problem>& list) {
  Ground clay;
  clay.young = 40e6;
  clay.cohesion = 10e3;
  const double area = 0.25 * kPi * kWidth * kWidth;
  for (const bool rough : {true, false}) {
    const std::string word = rough ? "Rough" : "Smooth", ending = rough ? "" : "_smooth";
    const double prandtl = bearing_cohesion_factor(0.0) * clay.cohesion * kWidth;
    list.push_back(make("strip_clay" + ending, word + " strip on clay", word + " strip on weightless clay, E = 4000 c.",
                        "(2 + π) c: Prandtl (1921)", {prandtl, prandtl}, {clay, rough}));
  }
  for (const bool rough : {true, false}) {
    const std::string word = rough ? "Rough" : "Smooth", ending = rough ? "" : "_smooth";
    const double load = circular_footing_factor(rough) * clay.cohesion * area;
    list.push_back(make("disc_clay" + ending, word + " disc on clay",
                        word + " disc on weightless clay of Tresca's law, E = 4000 c, axisymmetric.",
                        rough ? "6.05 c: Eason and Shield (1960)" : "5.69 c: Shield (1955)", {load, load},
                        {clay, rough, true}));
    list.back().law = "mohr_coulomb";
  }
}

/// N_c and N_q of one angle of friction [deg], whose mechanism reaches `across` and `down`, over B.
void add_weightless(std::vector<Problem>& list, double degrees, double surcharge, double across, double down) {
  const std::size_t first = list.size();
  const double phi = degrees * kPi / 180.0, nc = bearing_cohesion_factor(phi), nq = bearing_surcharge_factor(phi);
  Ground soil;
  soil.young = 4e4 * surcharge;
  soil.friction = soil.dilation = degrees;
  soil.across = across;
  soil.down = down;
  // Soil in the fan moves faster than the strip, by up to e^(pi tan(phi)) for associated flow.
  const double speed = degrees < 25.0 ? 0.02 : degrees < 35.0 ? 0.01 : 0.004;
  Ground cohesive = soil, loaded = soil;
  cohesive.cohesion = surcharge;
  loaded.surcharge = surcharge;
  const std::string ending = degrees == 30.0 ? "" : fmt::format("_{:g}", degrees);
  list.push_back(make("strip_nc" + ending, fmt::format("Strip on soil of {:g}° with cohesion: N_c", degrees),
                      fmt::format("Rough strip on weightless soil with friction {:g}° and cohesion c, associated flow, "
                                  "E = 40,000 c.",
                                  degrees),
                      fmt::format("N_c c with N_c = {:.2f}: Prandtl (1921)", nc),
                      {nc * surcharge * kWidth, nc * surcharge * kWidth}, {cohesive}));
  list.push_back(
      make("strip_nq" + ending, fmt::format("Strip on sand of {:g}° with a surcharge: N_q", degrees),
           fmt::format("Rough strip on weightless sand with friction {:g}°, associated flow, a pressure q on "
                       "the surface beside it, E = 40,000 q.",
                       degrees),
           fmt::format("N_q q with N_q = {:.2f}: Reissner (1924)", nq),
           {nq * surcharge * kWidth, nq * surcharge * kWidth}, {loaded}));
  if (degrees == 30.0) {
    loaded.dilation = 0.0;
    const double davis = bearing_surcharge_factor(davis_friction(phi, 0.0));
    list.push_back(make("strip_nq_0", "Strip on sand without dilation, with a surcharge",
                        "Rough strip on weightless sand with friction 30°, no dilation, a pressure q on the surface "
                        "beside it, E = 40,000 q.",
                        fmt::format("above, N_q = {:.2f} of associated flow; below, an estimate: {:.2f} of Davis's "
                                    "(1968) reduced friction",
                                    nq, davis),
                        {davis * surcharge * kWidth, nq * surcharge * kWidth}, {loaded}));
    list.back().known = Known::estimate;
  }
  for (std::size_t i = first; i < list.size(); ++i) {
    list[i].speed = speed;
    if (degrees > 35.0) list[i].finest = 12.0;
  }
}

void add_heavy(std::vector<Problem>& list) {
  Ground sand;
  sand.young = 20e6;
  sand.friction = sand.dilation = 30.0;
  sand.heavy = true;
  sand.across = 4.0;
  const double phi = kPi / 6.0, from = 0.01, to = 0.02;
  for (const bool rough : {true, false}) {
    const double unit = 0.5 * kDensity * kGravity * kWidth * kWidth, n = bearing_weight_factor(phi, rough);
    const double sunk = bearing_surcharge_factor(phi) * (from + to);  // N_q rho g s B over the unit, in the mean
    list.push_back(
        make(rough ? "strip_ngamma" : "strip_ngamma_smooth",
             rough ? "Rough strip on sand: N_γ" : "Smooth strip on sand: N_γ",
             "Strip on sand at rest with friction 30°, associated flow, E = 6400 ρgB.",
             fmt::format("from N_γ = {:.2f} (Martin (2005)) to that and the surcharge of the depth to which it "
                         "has sunk, N_q ρgs",
                         n),
             {unit * n, unit * (n + sunk)}, {sand, rough}));
    Problem& problem = list.back();
    problem.known = Known::bounds;
    problem.from = from;
    problem.to = to;
    problem.speed = 0.002;  // it dilates faster than it would fall otherwise
    problem.finest = 16.0;
  }
}

}  // namespace footing_problems

std::vector<Problem> footings() {
  using namespace footing_problems;
  std::vector<Problem> list;
  add_clay(list);
  add_weightless(list, 30.0, 2e3, 6.0, 2.5);
  add_heavy(list);
  add_weightless(list, 20.0, 2e3, 4.5, 2.0);
  add_weightless(list, 40.0, 2e3, 10.0, 3.5);
  for (Problem& problem : list) {
    problem.quick = problem.name == "strip_clay" || problem.name == "strip_nc" || problem.name == "strip_nq" ||
                    problem.name == "strip_nq_0";
  }
  return list;
}

}  // namespace mpm::study::tool_force
