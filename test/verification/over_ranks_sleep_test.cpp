// Sleep over several ranks, which are threads here, against one process: the same blocks are asleep at every sync
// point, whatever wakes them (a blade that crosses ranks, waves, a lump of another velocity field that falls on them)
// and wherever the grid is divided meanwhile; forces and motion are those of one process, and checkpoints go on.
// Cost: 35 s on two processors.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "over_ranks_checkpoint.hpp"
#include "rank_counts.hpp"

namespace verification {
namespace over_ranks {
namespace over_ranks_sleep_test {

const Case kCase{"ranks_sleep", {}};

/// Values of every sync point.
struct History {
  std::vector<mpm::Vec3> forces;  ///< on the blade [N]
  std::vector<double> asleep;     ///< particles
  double pressing = 0.0;          ///< the most, on the blade [N]
  std::uint64_t divisions = 0, handed_over = 0;
  std::vector<std::uint64_t> divided_at;  ///< sync points at which the grid has been divided anew
  Outcome end;
};

History history_of(mpm::Simulation& simulation) {
  History history;
  const double before = simulation.state().energy.balance();
  while (seconds(simulation) < simulation.definition().time.end - 1e-9) {
    simulation.advance();
    const mpm::ContactReport report = simulation.take_contact(0);
    history.forces.push_back(report.mean.force);
    history.asleep.push_back(number(simulation, "asleep"));
    history.pressing = std::max(history.pressing, report.pressing);
    const mpm::SharingReport sharing = simulation.sharing();
    if (sharing.divisions > history.divisions) history.divided_at.push_back(history.asleep.size() - 1);
    history.divisions = sharing.divisions;
    history.handed_over = sharing.handed_over;
  }
  history.end = outcome_of(simulation);
  history.end.balance -= before;
  return history;
}

/// `count` 0: one process.
History history_on(int count) {
  if (count == 0) {
    mpm::Simulation simulation = start_on(kCase, nullptr);
    return history_of(simulation);
  }
  History of_first;
  mpm::run_ranks(count, [&](mpm::Communicator& ranks) {
    mpm::Simulation simulation = start_on(kCase, &ranks);
    History own = history_of(simulation);
    if (ranks.first()) of_first = std::move(own);
  });
  return of_first;
}

double largest_difference_of(const std::vector<mpm::Vec3>& a, const std::vector<mpm::Vec3>& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) most = std::max(most, (a[i] - b[i]).norm());
  return most;
}

// The blade goes through a sixth of the bed, which has an eighth of it on each of eight ranks at the start. Grains
// press and slide on its way, which makes more of round-off than a hundred steps of the other tests: 1e-9 of what
// presses.
TEST(OverRanksSleep, TheSameBlocksSleepAndWake) {
  const History one = history_on(0);
  const double particles = static_cast<double>(one.end.place[0].size());
  const auto least = std::min_element(one.asleep.begin(), one.asleep.end());
  ASSERT_GT(one.asleep.front(), 0.7 * particles) << "the bed sleeps from the start";
  ASSERT_LT(*least, one.asleep.front() - 0.2 * particles) << "the blade and the lump wake a part of it";
  ASSERT_GT(one.asleep.back(), *least + 0.1 * particles) << "which falls asleep again";
  ASSERT_GT(one.pressing, 0.0);
  for (const int count : mpm::test::rank_counts({1, 2, 3, 8}, 3)) {
    SCOPED_TRACE(count);
    const History over = history_on(count);
    EXPECT_EQ(over.asleep, one.asleep);
    ASSERT_EQ(over.forces.size(), one.forces.size());
    const double most = largest_difference_of(over.forces, one.forces);
    EXPECT_LE(most, 1e-9 * one.pressing);
    RecordProperty("largest_difference_over_pressing_" + std::to_string(count), std::to_string(most / one.pressing));
    expect_equal(over.end, one.end, 1e-9);
    if (count == 1) continue;
    EXPECT_GT(over.handed_over, 0U);
    const auto while_asleep = [&](std::uint64_t at) { return over.asleep[at] > 0.2 * particles; };
    EXPECT_GT(std::count_if(over.divided_at.begin(), over.divided_at.end(), while_asleep), 1);
  }
}

/// Steps at which the lump has woken a part of the bed, and the blade another.
constexpr std::uint64_t kWoken = 300;

// In the second scene a plate that comes down wakes what it presses on.
TEST(OverRanksSleep, MovesAsOnOneProcess) {
  const Case pressed{"plate_in_sleeping_sand", {"sleep={speed: 4.4 mm/s, from_start: true}"}, 600};
  for (const Case& run : {Case{kCase.scene, {}, kWoken}, pressed}) {
    SCOPED_TRACE(run.scene);
    const Outcome alone = run_alone(run);
    EXPECT_GT(alone.contacts[0].pressing, 0.0);
    for (const int count : mpm::test::rank_counts({1, 2, 3, 8}, 3)) {
      SCOPED_TRACE(count);
      expect_equal(run_over(run, count), alone, 1e-10);
    }
  }
}

TEST(OverRanksSleep, HasTheSameBitsAgain) {
  const Case run{kCase.scene, {}, kWoken};
  const Outcome first = run_over(run, 3), second = run_over(run, 3);
  EXPECT_EQ(first.state_hash, second.state_hash);
  EXPECT_EQ(first.memory_hash, second.memory_hash);
}

class OverRanksSleepCheckpoint : public testing::Test {
 protected:
  Outcome write(int count) const { return half_way_.write(run_, count); }
  Outcome go_on(int count) const { return half_way_.go_on(run_, count); }

  /// Means of stresses depend on when particles are sorted, as they are where others read a checkpoint.
  Case run_{kCase.scene, {"method.average_stress=false"}, kWoken};
  HalfWay half_way_;
};

TEST_F(OverRanksSleepCheckpoint, GoesOnToTheBitOnAsManyRanks) {
  for (const std::uint64_t steps : {kWoken, 2 * kWoken}) {
    SCOPED_TRACE(steps);
    run_.steps = steps;
    const Outcome whole = write(3), resumed = go_on(3);
    EXPECT_EQ(resumed.state_hash, whole.state_hash);
    EXPECT_EQ(resumed.memory_hash, whole.memory_hash);
  }
}

// Particles are sorted where another number of ranks reads them, and blocks that wait for a sort to fall asleep or wake
// may do so some steps earlier or later. At half of these steps none waits.
TEST_F(OverRanksSleepCheckpoint, IsReadByAnyNumberOfRanks) {
  run_.steps = 240;
  const Outcome whole = write(3);
  for (const int count : mpm::test::rank_counts({1, 2, 5}, 2)) {
    SCOPED_TRACE(count);
    expect_equal(go_on(count), whole, 1e-10);
  }
  const Outcome alone = write(1);
  SCOPED_TRACE("written by one process");
  expect_equal(go_on(4), alone, 1e-10);
}

}  // namespace over_ranks_sleep_test
}  // namespace over_ranks
}  // namespace verification
