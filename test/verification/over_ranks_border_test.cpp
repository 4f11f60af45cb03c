// Tests of what crosses a border between ranks, or happens on one side of it alone: a tool that ploughs through the
// material of several ranks, a run that is asked to stop on one of them, and one that fails there. Ranks are threads.
// Cost: 3 s.
#include <gtest/gtest.h>

#include <atomic>

#include "mpm/simulation/rank_failure.hpp"
#include "over_ranks_run.hpp"
#include "rank_counts.hpp"

namespace verification {
namespace over_ranks {
namespace over_ranks_border_test {

/// Forces on the first tool, of each step.
std::vector<mpm::Vec3> history_of(mpm::Simulation& simulation, double& pressing) {
  std::vector<mpm::Vec3> forces;
  while (seconds(simulation) < simulation.definition().time.end - 1e-9) {
    simulation.advance();
    const mpm::ContactReport report = simulation.take_contact(0);
    forces.push_back(report.mean.force);
    pressing = std::max(pressing, report.pressing);
  }
  EXPECT_LT(simulation.state().audit.residual, 1e-10);
  return forces;
}

// A third of the bed is in the way of the blade, and each of eight ranks has an eighth of it: it passes two borders at
// least. Grains on its way press and slide, which makes more of round-off than a hundred steps of the other tests: 1e-9
// of what presses.
TEST(OverRanksBorder, AToolFeelsNoSeam) {
  const Case run{"ranks_plough", {}};
  const auto history_over = [&](int count, double& pressing) {
    std::vector<mpm::Vec3> of_first;
    mpm::run_ranks(count, [&](mpm::Communicator& ranks) {
      mpm::Simulation simulation = start_on(run, &ranks);
      double own = 0.0;
      std::vector<mpm::Vec3> forces = history_of(simulation, own);
      if (!ranks.first()) return;
      of_first = std::move(forces);
      pressing = own;
    });
    return of_first;
  };
  double pressing = 0.0;
  const std::vector<mpm::Vec3> one = history_over(1, pressing);
  ASSERT_GT(one.size(), 300U);
  ASSERT_GT(pressing, 0.0);
  for (const int count : mpm::test::rank_counts({2, 8}, 2)) {
    SCOPED_TRACE(count);
    double ignored = 0.0;
    const std::vector<mpm::Vec3> over = history_over(count, ignored);
    ASSERT_EQ(over.size(), one.size());
    double most = 0.0;
    for (std::size_t i = 0; i < one.size(); ++i) most = std::max(most, (over[i] - one[i]).norm());
    EXPECT_LE(most, 1e-9 * pressing);
    RecordProperty("largest_difference_over_pressing_" + std::to_string(count), std::to_string(most / pressing));
  }
}

/// On how many of three ranks the run throws an Error of this kind, when the last of them is asked to stop after so
/// many steps.
template <class Error>
int ranks_that_throw(const Case& run, int asked_after = -1) {
  std::atomic<int> thrown{0};
  mpm::run_ranks(3, [&](mpm::Communicator& ranks) {
    int asked = 0;
    mpm::SimulationOptions options;
    options.threads = 1;
    options.ranks = {&ranks, [](mpm::Communicator*) {}};
    options.stop = [&] { return ranks.rank() == 2 && asked_after >= 0 && ++asked > asked_after; };
    const mpm::Scene scene = scene_of(run);
    try {
      mpm::Simulation simulation(mpm::build(scene, &ranks), options);
      run_steps(simulation, run.steps);
    } catch (const Error&) {
      ++thrown;
    }
  });
  return thrown;
}

TEST(OverRanksBorder, StopsAllWhileTheSoilSettles) {
  const Case run{"plate_in_sleeping_sand", {"grid.max=[1.6, 0.5]", "bodies.bed.shape.box.max=[1.6, 0.2]"}};
  EXPECT_EQ(ranks_that_throw<mpm::StoppedError>(run, 5), 3);
}

TEST(OverRanksBorder, StopsAllWithinASyncPeriod) {
  EXPECT_EQ(ranks_that_throw<mpm::StoppedError>({"column_collapse", {"time.sync=0.02"}}, 5), 3);
}

// A particle that leaves the grid is on one rank; all say which.
TEST(OverRanksBorder, FailsOnAllWhereAParticleLeavesTheGrid) {
  const Case run{source_file("test/data/leaves_domain.yaml"), {}, 100'000};
  EXPECT_EQ(ranks_that_throw<mpm::PhysicsError>(run), 3);
}

// Others wait for a rank that cannot make its step: they cannot know why, and whoever runs them ends them.
TEST(OverRanksBorder, ReleasesOthersFromARankThatFailsInAStep) {
  const std::string load = "loads=[{body_force: {acceleration: [\"x > 1 && t > 0.01 ? log(0 - 1) : 0\", 0]}}]";
  try {
    ranks_that_throw<mpm::StoppedError>({"ranks_pair", {load}});
    FAIL() << "a load that is not a number";
  } catch (const mpm::RankFailure& error) {
    EXPECT_NE(std::string(error.what()).find("body force on 'bed'"), std::string::npos) << error.what();
  }
}

}  // namespace over_ranks_border_test
}  // namespace over_ranks
}  // namespace verification
