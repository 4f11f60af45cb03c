// Two blocks that tractions hold together: what each law of tractions takes and gives back; faces joined by an
// interface; and a crack that grows at a constant speed.
//
// Blocks that move apart as rigid ones, of mass m and speed v each, have the energy m v^2. It goes into the work of the
// tractions, W(opening) times the area of the crack: in part dissipated, G_c where they have parted, and in part
// stored. Source: crack reference 5.5, 7.12, 7.14, 7.15.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "mpm/scene/scene.hpp"
#include "mpm/simulation/simulation.hpp"
#include "page.hpp"
#include "scene_run.hpp"

namespace verification {
namespace crack_cohesive_test {

using Changes = std::vector<std::string>;

constexpr double kHalf = 1000.0 * 0.8125 * 1.5, kArea = 1.375;  // mass of a block [kg], area of the crack [m^2]

// 13 by 12 cells. A wave crosses a block in 2.6 ms; the blocks part within 50 ms.
const std::string kBlocks = R"yaml(
geometry: plane_strain
grid: {cell: 0.125, min: [-0.75, -0.75], max: [2.375, 2.25]}
time: {end: 1, sync: 0.25 ms, cfl: 0.4}
method: {shape: ugimp, update: usavg, transfer: flip}
materials: [{name: stiff, density: 1000, law: linear_elastic, young: 100 MPa, poisson: 0}]
bodies: [{name: blocks, material: stiff, shape: {box: {min: [0, 0], max: [1.625, 1.5]}}}]
cracks:
  list: [{name: seam, line: {from: [0.8125, 0.0625], to: [0.8125, 1.4375]}, start: exterior, end: exterior}]
)yaml";

mpm::Simulation simulation_of(const Changes& changes) {
  return mpm::Simulation(mpm::parse_scene(kBlocks, "blocks.yaml", changes), {1});
}

double energy(const mpm::Simulation& simulation, const std::string& name) {
  const mpm::EnergyReport report = simulation.state().energy;
  for (const mpm::NamedEnergy& one : report.list()) {
    if (one.name == name) return one.value;
  }
  ADD_FAILURE() << "no energy " << name;
  return 0.0;
}

/// Mean velocity of the right block along x [m/s].
double mean_velocity(const mpm::Simulation& simulation) {
  const std::vector<double> x = field(simulation, "x"), v = field(simulation, "vx");
  double sum = 0.0;
  int count = 0;
  for (std::size_t p = 0; p < x.size(); ++p) {
    if (x[p] < 0.8125) continue;
    sum += v[p];
    ++count;
  }
  return sum / count;
}

struct Law {
  std::string name, text;
};
// All of strength 800 Pa and toughness 4 J/m^2.
const std::vector<Law>& laws() {
  static const std::vector<Law> all = {
      {"triangular", "{kind: triangular, normal: {strength: 800, toughness: 4}}"},
      {"cubic", "{kind: cubic, normal: {strength: 800, toughness: 4}}"},
      {"trilinear",
       "{kind: trilinear, normal: {strength: 800, elastic: 2 mm, strength_2: 400, elastic_2: 6 mm, opening: 10 mm}}"},
      {"exponential", "{kind: exponential, normal: {strength: 800, toughness: 4, elastic: 2 mm, decay: 2}}"},
      {"coupled", "{kind: coupled, normal: {strength: 800, toughness: 4}}"},
      {"mixed", "{kind: mixed, normal: {strength: 800, toughness: 4}}"}};
  return all;
}

Changes glued(const Law& law, double speed) {
  return {"cracks.traction_laws={glue: " + law.text + "}", "cracks.list.seam.traction=glue",
          fmt::format("bodies.blocks.initial.velocity=[\"x<0.8125 ? -{0} : {0}\", 0]", speed)};
}

TEST(CrackCohesive, BlocksPartAtTheToughness) {
  Page page("crack", "cohesive_blocks", "Two blocks that part against tractions");
  page.problem(
          "Two blocks of 6.5 by 12 cells, 1219 kg each, leave each other at 0.1 m/s; the crack between them carries "
          "tractions of each law, of strength 800 Pa and toughness 4 J/m².")
      .exact("Dissipated: 4 J/m² times 1.375 m². Largest force: 800 Pa times that area.", "the laws' definitions")
      .meaning(
          "The energy that a law of tractions takes is that of its definition to round-off, since each point of the "
          "crack keeps account of its own damage.");
  Panel& panel = page.figure().panel("Force between the blocks", "time [ms]", "force / area [Pa]");
  for (const Law& law : laws()) {
    mpm::Simulation simulation = simulation_of(glued(law, 0.1));
    const double start = energy(simulation, "kinetic");
    EXPECT_NEAR(start, kHalf * 0.01, 1e-9);
    Numbers times, stresses;
    double before = mean_velocity(simulation), most = 0.0;
    while (seconds(simulation) < 0.12) {
      simulation.advance();
      const double now = mean_velocity(simulation);
      times.push_back(1e3 * seconds(simulation));
      stresses.push_back(kHalf * (before - now) / 0.25e-3 / kArea);
      most = std::max(most, stresses.back());
      before = now;
    }
    // The peak is taken over 0.05 mm of opening, of 2 mm, and the blocks still ring from the start.
    page.near("largest force over area, " + law.name, most, 800.0, 0.01, "Pa");
    page.near("dissipated over area, " + law.name, energy(simulation, "crack_separation") / kArea, 4.0, 1e-6, "J/m²");
    EXPECT_NEAR(energy(simulation, "crack_tractions"), 0.0, 1e-12) << law.name;
    // Energy that the blocks have lost, up to what the time step leaves open.
    page.near("kinetic and elastic energy lost, over area, " + law.name,
              (start - energy(simulation, "kinetic") - energy(simulation, "elastic")) / kArea, 4.0, 0.002, "J/m²");
    EXPECT_LT(simulation.state().audit.residual, 1e-12) << law.name;
    panel.line(law.name, times, stresses);
  }
}

// Too slow to part: the blocks turn back along the line to the origin. At the turn W(opening) = m v^2 / area; what has
// been dissipated then stays, and the rest is given back (triangular law).
TEST(CrackCohesive, UnloadsToTheOrigin) {
  mpm::Simulation simulation = simulation_of(glued(laws()[0], 0.05));
  const double start = energy(simulation, "kinetic");
  const double u_c = 0.01, u_e = 0.225926299 * u_c, work = start / kArea;
  // W = 1/2 s [u (u_c - u) + u_c (u - u_e)] / (u_c - u_e); here s u_c / 2 = 4, Omega = 4 (u - u_e) / (u_c - u_e).
  double low = u_e, high = u_c;
  for (int k = 0; k < 100; ++k) {
    const double u = 0.5 * (low + high);
    (400.0 * (u * (u_c - u) + u_c * (u - u_e)) / (u_c - u_e) < work ? low : high) = u;
  }
  const double dissipated = 4.0 * (low - u_e) / (u_c - u_e);
  EXPECT_GT(dissipated, 0.2);
  EXPECT_LT(dissipated, 3.8);
  double largest = 0.0;
  while (mean_velocity(simulation) > 0.0) simulation.advance();
  while (energy(simulation, "crack_tractions") > 1e-3 * start) {
    simulation.advance();
    largest = std::max(largest, energy(simulation, "crack_tractions"));
    ASSERT_LT(seconds(simulation), 0.3);
  }
  // Blocks that ring open a little farther than rigid ones.
  EXPECT_NEAR(energy(simulation, "crack_separation") / kArea, dissipated, 0.02 * dissipated);
  EXPECT_NEAR(largest / kArea, work - dissipated, 0.02 * work);
  EXPECT_NEAR(energy(simulation, "kinetic") / kArea, work - dissipated, 0.02 * work);
}

// Pulled by a stress s: an interface of stiffness D opens by s / D, beside the s L / E of the blocks.
TEST(CrackCohesive, InterfaceOpensByItsStiffness) {
  const auto elongation = [](const Changes& changes) {
    Changes all = {
        "loads=[{traction: {body: blocks, edge: x_max, traction: [\"1000*min(t/0.02,1)\", 0]}}, {traction: "
        "{body: blocks, edge: x_min, traction: [\"-1000*min(t/0.02,1)\", 0]}}]",
        "method.damping={grid: 200}", "time.sync=1 ms"};
    all.insert(all.end(), changes.begin(), changes.end());
    mpm::Simulation simulation = simulation_of(all);
    while (seconds(simulation) < 0.15) simulation.advance();
    const std::vector<double> u = field(simulation, "ux");
    return *std::max_element(u.begin(), u.end()) - *std::min_element(u.begin(), u.end());
  };
  // Outermost particles are 1.5625 m apart.
  const double whole = elongation({"cracks.list.seam.faces={law: one_field}"});
  EXPECT_NEAR(whole, 1000.0 * 1.5625 / 1e8, 0.005 * whole);
  for (const double stiffness : {1e8, 1e7}) {
    const double joined =
        elongation({fmt::format("cracks.list.seam.faces={{law: interface, normal: {0}, tangential: {0}}}", stiffness)});
    // Its area is that of nodes, which reaches over the ends of the crack.
    EXPECT_NEAR(joined - whole, 1000.0 / stiffness, 0.05 * 1000.0 / stiffness) << stiffness;
  }
  EXPECT_NEAR(elongation({"cracks.list.seam.faces={law: interface, normal: perfect, tangential: perfect}"}), whole,
              0.01 * whole);
}

// Tractions of pure shear on all four sides: no block turns, and faces that are joined by an interface of stiffness D
// slide by s / D (crack reference 7.12).
TEST(CrackCohesive, InterfaceSlidesByItsStiffness) {
  Page page("crack", "interface_shear", "Faces joined by an interface, in shear");
  page.problem(
          "A block of 13 by 12 cells, 1.625 m by 1.5 m, E = 100 MPa, ν = 0, with a crack across its middle whose faces "
          "an interface joins, under shear tractions of 1 kPa on its four sides.")
      .exact("The faces slide by s / D.", "the interface's definition; uniform shear is a solution for any D")
      .meaning(
          "The area of the interface is that of nodes, which reaches over the ends of the crack by a few per cent.");
  const auto slip = [](const std::string& faces) {
    const auto side = [](const char* edge, const char* along, const char* up) {
      return fmt::format("{{traction: {{body: blocks, edge: {}, traction: [{}, {}]}}}}", edge, along, up);
    };
    const char *plus = "\"1000*min(t/0.02,1)\"", *minus = "\"-1000*min(t/0.02,1)\"";
    mpm::Simulation simulation =
        simulation_of({fmt::format("loads=[{}, {}, {}, {}]", side("x_max", "0", plus), side("x_min", "0", minus),
                                   side("z_max", plus, "0"), side("z_min", minus, "0")),
                       "method.damping={grid: 200}", "time.sync=1 ms", "cracks.list.seam.faces=" + faces});
    const std::vector<double> x = field(simulation, "x");
    while (seconds(simulation) < 0.15) simulation.advance();
    const std::vector<double> u = field(simulation, "uz");
    // Sums of the columns of particles beside the crack, 62.5 mm apart.
    double sum[2] = {0.0, 0.0};
    int count = 0;
    for (std::size_t p = 0; p < x.size(); ++p) {
      if (std::abs(x[p] - 0.8125) > 0.04) continue;
      sum[x[p] > 0.8125] += u[p];
      ++count;
    }
    EXPECT_EQ(count, 48);
    return 2.0 * (sum[1] - sum[0]) / count;
  };
  const double whole = slip("{law: one_field}");
  for (const double stiffness : {1e8, 1e7}) {
    const double joined = slip(fmt::format("{{law: interface, normal: {0}, tangential: {0}}}", stiffness));
    page.near(fmt::format("slip, D = {:.0e} N/m³", stiffness), joined - whole, 1000.0 / stiffness, 0.05, "m");
  }
  page.near("shear between the columns, perfect interface",
            slip("{law: interface, normal: perfect, tangential: perfect}"), whole, 0.02, "m");
}

// A beam of two arms, 6.5 cells each, opened by moments at its end; a seam ahead of the notch is glued.
const std::string kArms = R"yaml(
geometry: plane_strain
thickness: 1 mm
grid: {cell: 1 mm, min: [-4 mm, -4 mm], max: [48 mm, 17 mm]}
time: {end: 0.7 ms, cfl: 0.6, sync: 0.02 ms}
method: {shape: ugimp, update: usavg, transfer: flip, damping: {grid: "2e4"}}
materials: [{name: polymer, law: linear_elastic, density: 1000, young: 2500 MPa, poisson: 0.33}]
bodies: [{name: beam, material: polymer, shape: {box: {min: [0, 0], max: [44 mm, 13 mm]}}}]
cracks:
  list:
    - {name: notch, line: {from: [0.3 mm, 6.5 mm], to: [16.1 mm, 6.5 mm]}, start: exterior, end: none}
    - {name: seam, line: {from: [16.1 mm, 6.5 mm], to: [43.7 mm, 6.5 mm]}, start: none, end: exterior, traction: glue}
)yaml";

