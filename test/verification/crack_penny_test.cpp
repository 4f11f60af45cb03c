// A penny-shaped crack in a rod about its axis: J under tension at the ends and under pressure on the faces, in both
// forms and on contours of three sizes.
//
// Exact, in an infinite body: J = 4 (1 - nu^2) sigma^2 a / (pi E); Sneddon (1946), Proc. R. Soc. Lond. A 187, 229-260.
// In a rod of radius b = 2a: times 1.1583 with a free side, 1.1018 with a side held radially, 1.0170 at b = 4a (finite
// elements, crack reference 7.8; Sneddon & Tait's series gives 1.149 and 1.098). The correction grows as (a/b)^3 where
// it is small, and between b = 4a and b = 2a as its power 3.2.
//
// The tip lies a tenth of a cell beyond a node, at a = 10.1 cells in a rod of 20, so that 1.1583 becomes 1.1635.
#include <fmt/core.h>

#include "page.hpp"
#include "scene_run.hpp"

namespace verification {
namespace crack_penny_test {

constexpr double kYoung = 2.5e9, kPoisson = 0.33, kLoad = 1e5, kRadius = 10.1e-3;  // [Pa], [m]

const char* const kScene = R"yaml(
name: penny_crack
geometry: axisymmetric
grid: {cell: 1 mm, min: [0, -54 mm], max: [24 mm, 55 mm]}
time: {end: 0.4 ms, cfl: 0.6, sync: 0.1 ms}
method: {damping: {grid: 6e4 1/s}}
materials: [{name: polymer, law: linear_elastic, density: 1000, young: 2500 MPa, poisson: 0.33}]
bodies: [{name: rod, material: polymer, shape: {box: {min: [0, -50 mm], max: [20 mm, 51 mm]}}}]
)yaml";
const char* const kEnds = R"yaml(
loads:
  - {traction: {body: rod, edge: z_max, traction: [0, "1e5*min(t/2e-4,1)"]}}
  - {traction: {body: rod, edge: z_min, traction: [0, "-1e5*min(t/2e-4,1)"]}}
cracks: {list: [{name: penny, points: [[0.25 mm, 0.5 mm], [10.1 mm, 0.5 mm]], start: exterior}]}
)yaml";
const char* const kFaces = R"yaml(
cracks:
  traction_laws: {gas: {kind: pressure, pressure: "-1e5*min(t/2e-4,1)"}}
  list: [{name: penny, points: [[0.25 mm, 0.5 mm], [10.1 mm, 0.5 mm]], start: exterior, traction: gas}]
)yaml";

double infinite() { return 4.0 * (1.0 - kPoisson * kPoisson) * kLoad * kLoad * kRadius / (3.14159265358979 * kYoung); }

/// Factor of a correction that is `at_half` at a/b = 1/2 and follows a power of a/b.
double factor(double at_half, double power) { return 1.0 + at_half * std::pow(1.01, power); }

double j_of(const std::string& loads, const std::vector<std::string>& overrides) {
  mpm::Simulation simulation(mpm::build(mpm::parse_scene(kScene + loads, "penny", overrides)), {1});
  run_until(simulation, 0.4e-3);
  EXPECT_LT(std::abs(number(simulation, "crack 1 end k_two")), 0.02 * number(simulation, "crack 1 end k_one"));
  return number(simulation, "crack 1 end j");
}

TEST(CrackPenny, RodOfTwiceItsRadius) {
  Page page("crack", "crack_penny", "A penny-shaped crack in a rod");
  page.problem(
          "A rod of radius 20 mm and height 101 mm with a crack of radius a = 10.1 mm across its middle, in cells of 1 "
          "mm, E = 2500 MPa, ν = 0.33: pulled at its ends by 0.1 MPa, or with that pressure on the crack's faces. The "
          "load rises slowly, and damping brings the rod to rest.")
      .exact(
          "J = f J∞, J∞ = 4 (1 - ν²) σ² a / (πE), f = 1.1583 at b = 2a with a free side and 1.1018 with a side held "
          "radially; at this a/b = 0.505 f = 1.1635 and 1.1049.",
          "Sneddon, Proc. R. Soc. A 187 (1946) 229; f by finite elements (Sneddon and Tait: 1.149 and 1.098)")
      .meaning(
          "Contours of 2 to 5 cells agree within 1 %, the two ways to load and the two forms too. The form of "
          "Bergkvist "
          "and Huong needs the first moment of the energy about the tip. Summed over the particles next to the tip "
          "that is off by 0.2 cells times J, which made J 2 % low; it is taken from the edge of a square around them.");
  const double free = factor(0.1583, 3.2), held = factor(0.1018, 3.0);
  Panel& panel = page.figure().panel("J, over that in an infinite body", "size of the contour [cells]", "J / J∞");
  panel.exact("free side", {2, 5}, {free, free}).exact("held side", {2, 5}, {held, held});
  for (const auto& [name, loads] : {std::pair<std::string, std::string>{"tension", kEnds}, {"pressure", kFaces}}) {
    for (const std::string form : {"broberg", "bergkvist_huong"}) {
      Numbers sizes, values;
      for (const int size : {2, 3, 5}) {
        if (size == 2 && form != "broberg") continue;  // there the form of Broberg stands for it
        sizes.push_back(size);
        values.push_back(j_of(loads, {"cracks.contour.form=" + form, fmt::format("cracks.contour.size={}", size)}) /
                         infinite());
        // Asked. Nodal values cost up to 1.4 % at 2 cells (crack reference 4.2), a tip off by 0.15 cells 2 %.
        page.near(fmt::format("J / J∞, {}, {}, {} cells", name, form, size), values.back(), free, 0.02, "");
      }
      // Ratio of contours of 2 and 5 cells: 1.2 %, the error of the trapezoid rule at 2 cells.
      page.near(fmt::format("J at {} over J at 5 cells, {}, {}", sizes.front(), name, form),
                values.front() / values.back(), 1.0, 0.015, "");
      panel.points(name + ", " + form, sizes, values);
    }
  }
  const double side = j_of(kFaces, {"boundaries.x_max=slip", "grid.max=[0.02, 0.055]"}) / infinite();
  page.near("J / J∞, pressure, side held radially", side, held, 0.02, "");
  panel.points("pressure, held", {3}, {side});
}

}  // namespace crack_penny_test
}  // namespace verification
