// A hot tool on material that a crack divides: each share of a touch goes to the velocity field that the material has
// at its node, so that each side of the crack gets the heat that it touches.
//
// Sources: the slab with one insulated face (Carslaw and Jaeger, Conduction of Heat in Solids (1959), section 3.11), in
// which no heat flows across an upright crack; the same halves as two bodies, whose nodes hold the same material; the
// balance of heat. Cost: 1 s.
#include "crack_case.hpp"
#include "transport_run.hpp"

namespace verification {
namespace crack_tool_heat_test {

using namespace crack_case;

constexpr double kHeight = 0.4, kConductivity = 4e4, kHeat = 1e6;  // [m], [W/(m K)], [J/(m^3 K)]
constexpr double kConductance = 2e5, kHot = 500.0, kCold = 300.0;  // [W/(m^2 K)], [K]
constexpr double kEnd = 0.4;                                       // [s]

enum class Parted { not_at_all, by_crack, as_bodies };

/// A block of 16 x 8 cells under a hot plate that covers it; parted at x = 0.425 m, in the middle of a cell.
std::string under_a_plate(Parted parted, const std::string& initial, const std::string& plate,
                          const std::string& heats = {}) {
  const char* const whole = "{name: block, material: m, shape: {box: {min: [0, 0], max: [0.8, 0.4]}}}";
  const char* const two =
      "{name: left, material: m, shape: {box: {min: [0, 0], max: [0.425, 0.4]}}}, "
      "{name: right, material: m, shape: {box: {min: [0.425, 0], max: [0.8, 0.4]}}}";
  std::string text = fmt::format(
      "geometry: plane_strain\ngrid: {{cell: 0.05, min: [-0.2, 0], max: [1, 0.8]}}\n"
      "time: {{end: {}, step: 5e-4, sync: 0.01}}\nmethod: {{shape: ugimp, transfer: flip}}\n"
      "materials: [{{name: m, law: linear_elastic, density: 1000, young: 1e6, poisson: 0.3, heat_capacity: {}, "
      "conductivity: {}}}]\nbodies: [{}]\nboundaries: {{z_min: fixed}}\n"
      "rigid_bodies: [{{name: iron, shape: {{box: {{size: [1.2, 0.2]}}}}, {}}}]\n"
      "transport: {{temperature: {{initial: {}, compression_heat: off, tools: [{{body: iron, conductance: {}, "
      "temperature: {}{}}}]}}}}\n",
      kEnd, kHeat / 1000.0, kConductivity, parted == Parted::as_bodies ? two : whole, plate, initial, kConductance,
      kHot, heats);
  if (parted == Parted::as_bodies) text += "contact: {pairs: [{between: [left, right], friction: 0}]}\n";
  if (parted == Parted::by_crack) {
    text +=
        "cracks: {list: [{name: cut, line: {from: [0.425, 0.385], to: [0.425, 0.015]}, start: exterior, end: "
        "exterior}]}\n";
  }
  return text;
}

const char* const kAtRest = "pose: {position: [0.4, 0.5]}, friction: 0";

/// Temperatures by place, since bodies number their particles anew.
Numbers temperatures(const std::string& text) {
  mpm::Simulation run = made(text);
  run_until(run, kEnd);
  EXPECT_LT(reported(run, "temperature budget error"), 1e-10);
  const double conducted = reported(run, "heat from iron");
  EXPECT_GT(conducted, 0.0);
  EXPECT_NEAR(reported(run, "temperature by tools"), conducted, 1e-10 * conducted);
  const Numbers x = field(run, "x"), z = field(run, "z"), t = field(run, "temperature_carried");
  Numbers sorted(t.size());
  for (std::size_t p = 0; p < t.size(); ++p) {
    const auto column = static_cast<std::size_t>(x[p] / 0.025), row = static_cast<std::size_t>(z[p] / 0.025);
    sorted.at(16 * column + row) = t[p];
  }
  return sorted;
}

/// Part of the heat that a slab under such a plate has taken.
double part_taken(double time) {
  const double biot = kConductance * kHeight / kConductivity, tau = kConductivity / kHeat * time / (kHeight * kHeight);
  double left = 0.0;
  for (int n = 0; n < 40; ++n) {
    double low = n * kHalfTurn, high = low + 0.5 * kHalfTurn;
    while (high - low > 1e-13) {
      const double zeta = 0.5 * (low + high);
      (zeta * std::tan(zeta) < biot ? low : high) = zeta;
    }
    left += 4.0 * std::pow(std::sin(low), 2) / (low * (2.0 * low + std::sin(2.0 * low))) * std::exp(-low * low * tau);
  }
  return 1.0 - left;
}

// Heat flows downwards alone. Nodes beside the crack exchange heat by their parts, each of which is a little nearer to
// or farther from the tool's temperature within a step: 1e-4 of the difference is asked.
TEST(CrackToolHeat, ACrackDoesNotMatterWhereHeatFlowsAlongIt) {
  const Numbers whole = temperatures(under_a_plate(Parted::not_at_all, "300", kAtRest)),
                cracked = temperatures(under_a_plate(Parted::by_crack, "300", kAtRest));
  double mean = 0.0, differ = 0.0;
  for (std::size_t p = 0; p < whole.size(); ++p) {
    mean += cracked[p] / static_cast<double>(whole.size());
    differ = std::max(differ, std::abs(cracked[p] - whole[p]));
  }
  const double exact = part_taken(kEnd);
  EXPECT_NEAR((mean - kCold) / (kHot - kCold) / exact, 1.0, 0.01);
  EXPECT_LT(differ, 1e-4 * (kHot - kCold));
}

// Halves of unlike temperature, one of which warms the tool: nothing passes the crack, and the nodes of two bodies hold
// the same material as the fields of the cracked one, so that only sums are grouped in another way.
TEST(CrackToolHeat, EachHalfGetsWhatItGetsAsABody) {
  const std::string initial = "\"x < 0.425 ? 300 : 550\"";
  const Numbers cracked = temperatures(under_a_plate(Parted::by_crack, initial, kAtRest)),
                bodies = temperatures(under_a_plate(Parted::as_bodies, initial, kAtRest)),
                whole = temperatures(under_a_plate(Parted::not_at_all, initial, kAtRest));
  double differ = 0.0, through = 0.0;
  for (std::size_t p = 0; p < cracked.size(); ++p) {
    differ = std::max(differ, std::abs(cracked[p] - bodies[p]));
    through = std::max(through, std::abs(cracked[p] - whole[p]));
  }
  EXPECT_LT(differ, 1e-8);
  EXPECT_GT(through, 10.0);  // without the crack heat flows across
}

// The plate is pressed down and drawn along over the crack: a quarter of friction's heat is the material's, the rest
// the tool's, which also loses what it conducts.
TEST(CrackToolHeat, FrictionOverACrackIsSharedAsAsked) {
  mpm::Simulation run = made(under_a_plate(Parted::by_crack, "300",
                                           "pose: {position: [0.4, 0.5]}, friction: 0.4, motion: {velocity: [0.3, "
                                           "-0.05]}",
                                           ", heat_capacity: 1e5, friction_part: 0.25"));
  run_until(run, 0.2);
  const double friction = run.state().energy.of("friction"), conducted = reported(run, "heat from iron");
  EXPECT_GT(friction, 1.0);
  EXPECT_NEAR(reported(run, "temperature by friction"), 0.25 * friction, 1e-10 * friction);
  EXPECT_NEAR(1e5 * (kHot - reported(run, "temperature of iron")), conducted - 0.75 * friction, 1e-9 * conducted);
  EXPECT_LT(reported(run, "temperature budget error"), 1e-10);
  EXPECT_LT(run.state().audit.residual, 1e-10);
}

}  // namespace crack_tool_heat_test
}  // namespace verification