/// Length of the seam that has come apart after 0.7 ms [m], of moments that are `part` of those of the toughness.
double debonded(const std::string& kind, double part) {
  const double modulus = 2500e6 / (1.0 - 0.33 * 0.33), arm = 6.5e-3;
  const double moment = part * std::sqrt(20.0 * modulus * arm * arm * arm / 12.0);  // over the width [N]
  mpm::Simulation simulation(
      mpm::parse_scene(
          kArms, "arms.yaml",
          {fmt::format("cracks.traction_laws={{glue: {{kind: {}, normal: {{strength: 3 MPa, toughness: 20}}}}}}", kind),
           fmt::format("loads=[{{traction: {{body: beam, edge: x_min, traction: "
                       "[\"{:.10g}*(abs(Z-6.5e-3)-3.25e-3)*min(t/0.3e-3,1)\", 0]}}}}]",
                       12.0 * moment / (arm * arm * arm))}),
      {1});
  while (seconds(simulation) < 0.7e-3 - 1e-9) simulation.advance();
  return simulation.state().number("debonded crack length 2");
}

// J = 12 M^2 / (E' B^2 h^3), whatever the law of tractions and the length of the notch: the seam holds below the
// moment at which J is the toughness, and parts above it, by as much for one law as for another (crack reference 7.3).
TEST(CrackCohesive, EndMomentsPartAGluedSeam) {
  std::vector<double> above;
  for (const char* kind : {"triangular", "cubic"}) {
    EXPECT_EQ(debonded(kind, 0.9), 0.0) << kind;
    above.push_back(debonded(kind, 1.05));
    EXPECT_GT(above.back(), 0.5e-3) << kind;
  }
  EXPECT_NEAR(above[0], above[1], 0.5e-3);  // one point of the chain
}

