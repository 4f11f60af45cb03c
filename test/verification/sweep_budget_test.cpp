// Sweeps that end by the wall clock (time.budget): a budget that is always used up leaves ten sweeps, exact momentum
// and a run that goes on; one that never is changes no bit; and the sweeps of one run can be made again. Nothing here
// depends on how fast the machine is. Cost: 1 s.
#include "mpm/implicit/sweep_budget.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "mpm/checkpoint/checkpoint.hpp"
#include "scene_run.hpp"

namespace sweep_budget_test {

constexpr const char* kUsedUp = "1 ns";  // by the time that the first sweeps begin
constexpr const char* kAmple = "1000 s";

/// A blade drawn through sand, whose steps make 30 sweeps and more when they are let.
std::string bed(const std::string& budget) {
  return fmt::format(
      "geometry: plane_strain\ngravity: [0, -9.81]\nmethod: {{update: implicit}}\n"
      "grid: {{cell: 0.05, min: [0, 0], max: [1.6, 0.6]}}\ntime: {{end: 1, sync: 0.02, step: 0.01{}}}\n"
      "materials: [{{name: sand, law: mohr_coulomb, density: 1600, young: 2 MPa, poisson: 0.3, friction_angle: 30 deg, "
      "cohesion: 0}}]\n"
      "bodies: [{{name: sand, material: sand, shape: {{box: {{min: [0, 0], max: [1.6, 0.4]}}}}, cut_out: [blade]}}]\n"
      "rigid_bodies: [{{name: blade, shape: {{box: {{size: [0.1, 0.5]}}}}, pose: {{position: [0.4, 0.5]}}, "
      "friction: 0.3, motion: {{velocity: [0.3, 0]}}}}]\n"
      "boundaries: {{x_min: slip, x_max: slip, z_min: {{friction: 0.577}}}}\n",
      budget.empty() ? "" : ", budget: " + budget);
}

mpm::Simulation start(const std::string& budget, int threads = 1) {
  return mpm::Simulation(mpm::build(mpm::parse_scene(bed(budget), "sweep_budget", {})), {threads});
}

TEST(SweepBudget, UsedUpLeavesTenSweepsAndExactMomentum) {
  mpm::Simulation run = start(kUsedUp);
  while (verification::seconds(run) < 0.5) {
    run.advance();
    ASSERT_EQ(verification::number(run, "sweeps"), mpm::kLeastSweeps);
    ASSERT_FALSE(run.budget()->cut().empty());
    for (const mpm::CutStep& cut : run.budget()->cut()) ASSERT_EQ(cut.sweeps, mpm::kLeastSweeps);
    ASSERT_EQ(run.budget()->cut().back().step, run.state().step.steps);
    ASSERT_TRUE(std::isfinite(run.budget()->cut_error()));
  }
  EXPECT_EQ(verification::number(run, "sweeps_cut"), static_cast<double>(run.state().step.steps));
  EXPECT_GT(run.budget()->cut_error(), 0.0);
  EXPECT_LT(run.state().audit.residual, 1e-12);
  ASSERT_TRUE(run.budget()->least().has_value());
  EXPECT_GT(*run.budget()->least(), run.budget()->seconds());
}

TEST(SweepBudget, AmpleChangesNoBit) {
  mpm::Simulation without = start(""), with = start(kAmple);
  verification::run_until(without, 0.4);
  verification::run_until(with, 0.4);
  EXPECT_EQ(with.state_hash(), without.state_hash());
  EXPECT_EQ(verification::number(with, "sweeps_cut"), 0.0);
  EXPECT_GT(verification::number(with, "sweeps"), mpm::kLeastSweeps);
  EXPECT_EQ(with.budget()->cut_error(), 0.0);
  EXPECT_EQ(without.budget(), nullptr);
  for (const mpm::NamedNumber& one : without.numbers()) EXPECT_NE(one.name, "sweeps_cut");
}

// Steps that one run cut another that has all the time cuts too, with the same bits on another number of threads; and
// after a checkpoint, which knows how many steps there were.
TEST(SweepBudget, IsRepeatedWithoutAClock) {
  mpm::Simulation first = start(kUsedUp);
  std::vector<mpm::CutStep> cuts;
  const std::string file = (std::filesystem::temp_directory_path() / "sweep_budget.h5").string();
  while (verification::seconds(first) < 0.4) {
    first.advance();
    for (const mpm::CutStep& cut : first.budget()->cut()) cuts.push_back(cut);
    if (verification::seconds(first) < 0.2 && verification::seconds(first) > 0.17)
      mpm::save_checkpoint(file, first, {"", bed(kUsedUp), {}});
  }
  mpm::Simulation again = start(kAmple, 2);
  again.repeat_cuts(cuts);
  verification::run_until(again, 0.4);
  EXPECT_EQ(again.memory_hash(), first.memory_hash());
  mpm::Simulation resumed = start(kUsedUp);
  mpm::load_checkpoint(file, resumed, bed(kUsedUp));
  resumed.repeat_cuts(cuts);
  verification::run_until(resumed, 0.4);
  EXPECT_EQ(resumed.memory_hash(), first.memory_hash());
  std::filesystem::remove(file);
}

// Only the steps of the list are cut, each after its own number of sweeps; the others go on as they would.
TEST(SweepBudget, RepeatsTheNumberOfEachStep) {
  mpm::Simulation run = start(kUsedUp);
  run.repeat_cuts({{3, 14}, {40, 11}});
  std::vector<mpm::CutStep> cuts;
  while (verification::seconds(run) < 0.4) {
    run.advance();
    for (const mpm::CutStep& cut : run.budget()->cut()) cuts.push_back(cut);
  }
  ASSERT_EQ(cuts.size(), 2U);
  EXPECT_EQ(cuts[0].step, 3U);
  EXPECT_EQ(cuts[0].sweeps, 14);
  EXPECT_EQ(cuts[1].step, 40U);
  EXPECT_EQ(cuts[1].sweeps, 11);
}

// A number of sweeps that the scene prescribes is the most that a budget allows.
TEST(SweepBudget, EndsPrescribedSweepsToo) {
  const mpm::Scene scene = mpm::parse_scene(bed(kUsedUp), "sweep_budget", {"method.sweeps=25"});
  mpm::Simulation run(mpm::build(scene), {1});
  run.advance();
  EXPECT_EQ(verification::number(run, "sweeps"), mpm::kLeastSweeps);
}

}  // namespace sweep_budget_test
