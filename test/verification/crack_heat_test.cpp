// Heat beside cracks: open faces let none through, closed ones by a conductance, friction on them makes some, and a tip
// that grows releases it.
//
// Sources: a slit across a body insulates, so nothing passes; a slit from an edge to the middle of a square whose ends
// are held: by the map w = sn, k^2 = 1/2, of half of the square, 2 x 1, to a half plane with corners at -1, 1, +-sqrt
// 2, the slit is (-1, 0), and the quadrilateral of (0, 1) and (sqrt 2, -sqrt 2) has m = 2 / (1 + sqrt 2), whose K(m) /
// K(1 - m) is sqrt 2 (the singular value k_2): heat flow falls to 1 / sqrt 2. Tips: crack reference 5.6 and 7.15.
#include <filesystem>

#include "crack_case.hpp"
#include "mpm/simulation/checkpoint.hpp"
#include "page.hpp"
#include "transport_run.hpp"

namespace verification {
namespace crack_heat_test {

using namespace crack_case;

constexpr double kCell = 1e-3;

/// A plate of width x height cells, an odd number of them along z, with a crack along z = 0 (half a cell beside grid
/// lines) that leaves it at x = 0. `tip`: its other end [cells]; `conducts`: keys of the material; `temperature`: of
/// transport; `faces`: keys of the crack.
std::string plate(const std::string& geometry, const std::string& method, std::array<double, 2> size, double tip,
                  double end, const std::string& conducts, const std::string& temperature,
                  const std::string& faces = {}, const std::string& more = {}) {
  const bool rings = geometry == "axisymmetric";
  const double width = size[0], half = 0.5 * size[1];
  std::string text = fmt::format(
      "geometry: {}\n{}grid: {{cell: {}, min: [{}, {}], max: [{}, {}]}}\ntime: {{end: {}, cfl: 0.6, sync: {}}}\n"
      "method: {{update: usavg, transfer: flip, particles_per_cell: 4, {}}}\n"
      "materials: [{{name: polymer, law: linear_elastic, density: {}, young: {}, poisson: {}, heat_capacity: 1000, "
      "{}}}]\n",
      geometry, rings ? "" : "thickness: 0.001\n", kCell, rings ? 0.0 : -3 * kCell, -(half + 3) * kCell,
      (width + 3) * kCell, (half + 3) * kCell, end, sync_of(end, 10), method, kDensity, kYoung, kPoisson, conducts);
  text += body(0.0, -half * kCell, width * kCell, half * kCell) + more;
  text += fmt::format("transport: {{temperature: {{compression_heat: off, {}}}}}\n", temperature);
  return text + fmt::format("cracks:\n  list: [{{name: slit, points: [[{}, 0], [{}, 0]], start: {}, end: {}{}}}]\n",
                            (rings ? 0.0 : -0.4) * kCell, tip * kCell, rings ? "none" : "exterior",
                            tip > width ? "exterior" : "none", faces);
}

/// Mean temperature, by mass, above and below the crack's line.
std::array<double, 2> halves(const mpm::Simulation& simulation) {
  std::array<double, 2> sum{}, mass{};
  const Numbers z = field(simulation, "z"), heat = field(simulation, "temperature_carried"),
                weight = field(simulation, "mass");
  for (std::size_t p = 0; p < z.size(); ++p) {
    const int half = z[p] > 0.0 ? 0 : 1;
    sum[half] += weight[p] * heat[p];
    mass[half] += weight[p];
  }
  return {sum[0] / mass[0], sum[1] / mass[1]};
}

// --- open faces -----------------------------------------------------------------------------------------------------

struct Insulated {
  const char *geometry, *method, *conducts;
};

// About 4 s for all. The slowest of a half's temperatures would even out within 4e-4 s without the crack.
TEST(CrackHeat, NothingPassesAnOpenCrack) {
  const char* isotropic = "conductivity: 5e5";
  const char* tensor = "conductivity: [5e5, 5e5, 2.5e5, 0, 1.5e5, 0]";
  const std::vector<Insulated> cases = {
      {"plane_strain", "shape: ugimp", isotropic},    {"plane_strain", "shape: cpdi", isotropic},
      {"plane_strain", "shape: bspline2", isotropic}, {"plane_stress", "shape: ugimp_stretch", isotropic},
      {"axisymmetric", "shape: ugimp", isotropic},    {"plane_strain", "shape: ugimp", tensor}};
  for (const Insulated& one : cases) {
    SCOPED_TRACE(fmt::format("{}, {}, {}", one.geometry, one.method, one.conducts));
    mpm::Simulation run = made(plate(one.geometry, one.method, {12, 21}, 13, 4e-4, one.conducts,
                                     "initial: \"z > 0 ? 400 + 20*cos(261.8*x) : 300\""));
    const std::array<double, 2> before = halves(run);
    const Numbers first = field(run, "temperature_carried");
    run_until(run, 4e-4);
    const std::array<double, 2> after = halves(run);
    EXPECT_NEAR(after[0], before[0], 1e-9);  // of 100 K; rounding of 1400 particles and 1300 updates
    EXPECT_NEAR(after[1], before[1], 1e-9);
    const Numbers z = field(run, "z"), last = field(run, "temperature_carried");
    double moved = 0.0, cold = 0.0;
    for (std::size_t p = 0; p < z.size(); ++p) {
      double& most = z[p] < 0.0 ? cold : moved;
      most = std::max(most, std::abs(last[p] - first[p]));
    }
    EXPECT_LT(cold, 1e-9);
    EXPECT_GT(moved, 10.0);  // heat has flowed along the crack
    EXPECT_LT(reported(run, "temperature budget error"), 1e-10);
  }
}

// --- a slit to the middle of a square -------------------------------------------------------------------------------

/// The integral of |x (x - 1) (x^2 - 2)|^-1/2 from -sqrt 2 to `to` <= 0: by x = -sqrt 2 cos^2 u.
double along_edge(double to) {
  const double last = std::acos(std::sqrt(-to / std::sqrt(2.0)));
  constexpr int kParts = 2000;
  double sum = 0.0;
  for (int i = 0; i < kParts; ++i) {
    const double u = last * (i + 0.5) / kParts, x = -std::sqrt(2.0) * std::pow(std::cos(u), 2);
    // dx = 2 sqrt 2 cos u sin u du, -x = sqrt 2 cos^2 u, x + sqrt 2 = sqrt 2 sin^2 u
    sum += 2.0 * last / kParts / std::sqrt((1.0 - x) * (std::sqrt(2.0) - x));
  }
  return sum;
}

struct Slit {
  double flow, mouth;  ///< over that without the slit; difference of the faces at the edge [K]
};

Slit slit(int cells) {
  const double half = 0.5 * cells * kCell, end = 5e-4 * std::pow(cells / 21.0, 2);
  mpm::Simulation run = made(plate(
      "plane_strain", "shape: ugimp", {1.0 * cells, 1.0 * cells}, 0.5 * cells, end, "conductivity: 1e6",
      fmt::format("initial: \"0.5 + 0.5*z/{0}\", values: [{{name: upper, region: {{box: {{min: [-1, {0}], max: [1, "
                  "1]}}}}, value: 1}}, {{name: lower, region: {{box: {{min: [-1, -1], max: [1, -{0}]}}}}, value: 0}}]",
                  half)));
  run_until(run, end);
  // Above the slit the mean over x is a straight line in z, whose slope is the heat flow.
  const double high = half - 1.75 * kCell, low = 2.75 * kCell;
  const Numbers x = field(run, "x"), z = field(run, "z"), t = field(run, "temperature");
  double rise = 0.0, faces = 0.0;
  for (std::size_t p = 0; p < x.size(); ++p) {
    if (std::abs(z[p] - high) < 0.01 * kCell) rise += t[p] / (2 * cells);
    if (std::abs(z[p] - low) < 0.01 * kCell) rise -= t[p] / (2 * cells);
    if (x[p] < 0.5 * kCell && std::abs(z[p]) < 0.5 * kCell) faces += z[p] > 0.0 ? t[p] : -t[p];
  }
  return {rise / (high - low) * 2.0 * half, faces};
}

// About 6 s.
TEST(CrackHeat, ASlitToTheMiddleOfASquare) {
  const double mouth = 1.0 - along_edge(-1.0) / along_edge(0.0);  // above the slit less below it [K]
  Page page("crack", "crack_heat", "Heat flows around a slit");
  page.problem(
          "A square whose upper and lower edges are held at 1 and 0 K has a slit from the middle of one side to its "
          "centre, which is an explicit crack with open faces: 21 and 43 cells an edge, the tip in the middle of a "
          "cell.")
      .exact(fmt::format("Heat flow over that without the slit: 1/√2. Difference of the faces at the mouth: {:.4f} K.",
                         mouth),
             "conformal map of half of the square by sn(w, k² = 1/2); singular value of the elliptic integral")
      .meaning(
          "Heat flows as around a slit that is half a cell longer than the crack: pairs of particle and node conduct "
          "unless the crack is between them, and domains reach over the tip. The error falls with the cell.");
  const Slit coarse = slit(21), fine = slit(43);
  page.near("heat flow, 21 cells", coarse.flow, std::sqrt(0.5), 0.04, "");
  page.near("heat flow, 43 cells", fine.flow, std::sqrt(0.5), 0.02, "");
  page.near("difference at the mouth, 21 cells", coarse.mouth, mouth, 0.04, "K");
  page.near("difference at the mouth, 43 cells", fine.mouth, mouth, 0.02, "K");
  EXPECT_LT(std::abs(fine.flow - std::sqrt(0.5)), 0.7 * std::abs(coarse.flow - std::sqrt(0.5)));
}

}  // namespace crack_heat_test
}  // namespace verification