// A law 20 times as stiff as what the waves' step allows limits the steps from the first one on. Nodes do not change
// where the blocks rest, so that all periods have as many steps.
TEST(CrackCohesive, StiffLawLimitsTheFirstStepToo) {
  mpm::Simulation simulation = simulation_of(
      {"cracks.traction_laws={glue: {kind: linear, normal: {stiffness: 1e12}}}", "cracks.list.seam.traction=glue"});
  std::uint64_t before = 0;
  std::vector<std::uint64_t> steps;
  for (int k = 0; k < 3; ++k) {
    simulation.advance();
    steps.push_back(simulation.state().step.steps - before);
    before += steps.back();
    EXPECT_NE(simulation.state().step.limited_by.find("stiffest law of tractions"), std::string::npos);
  }
  // Without the law a wave of 316 m/s crosses 0.4 cells in a step: two in a period of 0.25 ms.
  EXPECT_GT(steps[0], 10u);
  EXPECT_EQ(steps[1], steps[0]);
  EXPECT_EQ(steps[2], steps[0]);
}

// A tip that leaves a stiff law behind grows within a period, whose steps have to be short enough from its start.
TEST(CrackCohesive, LawOfGrowthLimitsTheStepsBeforeIt) {
  mpm::Simulation simulation = simulation_of(
      {"cracks.traction_laws={glue: {kind: linear, normal: {stiffness: 1e12}}}",
       "cracks.list=[{name: seam, line: {from: [0.8125, 0.0625], to: [0.8125, 0.70]}, start: exterior, end: tip}]",
       "cracks.growth={criterion: steady_state, traction: glue}",
       "materials=[{name: stiff, density: 1000, law: linear_elastic, young: 100 MPa, poisson: 0, fracture: "
       "{start_time: 1e-4, speed: 100}}]"});
  simulation.advance();
  const double first = simulation.state().step.dt_last;
  while (number(simulation, "crack 1 end growth") < 0.3) simulation.advance();
  // Points of the chain stand for other lengths than growth adds, and their nodes for other parts of a cell.
  const double later = simulation.state().step.dt_last;
  EXPECT_LE(first, 1.001 * later);
  EXPECT_GT(first, 0.5 * later);
}

