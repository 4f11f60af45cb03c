// Heat beside cracks: open faces let none through, closed ones by a conductance, friction on them makes some, and a tip
// that grows releases it.
//
// Sources: a slit across a body insulates, so nothing passes; a slit from an edge to the middle of a square whose ends
// are held: by the map w = sn, k^2 = 1/2, of half of the square, 2 x 1, to a half plane with corners at -1, 1, +-sqrt
// 2, the slit is (-1, 0), and the quadrilateral of (0, 1) and (sqrt 2, -sqrt 2) has m = 2 / (1 + sqrt 2), whose K(m) /
// K(1 - m) is sqrt 2 (the singular value k_2): heat flow falls to 1 / sqrt 2. Tips: crack reference 5.6 and 7.15.
#include <filesystem>

#include "crack_case.hpp"
#include "mpm/checkpoint/checkpoint.hpp"
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
    EXPECT_NEAR(after[0], before[0], 1e-9);  // error of 100 K; rounding of 1400 particles and 1300 updates
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

// The same of a solvent, and of the water in pores, whose suction moves one half: faces pass through each other, so
// that it does not squeeze the other half. About 1 s.
TEST(CrackHeat, NorDoSolventAndWater) {
  struct Case {
    const char *name, *constants, *quantity;
    double above;
  };
  for (const Case& one :
       {Case{"concentration", "saturation: 0.2, diffusivity: 0.5", "concentration: {initial: \"z > 0 ? 1 : 0\"}", 1.0},
        Case{"pore_pressure", "storage: 1e-9, permeability: 1e-9, viscosity: 1e-3",
             "pore_pressure: {initial: \"z > 0 ? -1e3*(2 + cos(261.8*x)) : 0\"}", -2e3}}) {
    SCOPED_TRACE(one.name);
    std::string text = plate("plane_strain", "shape: ugimp", {12, 21}, 13, 2e-4, "HERE", "THERE", ", faces: ignored");
    const auto replace = [&](const std::string& what, const std::string& by) {
      text.replace(text.find(what), what.size(), by);
    };
    replace("heat_capacity: 1000, HERE", one.constants);
    replace("temperature: {compression_heat: off, THERE}", one.quantity);
    mpm::Simulation run = made(text);
    run_until(run, 2e-4);
    const Numbers z = field(run, "z"), value = field(run, std::string(one.name) + "_carried");
    double below = 0.0, above = 0.0;
    for (std::size_t p = 0; p < z.size(); ++p) {
      if (z[p] < 0.0) below = std::max(below, std::abs(value[p]));
      if (z[p] > 0.0) above += 2.0 * value[p] / static_cast<double>(z.size());
    }
    EXPECT_LT(below, 1e-10 * std::abs(one.above));
    EXPECT_NEAR(above / one.above, 1.0, 0.9);
    EXPECT_LT(reported(run, std::string(one.name) + " budget error"), 1e-10);
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

// --- closed faces ---------------------------------------------------------------------------------------------------

/// Two halves of 12 x 10.5 cells, 400 K and 300 K, that are pressed onto each other.
mpm::Simulation pressed(const std::string& method, const std::string& faces, const std::string& transport, double end,
                        const std::string& more = {}) {
  const std::string loads = "loads:\n" + traction("z_max", ramped(-1e5, 5e-5)) + traction("z_min", ramped(1e5, 5e-5));
  return made(plate("plane_strain", method, {12, 21}, 13, end, "conductivity: 2e7",
                    "initial: \"z > 0 ? 400 : 300\"" + transport, faces, loads + more));
}

// About 2 s.
TEST(CrackHeat, ClosedFacesConduct) {
  constexpr double kConductance = 1e7, kHalf = 10.5e-3, kConductivity = 2e7, kHeat = 1e6;  // heat by volume [J/(m^3 K)]
  // Each half loses 2 h (T - mean) through its face: z tan z = 2 h H / k of its slowest mode, found by bisection.
  double low = 0.0, high = 1.0;
  while (high - low > 1e-14) {
    const double z = 0.5 * (low + high);
    (z * std::tan(z) < 2.0 * kConductance * kHalf / kConductivity ? low : high) = z;
  }
  const double rate = kConductivity / kHeat * std::pow(low / kHalf, 2);
  const std::string conducts = fmt::format(", pairs: [{{bodies: [plate, plate], conductance: {}}}]", kConductance);
  const std::string method = "shape: ugimp, damping: {grid: 60000}";
  const auto decay = [&](const std::string& faces, const std::string& transport) {
    mpm::Simulation run = pressed(method, faces, transport, 4e-4);
    run_until(run, 2e-4);
    const std::array<double, 2> first = halves(run);
    run_until(run, 4e-4);
    const std::array<double, 2> last = halves(run);
    EXPECT_NEAR(last[0] + last[1], 700.0, 1e-8);  // loss of one half is the gain of the other
    EXPECT_LT(reported(run, "temperature budget error"), 1e-10);
    return std::log((first[0] - first[1]) / (last[0] - last[1])) / 2e-4;
  };
  Page page("crack", "crack_heat_closed", "Heat flows through closed faces");
  page.problem(
          "A plate of 12 x 21 cells with a crack across its middle is pressed together by 0.1 MPa. One half is 400 K "
          "warm, the other 300 K; the faces conduct 1e7 W/(m² K) where they touch.")
      .exact(fmt::format("The difference decays at {:.1f} /s: z tan z = 2hH/k, α z²/H².", rate),
             "Carslaw and Jaeger, Conduction of Heat in Solids (1959), section 3.11")
      .meaning("The area of contact is that of the crack.");
  page.near("rate of decay", decay("", conducts), rate, 0.05, "1/s");
  EXPECT_LT(std::abs(decay("", "")), 1e-9);                        // without a conductance none
  EXPECT_LT(std::abs(decay(", faces: ignored", conducts)), 1e-9);  // no contact, no heat
}

// About 1 s.
TEST(CrackHeat, FrictionBecomesHeat) {
  mpm::Simulation run = pressed("shape: ugimp", ", faces: {friction: 0.3}", "", 2e-4,
                                "boundaries:\n  conditions:\n"
                                "    - {name: drawn, region: {box: {min: [-1, 10.4 mm], max: [1, 1]}}, direction: x, "
                                "velocity: 0.1}\n"
                                "    - {name: held, region: {box: {min: [-1, -1], max: [1, -10.4 mm]}}, direction: x, "
                                "velocity: 0}\n");
  const auto booked = [&] {
    return reported(run, "temperature by friction") + reported(run, "heat of friction in the next step");
  };
  run_until(run, 2e-4);
  const double taken = run.state().energy.of("crack_friction");
  // No more than 0.3 x 0.1 MPa x 12 mm x 1 mm over the whole way of the edge.
  EXPECT_GT(taken, 1e-8);
  EXPECT_LT(taken, 0.3 * 1e5 * 12e-6 * 0.1 * 2e-4);
  EXPECT_NEAR(booked(), taken, 1e-12 * taken);
  EXPECT_LT(reported(run, "temperature budget error"), 1e-10);
}

// --- tips -----------------------------------------------------------------------------------------------------------

constexpr double kStep = 1e-7, kTip = 6.1, kPart = 0.6;
constexpr int kSteps = 800;
const double kWave = std::sqrt(kPlane / kDensity * (1 - kPoisson) * (1 - kPoisson) / (1 - 2 * kPoisson));  // [m/s]

/// A plate, or a rod, of 20 x 21 cells that is drawn apart; its crack grows at 100 m/s from `start` [s] on, by half a
/// cell at a time until it has grown 3.4 cells. Every step is a sync period.
std::string growing(const std::string& geometry, const std::string& conductivity, const std::string& faces = {},
                    double start = 2e-5) {
  std::string text =
      plate(geometry, "shape: ugimp", {20, 21}, kTip, kSteps * kStep,
            "conductivity: " + conductivity +
                fmt::format(", fracture: {{start_time: {}, speed: 100, longest: {}}}", start, (kTip + 3.7) * kCell),
            "initial: 293", faces,
            "boundaries:\n  conditions:\n"
            "    - {name: upper, region: {box: {min: [0, 10.4 mm], max: [1, 1]}}, direction: z, velocity: 1}\n"
            "    - {name: lower, region: {box: {min: [0, -1], max: [1, -10.4 mm]}}, direction: z, velocity: -1}\n");
  const std::string sync = fmt::format("sync: {}", sync_of(kSteps * kStep, 10)), end = "end: none";
  text.replace(text.find(sync), sync.size(), fmt::format("sync: {}", kStep));
  text.replace(text.find(end), end.size(), "end: tip");
  return text + fmt::format("  growth: {{criterion: steady_state}}\n  heating: {}\n", kPart);
}

struct Grown {
  double heat = 0.0, moment = 0.0;  ///< f J B da of all steps [J], and with the places of the tip [J m]
  int growths = 0;
};

/// Runs `steps` steps; `thickness` [m], 0: about the axis. `look(heat so far)` after each step.
template <class Look>
Grown grow(mpm::Simulation& run, double thickness, int steps, Look&& look) {
  Grown sum;
  double before = 0.0;
  for (int n = 1; n <= steps; ++n) {
    run_until(run, n * kStep);
    const double grown = number(run, "crack 1 end growth"), tip = run.crack_tips().front().place.x();
    if (grown > before) {
      const double front = thickness > 0.0 ? thickness : 2.0 * kHalfTurn * tip;
      const double heat = kPart * number(run, "crack 1 end j") * front * (grown - before);
      sum.heat += heat;
      sum.moment += heat * tip;
      ++sum.growths;
    }
    before = grown;
    look(sum);
  }
  return sum;
}

// About 4 s.
TEST(CrackHeat, TipsReleaseTheirPart) {
  struct Case {
    const char *geometry, *faces;
    double thickness;
  };
  for (const Case& one : {Case{"plane_strain", "", 1e-3}, Case{"plane_stress", ", thickness: 0.002", 2e-3},
                          Case{"axisymmetric", "", 0.0}}) {
    SCOPED_TRACE(one.geometry);
    mpm::Simulation run = made(growing(one.geometry, "0", one.faces));
    std::vector<double> given;  // by step, from the first growth on
    double first = 0.0;
    const Grown grown = grow(run, one.thickness, kSteps, [&](const Grown& now) {
      if (now.growths == 1 && given.empty()) first = now.heat;
      if (now.growths > 0) given.push_back(reported(run, "temperature by crack tips"));
    });
    EXPECT_GE(grown.growths, 6);  // half a cell each, 3.4 cells and no more than another half
    EXPECT_LE(grown.growths, 8);
    EXPECT_GT(grown.heat, 0.0);
    EXPECT_NEAR(given.back() / grown.heat, 1.0, 1e-12);
    EXPECT_NEAR(reported(run, "temperature content") / grown.heat, 1.0, 1e-10);
    EXPECT_LT(reported(run, "temperature budget error"), 1e-10);
    // n = floor(da / (c dt)) = floor(0.5e-3 / (1.925e3 1e-7)) = 2 steps, alike, from the next step on (plane stress:
    // the same, 0.5e-3 / (1.675e3 1e-7) = 2.99).
    EXPECT_EQ(given[0], 0.0);
    EXPECT_NEAR(given[1], 0.5 * first, 1e-12 * first);
    EXPECT_NEAR(given[2], first, 1e-12 * first);
    EXPECT_NEAR(given[3], first, 1e-12 * first);
    // Heat stays where the tips were: a tenth of a cell, since particles lie a quarter beside them.
    const Numbers x = field(run, "x"), z = field(run, "z"), t = field(run, "temperature_carried"),
                  mass = field(run, "mass");
    double along = 0.0, across = 0.0, content = 0.0;
    for (std::size_t p = 0; p < x.size(); ++p) {
      const double heat = 1000.0 * mass[p] * (t[p] - 293.0);
      content += heat;
      along += heat * x[p];
      across += heat * z[p];
    }
    EXPECT_NEAR(content / grown.heat, 1.0, 1e-6);
    EXPECT_NEAR(along / content, grown.moment / grown.heat, 0.1 * kCell);
    EXPECT_NEAR(across / content, 0.0, 0.1 * kCell);
  }
}

// A checkpoint between the two steps that give the heat of a growth, and another before, from which two threads go on.
// About 1 s.
TEST(CrackHeat, SameBitsForAnyThreadsAndFromACheckpoint) {
  const std::string text = growing("plane_strain", "1e4", "", 1e-5);
  mpm::Simulation whole = made(text);
  const int before = 90, half = 101, end = 115;  // it grows in step 100
  const std::string file = testing::TempDir() + "/crack_heat.h5", earlier = testing::TempDir() + "/crack_heat_0.h5";
  run_until(whole, before * kStep);
  mpm::save_checkpoint(earlier, whole, {"crack.yaml", "text", {}});
  EXPECT_EQ(reported(whole, "temperature by crack tips"), 0.0);
  run_until(whole, half * kStep);
  mpm::save_checkpoint(file, whole, {"crack.yaml", "text", {}});
  const double given = reported(whole, "temperature by crack tips");
  run_until(whole, end * kStep);
  EXPECT_GT(given, 0.0);
  EXPECT_NEAR(reported(whole, "temperature by crack tips"), 2.0 * given, 1e-12 * given);
  mpm::Simulation two(mpm::build(mpm::parse_scene(text, "crack")), {2});
  mpm::load_checkpoint(earlier, two, "text");
  run_until(two, end * kStep);
  EXPECT_EQ(two.state_hash(), whole.state_hash());
  mpm::Simulation resumed = made(text);
  mpm::load_checkpoint(file, resumed, "text");
  run_until(resumed, end * kStep);
  EXPECT_EQ(resumed.state_hash(), whole.state_hash());
  EXPECT_EQ(resumed.memory_hash(), whole.memory_hash());
  EXPECT_EQ(reported(resumed, "temperature by crack tips"), reported(whole, "temperature by crack tips"));
  std::filesystem::remove(file);
  std::filesystem::remove(earlier);
}

}  // namespace crack_heat_test
}  // namespace verification
