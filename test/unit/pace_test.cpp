// The forecast of a run's pace: the timer of steps against a clock that is made up, its arithmetic, what is proposed to
// reach a pace, and costs that are kept. What is foreseen against what runs take is in rehearsal_test.cpp.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "mpm/pace/changes.hpp"
#include "mpm/pace/kept_costs.hpp"
#include "mpm/scene/scene.hpp"
#include "mpm/simulation/threads.hpp"

namespace pace_test {

namespace fs = std::filesystem;
using namespace mpm;
using namespace mpm::pace;

/// Goes on by a tick whenever it is read.
class MadeUpClock {
 public:
  static constexpr double kTick = 1.0 / 1024.0;  // [s]; sums of it are exact
  double operator()() { return now_ += kTick; }

 private:
  double now_ = 100.0;
};

struct Timed {
  std::optional<StepCost> cost;
  StepReport steps;
};

Timed time_scene(const Scene& scene, double budget, const std::function<bool()>& stop = {}) {
  StepTimer timer(budget, stop, MadeUpClock());
  SimulationOptions options;
  options.threads = 1;
  options.stop = [&timer] { return timer.after_step(); };
  Simulation simulation(build(scene), options);
  Timed timed;
  timed.cost = timer.time(simulation);
  timed.steps = simulation.state().step;
  return timed;
}

TEST(Pace, TheTimerTakesTheMeanOfAllStepsButTheFirst) {
  const Scene scene = load_scene("falling_block");
  // The clock is read at the start and after each step, so ten steps spend ten ticks.
  const Timed timed = time_scene(scene, 10 * MadeUpClock::kTick);
  ASSERT_TRUE(timed.cost);
  EXPECT_EQ(timed.steps.steps, 10U);
  EXPECT_EQ(timed.cost->steps, 9U);
  EXPECT_DOUBLE_EQ(timed.cost->step_seconds, MadeUpClock::kTick);
  EXPECT_DOUBLE_EQ(timed.cost->steps_per_second, 1.0 / timed.steps.dt_last);
}

TEST(Pace, ASingleStepIsBetterThanNone) {
  const Timed timed = time_scene(load_scene("falling_block"), 0.0);
  ASSERT_TRUE(timed.cost);
  EXPECT_EQ(timed.steps.steps, 1U);
  EXPECT_EQ(timed.cost->steps, 1U);
  EXPECT_DOUBLE_EQ(timed.cost->step_seconds, MadeUpClock::kTick);
}

TEST(Pace, TheTimerEndsWithTheSceneAndWhenItIsStopped) {
  const Scene scene = load_scene("falling_block", {"time.end=0.01"});
  const Timed timed = time_scene(scene, 1e6);
  ASSERT_TRUE(timed.cost);
  EXPECT_NEAR(static_cast<double>(timed.steps.steps) * timed.steps.dt_last, 0.01, 1e-12);
  EXPECT_THROW(time_scene(scene, 1e6, [] { return true; }), StoppedError);
}

TEST(Pace, TimeAndPaceFollowFromAStep) {
  Forecast forecast;
  forecast.cost = {0.004, 2000.0, 70};
  forecast.particles = 41600;
  forecast.threads = 2;
  forecast.simulated = 1.5;
  EXPECT_DOUBLE_EQ(forecast.steps(), 3000.0);
  EXPECT_DOUBLE_EQ(forecast.wall_seconds(), 12.0);
  EXPECT_DOUBLE_EQ(forecast.real_time_factor(), 0.125);
  EXPECT_EQ(forecast_text(forecast),
            "0.12 of real time expected on 2 threads; 1.5 s will take 12 s of wall time (3000 steps of 4 ms)");
  forecast.threads = 1;
  forecast.simulated = 0.0;
  EXPECT_EQ(forecast_text(forecast), "0.12 of real time expected on 1 thread (2e+03 steps of 4 ms a simulated second)");
  EXPECT_EQ(duration_text(0.00025), "250 us");
  EXPECT_EQ(duration_text(90.0), "90 s");
  EXPECT_EQ(duration_text(240.0), "4 min");
  EXPECT_EQ(duration_text(9000.0), "2.5 h");
}

// Steps that were timed stand for the run where they are half of it; else the forecast says what it does not know.
TEST(Pace, AForecastSaysWhatItDoesNotKnow) {
  Forecast forecast;
  forecast.cost = {0.004, 2000.0, 70};
  forecast.simulated = 1.5;  // 3000 steps
  forecast.tools = forecast.sleeps = true;
  const auto says = [&](const char* what) { return forecast_text(forecast).find(what) != std::string::npos; };
  EXPECT_FALSE(says("no tool touched"));
  EXPECT_TRUE(says("hardly anything slept when its steps were timed, and what falls asleep makes it faster"));
  forecast.cost.touched = false;
  EXPECT_TRUE(says("; no tool touched when its steps were timed, and contact"));
  forecast.cost.awake = 0.2;  // an eighth of real time with a fifth awake
  EXPECT_TRUE(
      says("; 80 % of the material slept when its steps were timed, and what wakes costs more: down to 0.025 of"));
  forecast.cost.steps = 1500;
  EXPECT_TRUE(forecast.of_run());
  EXPECT_FALSE(says("slept") || says("touched"));
  // The timer sees both: a tool above a block touches it not.
  const Timed timed = time_scene(load_scene("foam_probe"), 3 * MadeUpClock::kTick);
  ASSERT_TRUE(timed.cost);
  EXPECT_FALSE(timed.cost->touched);
  EXPECT_EQ(timed.cost->awake, 1.0);
}

/// A solid with 16 steps in a sync period of 10 ms, at cfl 0.45 with USAVG, that runs at an eighth of real time.
struct Case {
  SimulationDefinition definition;
  Forecast forecast;
  TimedFactors timed;
  Case() {
    definition.geometry = GeometryKind::solid;
    definition.grid.cell = Vec3(0.1, 0.1, 0.1);
    definition.time.sync = 10'000'000;
    definition.time.cfl = 0.45;
    forecast.cost = {0.005, 1600.0, 100};
    timed = {1.5, 2.0, 1.25};
  }
  Plan plan(double wanted) const { return make_plan(definition, forecast, wanted, 2, timed); }
};

std::vector<std::string> names(const std::vector<Change>& changes) {
  std::vector<std::string> list;
  for (const Change& change : changes) list.push_back(change.what);
  return list;
}

using Names = std::vector<std::string>;

TEST(Pace, ARunThatIsFastEnoughNeedsNothing) {
  const Plan plan = Case().plan(0.125);
  EXPECT_TRUE(plan.enough());
  EXPECT_TRUE(plan.changes.empty() && plan.together.empty());
}

TEST(Pace, EachChangeHasItsFactor) {
  const Case given;
  const Plan plan = given.plan(100.0);
  ASSERT_EQ(names(plan.changes),
            Names({"threads=2", "method.precision=single", "time.cfl=0.9", "method.update=usf", "grid.cell=0.2"}));
  const std::vector<double> factors = {1.5, 2.0, 2.0, 1.25, 16.0};  // the cell: 2 to the power of axes and time
  for (std::size_t i = 0; i < factors.size(); ++i) EXPECT_NEAR(plan.changes[i].factor, factors[i], 1e-12) << i;
  // All of them: 16 steps become 4 by cfl and cell, and a particle in eight is left.
  EXPECT_FALSE(plan.enough());
  EXPECT_NEAR(plan.reaches, 0.125 * 1.5 * 2.0 * 1.25 * 4.0 * 8.0, 1e-9);
  EXPECT_NE(plan_text(plan).find("would reach no more than 15"), std::string::npos) << plan_text(plan);
  Case flat = given;
  flat.definition.geometry = GeometryKind::plane_strain;
  EXPECT_NEAR(flat.plan(100.0).changes.back().factor, 8.0, 1e-12);
}

TEST(Pace, TheLeastHarmThatReachesIsTaken) {
  const Case given;
  // 1.5 x 2 = 3 times are 0.375: threads and precision. 2 times are enough for 0.25: then threads do not help.
  EXPECT_EQ(names(given.plan(0.375).together), Names({"threads=2", "method.precision=single"}));
  EXPECT_EQ(names(given.plan(0.25).together), Names({"method.precision=single"}));
  // Two, two and one and a half: 0.75.
  const Plan more = given.plan(0.75);
  EXPECT_EQ(names(more.together), Names({"threads=2", "method.precision=single", "time.cfl=0.9"}));
  EXPECT_NEAR(more.reaches, 0.75, 1e-12);
  EXPECT_EQ(plan_text(more), "threads=2, method.precision=single and time.cfl=0.9 together would reach 0.75");
  // 7.5 times by all but the cell; for 8 times it grows by the least that is tried, with a step fewer of eight.
  const Plan all = given.plan(1.0);
  EXPECT_EQ(names(all.together),
            Names({"threads=2", "method.precision=single", "time.cfl=0.9", "method.update=usf", "grid.cell=0.105"}));
  EXPECT_NEAR(all.reaches, 0.125 * 7.5 * 1.05 * 1.05 * 1.05, 1e-9);  // 8 / 1.05 steps are 8 still
}

TEST(Pace, WhatTheSceneUsesIsNotProposed) {
  Case used;
  used.definition.method.precision = Precision::float32;
  used.definition.method.update = UpdateScheme::usf;
  used.definition.time.cfl = 0.9;
  used.forecast.threads = 2;
  EXPECT_EQ(names(used.plan(100.0).changes), Names({"grid.cell=0.2"}));
  // Nor a larger cfl where the scene's own step is the limit, or a step to a sync period is left.
  Case fixed;
  fixed.definition.time.step = 1.0 / 1600.0;
  Case single;
  single.definition.time.sync = 625'000;
  for (const Case& one : {fixed, single}) {
    for (const std::string& name : names(one.plan(100.0).changes)) EXPECT_NE(name, "time.cfl=0.9");
  }
  EXPECT_NEAR(fixed.plan(100.0).changes.back().factor, 8.0, 1e-12);  // then a wider cell has as many steps
  // APIC's largest step is shorter (doc/methods.md).
  Case affine;
  affine.definition.method.transfer.kind = TransferKind::apic;
  EXPECT_EQ(affine.plan(100.0).changes[2].what, "time.cfl=0.7");
  // Three particles along an edge: to two, (3/2)^3.
  Case many;
  many.definition.method.particles_per_direction = 3;
  EXPECT_EQ(many.plan(100.0).changes[4].what, "method.particles_per_cell=8");
  EXPECT_NEAR(many.plan(100.0).changes[4].factor, 3.375, 1e-12);
}

TEST(Pace, WithoutTimingFactorsAreThoseOfTheTable) {
  Case given;
  given.timed = {};
  for (const Change& change : given.plan(100.0).changes) {
    const bool counted = change.what.rfind("time.", 0) == 0 || change.what.rfind("grid.", 0) == 0;
    EXPECT_EQ(change.origin == "doc/performance.md", !counted) << change.what;
  }
}

class KeptCostsTest : public ::testing::Test {
 protected:
  KeptCostsTest() : folder_(fs::temp_directory_path() / ("mpm_kept_costs_" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~KeptCostsTest() override { fs::remove_all(folder_); }
  std::string file() const { return (folder_ / "made" / "on_demand.csv").string(); }
  const KeptCost cost_{{0.0123, 1400.0, 70, 0.25, false, 2.5}, 2, 41600, 1'000'000};
  fs::path folder_;
};

TEST_F(KeptCostsTest, AreFoundForADay) {
  const KeptCosts costs(file());
  EXPECT_FALSE(costs.find("a", 1'000'000));
  ASSERT_TRUE(costs.keep("a", cost_));
  const auto found = costs.find("a", 1'000'000 + 86'400);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->cost.step_seconds, 0.0123);
  EXPECT_EQ(found->cost.steps_per_second, 1400.0);
  EXPECT_EQ(found->cost.steps, 70U);
  EXPECT_EQ(found->cost.awake, 0.25);
  EXPECT_FALSE(found->cost.touched);
  EXPECT_EQ(found->cost.rehearsed, 2.5);
  EXPECT_EQ(found->threads, 2);
  EXPECT_EQ(found->particles, 41600U);
  EXPECT_FALSE(costs.find("a", 1'000'000 + 86'401));
  EXPECT_FALSE(costs.find("a", 999'999));
  EXPECT_FALSE(costs.find("b", 1'000'000));
}

TEST_F(KeptCostsTest, TheNewestIsKeptAndTheFileStaysSmall) {
  const KeptCosts costs(file());
  for (int i = 0; i < 250; ++i) {
    KeptCost one = cost_;
    one.particles = static_cast<std::uint64_t>(i);
    ASSERT_TRUE(costs.keep(i % 2 == 0 ? "a" : std::to_string(i), one));
  }
  EXPECT_EQ(costs.find("a", 1'000'000)->particles, 248U);
  std::ifstream file(costs.path());
  const auto lines = std::count(std::istreambuf_iterator<char>(file), {}, '\n');
  EXPECT_EQ(lines, 127);  // a head, 125 odd ones, "a"
  for (int i = 0; i < 200; ++i) ASSERT_TRUE(costs.keep("more" + std::to_string(i), cost_));
  EXPECT_FALSE(costs.find("a", 1'000'000));
}

TEST_F(KeptCostsTest, AFileThatIsNoneIsAsGoodAsNone) {
  EXPECT_FALSE(KeptCosts("").keep("a", cost_));
  EXPECT_FALSE(KeptCosts("").find("a", 1'000'000));
  EXPECT_FALSE(KeptCosts("/proc/none/costs.csv").keep("a", cost_));
  const std::string damaged = (folder_ / "damaged.csv").string();
  ASSERT_TRUE(KeptCosts(damaged).keep("a", cost_));
  std::ofstream(damaged, std::ios::app) << "b,nan,1400,70,2,41600,1000000\nc,1e-3\n\xff,,,\nd,-1,1,1,1,1,1000000\n";
  for (const char* key : {"b", "c", "d"}) EXPECT_FALSE(KeptCosts(damaged).find(key, 1'000'000)) << key;
  EXPECT_TRUE(KeptCosts(damaged).find("a", 1'000'000));
  std::ofstream(damaged) << "something else\na,0.1,1400,70,2,41600,1000000\n";
  EXPECT_FALSE(KeptCosts(damaged).find("a", 1'000'000));
  const std::string pipe = (folder_ / "pipe").string();
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_FALSE(KeptCosts(pipe).find("a", 1'000'000));  // and does not wait for somebody to write
  EXPECT_FALSE(KeptCosts(pipe).keep("a", cost_));
}

TEST_F(KeptCostsTest, BelongToSceneInstructionSetAndThreads) {
  const std::string key = cost_key("scene", Isa::plain, 1);
  EXPECT_EQ(key, cost_key("scene", Isa::plain, 1));
  EXPECT_NE(key, cost_key("another", Isa::plain, 1));
  EXPECT_NE(key, cost_key("scene", Isa::avx2, 1));
  EXPECT_NE(key, cost_key("scene", Isa::plain, 2));
}

TEST(Pace, ThreadsAreThoseThatPay) {
  EXPECT_EQ(useful_threads(100), 1);
  EXPECT_EQ(useful_threads(7'999), 1);
  EXPECT_EQ(useful_threads(1'000'000'000), machine_threads());
}

}  // namespace pace_test