// The load at which the seam begins to part, for laws of the same strength and toughness. The moments grow within 1.5
// ms, six periods of the arms.
TEST(CrackCohesive, SeamPartsAtTheMomentOfItsToughness) {
  Page page("crack", "cohesive_moments", "A glued seam that moments part");
  page.problem(
          "A beam of two arms 6.5 mm high, 6.5 cells each, with a notch of 16.1 mm and a seam ahead of it that carries "
          "tractions of strength 3 MPa and toughness 20 J/m²; moments at the arms' ends grow slowly.")
      .exact("The notch's end parts at M = B √(G_c E' h³/12), whatever the law.", "J = 12 M²/(E'B²h³); Rice (1968)")
      .meaning(
          "The moment does not depend on the shape of the law, but it is 12 to 15 % above the exact one here, and 9 % "
          "where the load takes 6 ms. J of the notch alone is exact (the beam bent open, above), and each point of the "
          "seam dissipates its toughness; but before the seam parts the loads have done 12 % more work than there is "
          "elastic energy and energy of tractions. Why is not known.");
  const double modulus = 2500e6 / (1.0 - 0.33 * 0.33), arm = 6.5e-3;
  const double critical = std::sqrt(20.0 * modulus * arm * arm * arm / 12.0);  // over the width [N]
  double first = 0.0;
  for (const auto& [name, law] :
       std::vector<std::pair<std::string, std::string>>{{"triangular", "{strength: 3 MPa, toughness: 20}"},
                                                        {"cubic", "{strength: 3 MPa, toughness: 20}"},
                                                        {"trilinear",
                                                         "{strength: 3 MPa, elastic: 0.002 mm, strength_2: 1.5 MPa, "
                                                         "elastic_2: 0.006 mm, opening: 0.016666667 mm}"}}) {
    mpm::Simulation simulation(
        mpm::parse_scene(
            kArms, "arms.yaml",
            {"time.end=2.1 ms", fmt::format("cracks.traction_laws={{glue: {{kind: {}, normal: {}}}}}", name, law),
             fmt::format("loads=[{{traction: {{body: beam, edge: x_min, traction: "
                         "[\"{:.10g}*(abs(Z-6.5e-3)-3.25e-3)*t/1.5e-3\", 0]}}}}]",
                         12.0 * critical / (arm * arm * arm))}),
        {1});
    double parted = 0.0;
    while (parted == 0.0 && seconds(simulation) < 2.0e-3) {
      simulation.advance();
      if (simulation.state().number("debonded crack length 2") > 0.0) parted = seconds(simulation) / 1.5e-3;
    }
    EXPECT_GT(parted, 0.0) << name;
    // 12 to 15 % high, as the page says; looks are 1.3 % of the load apart.
    page.near("moment at which the seam begins to part over the critical one, " + name, parted, 1.0, 0.17, "");
    if (first == 0.0) {
      first = parted;
    } else {
      page.near("that moment over the one of the triangular law, " + name, parted / first, 1.0, 0.03, "");
    }
  }
}

// A tip that grows at 5 m/s from 10 ms on until the crack is 1 m long.
TEST(CrackCohesive, SteadyGrowth) {
  mpm::Simulation simulation =
      simulation_of({"cracks.list.seam.line={from: [0.8125, 0.0625], to: [0.8125, 0.5]}", "cracks.list.seam.end=tip",
                     "materials.stiff.fracture={speed: 5, start_time: 10 ms, longest: 1}",
                     "cracks.growth={criterion: steady_state}"});
  const double step = 0.0625;
  double stopped = 0.0;
  while (seconds(simulation) < 0.2) {
    simulation.advance();
    const double t = seconds(simulation), growth = simulation.state().number("crack 1 end growth");
    const double wanted = std::clamp(5.0 * (t - 0.01), 0.0, 1.0 - 0.4375);
    ASSERT_NEAR(growth, wanted, step * (1.0 + 1e-9)) << t;
    ASSERT_NEAR(simulation.state().number("crack length 1"), 0.4375 + growth, 1e-9) << t;
    stopped = growth;
  }
  // 0.5625 m is 9 steps.
  EXPECT_NEAR(stopped, 0.5625, 1e-9);
}

}  // namespace crack_cohesive_test
}  // namespace verification
