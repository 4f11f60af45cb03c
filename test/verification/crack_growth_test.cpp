// Growth of a crack: how far it goes under fixed grips, and that a crack which has grown is one that was there.
//
// Source: crack reference 7.2: two arms of height h drawn apart by d each, J = G_c at
// a = sqrt(d/2 sqrt(3 E' h^3 / G_c)) - 0.6728 h (beams on the root that finite elements give).
#include <filesystem>

#include "crack_case.hpp"
#include "mpm/checkpoint/checkpoint.hpp"
#include "page.hpp"

namespace verification {
namespace crack_growth_test {

using namespace crack_case;

constexpr double kArm = 6e-3, kCell = 1e-3;  // [m]
constexpr double kToughness = 200.0;         // [J/m^2]

/// A beam from x = 0 to `width` with a slit along its middle, whose arms are drawn apart with `velocity` at x = 0.
/// `growth`: keys of the section cracks; `fracture`: of the material.
std::string drawn(double width, double slit, double end, const std::string& velocity, const std::string& growth,
                  const std::string& fracture) {
  // Grid lines lie half a cell beside the crack, and the tip a tenth of a cell beyond a node.
  std::string text = fmt::format(
      "geometry: plane_strain\nthickness: 0.001\n"
      "grid: {{cell: {0}, min: [{1}, {2}], max: [{3}, {4}]}}\n"
      "time: {{end: {5}, cfl: 0.6, sync: 2e-5}}\n"
      "method: {{shape: ugimp, update: usavg, transfer: {{fmpm: 2}}, particles_per_cell: 4, damping: {{grid: "
      "60000}}}}\n"
      "materials: [{{name: polymer, law: linear_elastic, density: {6}, young: {7}, poisson: {8}{9}}}]\n",
      kCell, -5 * kCell, -12.5 * kCell, width + 4 * kCell, 13.5 * kCell, end, kDensity, kYoung, kPoisson, fracture);
  text += body(0.0, -kArm, width, kArm);
  text += "boundaries:\n  conditions:\n";
  for (const double side : {1.0, -1.0}) {
    text += fmt::format(
        "    - {{name: {}, region: {{box: {{min: [-0.1 mm, {} mm], max: [0.1 mm, {} mm]}}}}, direction: z, velocity: "
        "\"{}*({})\"}}\n",
        side > 0 ? "upper" : "lower", 2.5 * side - 0.1, 2.5 * side + 0.1, side, velocity);
  }
  return text +
         fmt::format("cracks:\n  list: [{{name: slit, points: [[{}, 0], [{}, 0]], start: exterior, end: tip}}]\n{}",
                     0.3 * kCell, slit, growth);
}

std::string with_sync(std::string text, const std::string& sync) {
  const std::string usual = "sync: 2e-5";
  return text.replace(text.find(usual), usual.size(), "sync: " + sync);
}

double end_of_crack(double opening) {
  return std::sqrt(0.5 * opening * std::sqrt(3.0 * kPlane * std::pow(kArm, 3) / kToughness)) - 0.6728 * kArm;
}

double length(const mpm::Simulation& simulation) { return number(simulation, "crack length 1") + 0.3 * kCell; }

// About 8 s.
TEST(CrackGrowth, StopsWhereItsEnergyIsSpent) {
  EXPECT_NEAR(end_of_crack(0.5e-3), 23.42e-3, 0.01e-3);  // the reference's figures
  EXPECT_NEAR(end_of_crack(1.0e-3), 34.79e-3, 0.01e-3);
  Page page("crack", "crack_growth", "A slit beam drawn apart until its crack grows");
  page.problem(
          "Two arms 6 mm high, 6 cells, are drawn apart by 0.5 mm each, held, drawn to 1 mm and held again; E = 2500 "
          "MPa, ν = 0.33, plane strain. The crack, 15.1 mm long at the start, grows by half a cell where J reaches 200 "
          "J/m².")
      .exact("a = √(d/2 √(3E'h³/G_c)) - 0.6728 h: 23.42 and 34.79 mm.", "beams on the root that finite elements give")
      .meaning(
          "Growth stops within one step of 0.5 mm of the exact length. J of a crack that has grown is as near to the "
          "formula as that of one which was there.");
  mpm::Simulation run = made(drawn(55e-3, 15.1e-3, 5e-3,
                                   "t < 1.5e-3 || (t > 2e-3 && t < 4e-3) ? "
                                   "(t < 1.5e-3 ? 1/3.0 : 0.25) : 0",
                                   "  growth: {criterion: release_rate}\n", ", fracture: {j_ic: 200}"));
  const auto look = [&](double time, double opening) {
    run_until(run, time);
    const std::string name = fmt::format(" at {} mm", 1e3 * opening);
    const double a = length(run), root = a + 0.6728 * kArm;
    page.near("a" + name, a, end_of_crack(opening), 0.5 * kCell / end_of_crack(opening), "m");
    const double exact = 0.75 * kPlane * std::pow(kArm, 3) * opening * opening / std::pow(root, 4);
    // A crack of this length that was there from the start has 0.97 to 0.99 at 6 cells an arm (crack reference 7.1).
    page.near("J / exact of that length" + name, tip(run, "end").j / exact, 0.975, 0.025, "");
    page.below("J" + name, tip(run, "end").j, kToughness, "J/m²");
  };
  look(2e-3, 0.5e-3);
  look(5e-3, 1.0e-3);
}

/// Energy that growth of the crack releases by area [J/m^2].
double release_at(double length, double opening) {
  return 0.75 * kPlane * std::pow(kArm, 3) * opening * opening / std::pow(length + 0.6728 * kArm, 4);
}

// The criterion balances what all energies say; the beam formula says it too. About 15 s.
TEST(CrackGrowth, ReleasesTheEnergyOfTheBeamFormula) {
  Page page("crack", "crack_release", "Energy that growth releases, by the energies of the whole body");
  page.problem(
          "The slit beam with its arms held 0.5 mm apart; from 15.1 mm on its crack grows by `energy_balance` at 1 "
          "m/s, "
          "by half a cell at a time, after each of which the body comes to rest.")
      .exact("G = 3/4 E'h³d²/(a + 0.6728 h)⁴ in the middle of the last two lengths.",
             "beams on the root that finite "
             "elements give")
      .meaning("What the energies of the body lose by area of growth is G.");
  mpm::Simulation run =
      made(drawn(40e-3, 15.1e-3, 5e-3, "t < 1.5e-3 ? 1/3.0 : 0", "  growth: {criterion: energy_balance}\n",
                 ", fracture: {j_ic: 700, speed: 5.19e-4, gain: 1e-12}"));
  double sum = 0.0, last = 0.0;
  int count = 0;
  while (seconds(run) < 5e-3 - 1e-9) {
    run.advance();
    const double release = number(run, "crack 1 end energy_release");
    if (release == last) continue;
    last = release;
    sum += release / release_at(length(run) - 2.0 * 0.5 * kCell, 0.5e-3);
    ++count;
  }
  EXPECT_GE(count, 6);
  // J of a crack that is there has 0.97 to 0.99 at 6 cells an arm (crack reference 7.1), and so has the energy.
  page.near("release by the energies over that of the formula, mean of 6 or more", sum / count, 0.975, 0.025, "");
}

// About 15 s.
TEST(CrackGrowth, StopsByTheBalanceOfEnergy) {
  Page page("crack", "crack_balance", "A slit beam drawn apart until the balance of energy stops its crack");
  page.problem(
          "The slit beam with a crack of 18.1 mm, by the criterion `energy_balance`. Its arms are drawn apart by 0.32 "
          "mm "
          "each in 1 ms, then slowly, in 3 ms, by 0.18 mm more, and held.")
      .exact("a = √(d/2 √(3E'h³/G_c)) - 0.6728 h: 23.42 mm.", "beams on the root that finite elements give")
      .meaning("Growth stops within half a cell of the exact length, as with `release_rate`.");
  // Drag on the arms that are drawn counts as released: little of it, and slow loads.
  std::string text =
      drawn(40e-3, 18.1e-3, 5e-3, "t < 1e-3 ? 0.32 : (t < 4e-3 ? 0.06 : 0)", "  growth: {criterion: energy_balance}\n",
            ", fracture: {j_ic: 200, speed: 1.56e-3, gain: 1}");
  const std::string damping = "60000";
  mpm::Simulation run = made(text.replace(text.find(damping), damping.size(), "20000"));
  run_until(run, 5e-3);
  page.near("a at 0.5 mm", length(run), end_of_crack(0.5e-3), 0.5 * kCell / end_of_crack(0.5e-3), "m");
  // It rests where the last two lengths have released less than their faces take; a length takes 15 J/m² from G here.
  const double release = number(run, "crack 1 end energy_release");
  page.below("release in the last two lengths", release, kToughness, "J/m²");
  EXPECT_GT(release, kToughness - 2 * 15.0);
}

// About 8 s.
TEST(CrackGrowth, LeavesNoStressBehind) {
  Page page("crack", "crack_grown", "A crack that has grown, and one that was there");
  page.problem(
          "A slit beam is drawn apart by 0.01 mm an arm. In one run the crack is 24.1 mm long from the start; in the "
          "other it is 10.1 mm long and grows to this length at 8 m/s (criterion steady_state). Both come to rest.")
      .exact("Elastic bodies forget the way: energy and J are the same.", "uniqueness of the elastic solution")
      .meaning(
          "The energies agree to 1 %. Without the motion that particles feel when growth puts their nodes across the "
          "crack (crack/field_jumps.hpp) a third of the energy released stayed in the material, and J was half as "
          "large.");
  const std::string velocity = "t < 1e-3 ? 0.01 : 0";
  mpm::Simulation whole = made(drawn(40e-3, 24.1e-3, 4e-3, velocity, "", ""));
  run_until(whole, 4e-3);
  mpm::Simulation grown =
      made(drawn(40e-3, 10.1e-3, 4e-3, velocity, "  growth: {criterion: steady_state}\n  length: 1\n  time_factor: 1\n",
                 ", fracture: {start_time: 1e-3, speed: 8, longest: 23.3e-3}"));
  run_until(grown, 4e-3);
  page.near("a", length(grown), length(whole), 0.02 * kCell / length(whole), "m");
  const double energy = whole.state().energy.of("elastic");
  page.near("elastic energy over that of the other run", grown.state().energy.of("elastic") / energy, 1.0, 0.01, "");
  page.near("J over that of the other run", tip(grown, "end").j / tip(whole, "end").j, 1.0, 0.02, "");
}

/// A strip 24 mm wide and 12 mm high whose cracks grow at 400 m/s from the start, whatever J is.
std::string strip(const std::string& list) {
  return head(kCell, {-6e-3, -12.5e-3, 30e-3, 12.5e-3}, 6e-5, 1e-6, 6e4, ", fracture: {start_time: 0, speed: 400}") +
         body(0.0, -kArm, 24e-3, kArm) + "cracks:\n  growth: {criterion: steady_state}\n  list:\n" + list;
}

mpm::Simulation running(const std::string& list) { return made(strip(list)); }

// Two tips that run towards each other become one crack, on one line, where ways cross nothing, and a little aside.
TEST(CrackGrowth, EndsWhereTwoTipsMeet) {
  for (const double aside : {0.0, 0.2 * kCell}) {
    mpm::Simulation run = running(
        fmt::format("    - {{name: left, points: [[0.0003, 0], [0.0061, 0]], start: exterior, end: tip}}\n"
                    "    - {{name: right, points: [[0.0237, {0}], [0.0169, {0}]], start: exterior, end: tip}}\n",
                    aside));
    run_until(run, 6e-5);
    const std::vector<mpm::CrackTipReport> tips = run.crack_tips();
    ASSERT_EQ(tips.size(), 2u);
    EXPECT_EQ(tips[0].growth, "it has met crack 'right'");
    EXPECT_EQ(tips[1].growth, "it has met crack 'left'");
    for (const mpm::CrackTipReport& tip : tips) EXPECT_TRUE(tip.stopped) << tip.crack;
    // Both together, and the step aside from the one to the other, which is shorter than the sum of its legs.
    const double whole = number(run, "crack length 1") + number(run, "crack length 2");
    EXPECT_GE(whole, 23.4e-3 - 1e-6) << aside;
    EXPECT_LE(whole, 23.4e-3 + aside + 1e-6) << aside;
    EXPECT_LT((tips[0].place - tips[1].place).norm(), 0.25 * kCell) << aside;
  }
}

// A tip whose criterion needs no J stops where the material does, a cell beyond its face at most, not at the grid's
// end.
TEST(CrackGrowth, EndsWhereTheMaterialDoes) {
  mpm::Simulation run = running("    - {name: cut, points: [[0.0003, 0], [0.0161, 0]], start: exterior, end: tip}\n");
  run_until(run, 6e-5);
  const mpm::CrackTipReport tip = run.crack_tips().at(0);
  EXPECT_TRUE(tip.stopped);
  EXPECT_EQ(tip.growth, "it has left the material");
  EXPECT_GT(tip.place.x(), 24e-3 - 0.5 * kCell);
  EXPECT_LT(tip.place.x(), 25e-3 + 1e-6);
  EXPECT_FALSE(tip.has_j);
}

// The material that is named holds before growth: that of the strip grows from the start, this one never.
TEST(CrackGrowth, IsByTheMaterialThatIsNamed) {
  for (const bool named : {false, true}) {
    std::string text =
        strip(fmt::format("    - {{name: cut, points: [[0.0003, 0], [0.0061, 0]], start: exterior, end: {}}}\n",
                          named ? "{tip: calm}" : "tip"));
    text.insert(text.find("materials: [") + 12,
                "{name: calm, law: linear_elastic, density: 1000, young: 2.5e9, poisson: 0.33, fracture: {start_time: "
                "1, speed: "
                "400}}, ");
    mpm::Simulation run = made(text);
    run_until(run, 1e-5);
    const mpm::CrackTipReport tip = run.crack_tips().at(0);
    EXPECT_EQ(tip.material, named ? "calm" : "polymer");
    EXPECT_EQ(tip.growths > 0, !named);
  }
}

// Growth by less than the distance at which a tip has met a crack does not meet what it has just grown.
TEST(CrackGrowth, GoesOnBySmallLengths) {
  mpm::Simulation run =
      made(strip("    - {name: cut, points: [[0.0003, 0], [0.0061, 0]], start: exterior, end: tip}\n"
                 "  length: 0.04\n  time_factor: 0.02\n"));
  run_until(run, 2e-5);
  const mpm::CrackTipReport tip = run.crack_tips().at(0);
  EXPECT_FALSE(tip.stopped) << tip.growth;
  EXPECT_GT(tip.growths, 20);
}

// A checkpoint between the step in which a crack grows and the next, which strains particles by what their new nodes
// have opened. About 2 s.
TEST(CrackGrowth, GoesOnFromACheckpointRightAfterIt) {
  const std::string text = with_sync(drawn(18e-3, 6.1e-3, 1e-4, "1", "  growth: {criterion: steady_state}\n",
                                           ", fracture: {start_time: 4e-5, speed: 100, longest: 15e-3}"),
                                     "2e-7");
  constexpr int kPeriods = 400;
  const auto period = [](int n) { return n * 2e-7; };
  mpm::Simulation whole = made(text);
  int grown = -1;  // the last period in which it has grown
  for (int n = 1; n <= kPeriods; ++n) {
    const double before = number(whole, "crack 1 end growth");
    run_until(whole, period(n));
    if (n < kPeriods - 5 && number(whole, "crack 1 end growth") > before) grown = n;
  }
  ASSERT_GT(grown, 200);
  const std::string file = testing::TempDir() + "/crack_growth.h5";
  mpm::Simulation stopped = made(text);
  run_until(stopped, period(grown));
  mpm::save_checkpoint(file, stopped, {"crack.yaml", "text", {}});
  mpm::Simulation resumed = made(text);
  mpm::load_checkpoint(file, resumed, "text");
  run_until(resumed, period(kPeriods));
  EXPECT_EQ(resumed.state_hash(), whole.state_hash());
  EXPECT_EQ(resumed.memory_hash(), whole.memory_hash());
  std::filesystem::remove(file);
}

}  // namespace crack_growth_test
}  // namespace verification
