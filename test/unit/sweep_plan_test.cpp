// Plans of sweeps: which runs they make, with which scenes, and what is refused before any is run.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "mpm/sweep/plan.hpp"
#include "test_files.hpp"

namespace mpm::sweep {
namespace sweep_plan_test {

namespace fs = std::filesystem;

const std::string kScene = "scene: " + data_file("press.yaml") + "\n";

Plan plan_of(const std::string& text) { return parse_plan(kScene + text, "plans/plan.yaml"); }

std::string value_of(const Plan& plan, int run, const std::string& path) {
  for (const Setting& setting : plan.settings(run)) {
    if (setting.path == path) return setting.value;
  }
  return "none";
}

TEST(SweepPlan, CombinesValuesGridsAndListsWithTheLastChangingFastest) {
  const Plan plan = plan_of(R"(parameters:
  materials.foam.young: {grid: {from: 50 kPa, to: 0.2 MPa, count: 3, spacing: log}}
  method.update: {values: [usf, usl]}
runs:
  - {grid.cell: 0.01, time.end: 0.1}
  - {grid.cell: 0.02, time.end: 0.2}
)");
  ASSERT_EQ(plan.runs(), 12);
  EXPECT_EQ(plan.parameters,
            (std::vector<std::string>{"grid.cell", "time.end", "materials.foam.young", "method.update"}));
  EXPECT_EQ(
      plan.settings(1),
      (std::vector<Setting>{
          {"grid.cell", "0.01"}, {"time.end", "0.1"}, {"materials.foam.young", "50 kPa"}, {"method.update", "usf"}}));
  EXPECT_EQ(value_of(plan, 2, "method.update"), "usl");
  EXPECT_EQ(value_of(plan, 3, "materials.foam.young"), "100 kPa");  // the geometric mean of 50 and 200
  EXPECT_EQ(value_of(plan, 6, "materials.foam.young"), "200 kPa");  // in the unit of from
  EXPECT_EQ(value_of(plan, 7, "time.end"), "0.2");
  EXPECT_EQ(value_of(plan, 12, "method.update"), "usl");
  std::set<std::string> different;
  for (int run = 1; run <= 12; ++run) {
    std::string all;
    for (const Setting& setting : plan.settings(run)) all += setting.path + setting.value + ";";
    different.insert(all);
  }
  EXPECT_EQ(different.size(), 12U);
}

TEST(SweepPlan, AGridIsEvenAndWholeNumbersStayWhole) {
  const Plan plan = plan_of(R"(parameters:
  time.cfl: {grid: {from: 0.1, to: 0.7, count: 7}}
  method.particles_per_cell: {grid: {from: 1, to: 4, count: 4}}
)");
  EXPECT_EQ(value_of(plan, 9, "time.cfl"), "0.3");
  EXPECT_EQ(value_of(plan, 28, "time.cfl"), "0.7");
  EXPECT_EQ(value_of(plan, 3, "method.particles_per_cell"), "3");
}

TEST(SweepPlan, MoreDrawsOrOneMoreParameterLeaveTheOthersAsTheyAre) {
  const std::string young = "  materials.foam.young: {log_uniform: {from: 50 kPa, to: 200 kPa}}\n";
  const Plan few = plan_of("draws: {count: 5, seed: 3}\nparameters:\n" + young);
  const Plan more = plan_of("draws: {count: 8, seed: 3}\nparameters:\n" +
                            std::string("  time.cfl: {uniform: {from: 0.2, to: 0.5}}\n") + young +
                            "  grid.cell: {values: [0.01, 0.02]}\n");
  ASSERT_EQ(few.runs(), 5);
  ASSERT_EQ(more.runs(), 16);
  for (int run = 1; run <= 5; ++run) {
    const std::string value = value_of(few, run, "materials.foam.young");
    EXPECT_EQ(value_of(more, 2 * run - 1, "materials.foam.young"), value);
    EXPECT_EQ(value_of(more, 2 * run, "materials.foam.young"), value);
  }
  EXPECT_NE(value_of(few, 1, "materials.foam.young"), value_of(few, 2, "materials.foam.young"));
  const Plan other = plan_of("draws: {count: 5, seed: 4}\nparameters:\n" + young);
  EXPECT_NE(value_of(few, 1, "materials.foam.young"), value_of(other, 1, "materials.foam.young"));
}

TEST(SweepPlan, TextsListsAndMapsAreSetAsTheyStand) {
  const Plan plan = plan_of(R"(parameters:
  rigid_bodies.plate.motion:
    values:
      - {velocity: [0, "t < 0.05 ? -0.2 : 0"]}
      - velocity:
          - 0
          - -0.1
)");
  ASSERT_EQ(plan.runs(), 2);
  EXPECT_EQ(value_of(plan, 1, "rigid_bodies.plate.motion"), R"({velocity: [0, "t < 0.05 ? -0.2 : 0"]})");
  EXPECT_EQ(value_of(plan, 2, "rigid_bodies.plate.motion"), "{velocity: [0, -0.1]}");
  EXPECT_NE(resolve(plan, 1).text.find("t < 0.05 ? -0.2 : 0"), std::string::npos);
}

TEST(SweepPlan, TheSceneOfARunHasItsValuesAndCanLieAnywhere) {
  const fs::path folder = fs::temp_directory_path() / ("mpm_sweep_plan_test_" + std::to_string(getpid()));
  fs::create_directories(folder / "maps");
  std::ofstream(folder / "maps/hill.csv") << "0, 1\n0.01, 0.02\n";
  std::ofstream(folder / "ground.yaml") << R"(geometry: plane_strain
grid: {cell: 0.1, min: [0, 0], max: [1, 1]}
materials: [{name: foam, density: 1000, law: neo_hookean, young: 0.1 MPa, poisson: 0.3}]
bodies: [{name: block, material: foam, shape: {box: {min: [0.2, 0.2], max: [0.6, 0.6]}}}]
rigid_bodies: [{name: tool, shape: {mesh: {file: maps/none.stl}}}]
)";
  std::ofstream(folder / "plan.yaml")
      << "scene: ground.yaml\nset: {time.end: 1}\nparameters: {grid.cell: {values: [0.1]}}\n";
  const Plan plan = read_plan(folder / "plan.yaml");
  EXPECT_NE(base_scene(plan).find((folder / "maps/none.stl").string()), std::string::npos) << base_scene(plan);
  EXPECT_EQ(base_scene(plan).rfind("name: ground\n", 0), 0U);
  fs::remove_all(folder);

  const Plan other = plan_of("set: {time.end: 0.3}\nparameters: {materials.foam.young: {values: [0.2 MPa]}}\n");
  const ResolvedRun run = resolve(other, 1);
  EXPECT_EQ(run.scene.definition.time.end, 0.3);
  EXPECT_GT(run.memory, 160 * 50.0);  // 160 particles of some hundred bytes
  EXPECT_LT(run.memory, 160 * 5000.0);
  const Scene again = parse_scene(run.text, "/elsewhere/scene.yaml");
  EXPECT_EQ(again.definition.name, "press");
  EXPECT_EQ(again.definition.time.end, 0.3);
  EXPECT_EQ(again.text + "\n", run.text);
  EXPECT_EQ(again.definition.materials[0].name, "foam");
  EXPECT_NE(run.text.find("young: 0.2 MPa"), std::string::npos) << run.text;
}

/// Message of reading the plan, or the scene of one of its runs.
std::string refusal(const std::string& text) {
  try {
    const Plan plan = parse_plan(text, "plan.yaml");
    for (int run = 1; run <= plan.runs(); ++run) resolve(plan, run, check_build);
  } catch (const SceneError& error) {
    return error.what();
  }
  return "";
}

TEST(SweepPlan, WhatIsWrongIsToldInASentenceWithItsPlace) {
  const auto expect = [](const std::string& text, const std::string& sentence) {
    EXPECT_EQ(refusal(kScene + text), sentence) << text;
  };
  EXPECT_EQ(refusal("parameters: {grid.cell: {values: [1]}}"), "plan.yaml:1: plan: the key 'scene' is missing; add it");
  EXPECT_EQ(refusal("- 1"), "plan.yaml:1: a plan is a list of 'key: value' lines; found a list");
  expect("parameter: {}", "plan.yaml:2: parameter: unknown key 'parameter'; did you mean 'parameters'?");
  expect("set: {time.end: 1}", "plan.yaml:1: plan: changes nothing from run to run; add parameters, or runs");
  expect("parameters: {materials.foam.yuong: {values: [1 MPa]}}",
         "plan.yaml:2: run 1, materials.foam.yuong = 1 MPa: materials.foam.yuong: unknown key 'yuong'; did you mean "
         "'young'?");
  expect("parameters: {materials.faom.young: {values: [1 MPa]}}",
         "plan.yaml:2: run 1, materials.faom.young = 1 MPa: materials: no element 'faom'; did you mean 'foam'?");
  expect("parameters:\n  materials.foam.poisson: {grid: {from: 0.2, to: 0.6, count: 3}}",
         "plan.yaml:3: run 3, materials.foam.poisson = 0.6: materials.foam.poisson: '0.6' is not below 0.5; write a "
         "number between -1 and 0.5, both excluded");
  expect("parameters: {materials.foam.young: {value: [1 MPa]}}",
         "plan.yaml:2: parameters.materials.foam.young.value: unknown key 'value'; did you mean 'values'? write one of "
         "values, grid, uniform, log_uniform, normal");
  expect("parameters: {time.cfl: {values: []}}",
         "plan.yaml:2: parameters.time.cfl.values: is empty; write one value or more");
  expect("parameters: {time.cfl: {grid: {from: 0.5, to: 0.2, count: 3}}}",
         "plan.yaml:2: parameters.time.cfl.grid.to: '0.2' is not above '0.5'; write the smaller value as from, the "
         "larger one as to");
  expect("parameters: {time.cfl: {grid: {from: 0.2, to: 0.5, count: 1}}}",
         "plan.yaml:2: parameters.time.cfl.grid.count: 1 is not between 2 and 10000");
  expect("parameters: {time.cfl: {grid: {from: 0, to: 0.5, count: 3, spacing: log}}}",
         "plan.yaml:2: parameters.time.cfl.grid.from: '0' is not above 0, where a logarithm begins");
  expect("parameters: {materials.foam.young: {grid: {from: 1 MPa, to: 5 kg, count: 3}}}",
         "plan.yaml:2: parameters.materials.foam.young.grid.to: '5 kg' is a mass, beside a pressure; write both in the "
         "same unit");
  expect("parameters: {materials.foam.young: {grid: {from: 1 MPa, to: 5, count: 3}}}",
         "plan.yaml:2: parameters.materials.foam.young.grid.to: '5' beside a value in MPa; write both with a unit, or "
         "both without");
  expect(
      "parameters: {time.cfl: {uniform: {from: 0.2, to: 0.5}}}",
      "plan.yaml:2: parameters.time.cfl: is drawn; say how often, and from which seed: draws: {count: 100, seed: 1}");
  expect("draws: {count: 3, seed: 1}\nparameters: {time.cfl: {values: [0.2]}}",
         "plan.yaml:2: draws: no parameter is drawn; add one with uniform, log_uniform or normal, or leave it out");
  expect("draws: {count: 3}\nparameters: {time.cfl: {uniform: {from: 0.2, to: 0.5}}}",
         "plan.yaml:2: draws: the key 'seed' is missing; add it");
  expect("draws: {count: 3, seed: 1}\nparameters: {time.cfl: {normal: {mean: 0.2, deviation: 0}}}",
         "plan.yaml:3: parameters.time.cfl.normal.deviation: '0' is not above 0");
  expect(
      "draws: {count: 3, seed: 1}\nparameters: {time.cfl: {normal: {mean: 0.2, deviation: 0.001, from: 0.5}}}",
      "plan.yaml:3: parameters.time.cfl: ten thousand draws lie outside from and to; write bounds nearer to the mean");
  expect("set: {time.cfl: 0.1}\nparameters: {time.cfl: {values: [0.2]}}",
         "plan.yaml:3: parameters.time.cfl: is set twice, also at plan.yaml:2; keep one of them");
  expect("set: {time: {end: 1}}\nparameters: {time.cfl: {values: [0.2]}}",
         "plan.yaml:3: parameters.time.cfl: overlaps 'time', set at plan.yaml:2; leave one of them out");
  expect("runs: [{time.cfl: 0.1}, {time.end: 0.2}]",
         "plan.yaml:2: runs.1: sets other keys than the first of runs, or in another order; set the same ones in each");
  expect("record: [bags]\nruns: [{time.cfl: 0.1}]", "plan.yaml:2: record.0: 'bags' is not known; did you mean 'bag'?");
  expect(
      "parameters: {time.cfl: {grid: {from: 0.1, to: 0.5, count: 1000}}, time.end: {grid: {from: 1, to: 2, count: "
      "1000}}}",
      "plan.yaml:1: plan: has 1000000 runs, more than 100000; write fewer values, or several plans");
  EXPECT_NE(refusal(kScene + "set: {time: {}}\nruns: [{grid.cell: 0.01}]")
                .find("plan.yaml: run 1: time.end: the scene has no end"),
            std::string::npos);
}

TEST(SweepPlan, WhatShowsOnlyWhenASceneIsBuiltIsFoundToo) {
  // The strip is moved out of the grid, which ends at x = 0.2 m.
  const std::string reason = refusal(kScene +
                                     "runs: [{bodies.strip.shape: {box: {min: [0.05, 0], max: [0.15, 0.04]}}}, "
                                     "{bodies.strip.shape: {box: {min: [0.25, 0], max: [0.35, 0.04]}}}]");
  EXPECT_EQ(reason.find("plan.yaml"), 0U) << reason;
  EXPECT_NE(reason.find("run 2"), std::string::npos) << reason;
}

}  // namespace sweep_plan_test
}  // namespace mpm::sweep
