// Sorting particles whose order is not that of their places.
#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "mpm/grid/grid_layout.hpp"
#include "mpm/step/sorter.hpp"

namespace mpm {
namespace {

constexpr std::uint32_t kAwakeBefore = 4000;

ParticleSet set_of(const std::vector<std::uint32_t>& ids, int asleep) {
  ParticleSet set;
  set.highest = {40.0, 40.0, 0.0};
  set.asleep = asleep;
  set.id.resize(ids.size());
  set.x.assign(2, PaddedArray<double>(ids.size()));
  set.history.assign(1, ParticleScalar(Precision::float32, ids.size()));
  set.next_x.assign(2, PaddedArray<double>(ids.size()));
  set.rest_changes.assign(ids.size() / ParticleSet::kRestGroup + 1, 0);
  for (std::size_t p = 0; p < ids.size(); ++p) {
    std::mt19937 engine(ids[p]);
    std::uniform_real_distribution<double> place(0.0, 1.3);
    set.id[p] = ids[p];
    for (auto& x : set.x) x[p] = place(engine);
    set.history[0].set(p, ids[p] + 0.5);
  }
  return set;
}

std::vector<std::uint32_t> ids_of(const ParticleSet& set, int begin, int end) {
  return {set.id.begin() + begin, set.id.begin() + end};
}

struct Case {
  std::uint32_t leave, come;
  int asleep;
};

class ParticleOrderTest : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Cases, ParticleOrderTest,
                         testing::Values(Case{0, 0, 0}, Case{300, 500, 0}, Case{500, 20, 0}, Case{kAwakeBefore, 700, 0},
                                         Case{300, 500, 900}, Case{10, 800, 50}, Case{700, 200, 90}, Case{700, 20, 900},
                                         Case{kAwakeBefore, 0, 30}));

// 5 ms a case.
TEST_P(ParticleOrderTest, SortsAsIfParticlesLayInThatOrder) {
  const auto [leave, come, asleep] = GetParam();
  const auto tail = static_cast<std::uint32_t>(asleep), size = kAwakeBefore + tail;
  std::vector<std::uint32_t> ids(size);
  std::iota(ids.begin(), ids.end(), 0U);
  std::mt19937 engine(7);
  std::vector<std::uint32_t> left(kAwakeBefore);
  std::iota(left.begin(), left.end(), 0U);
  std::shuffle(left.begin(), left.end(), engine);
  left.resize(leave);
  std::sort(left.begin(), left.end());

  // Those that come have ids from `size` on, take the places of those that left, and count before the second half.
  ParticleSet set = set_of(ids, asleep);
  ParticleOrder order;
  order.begin_anew(set);
  std::vector<std::uint32_t> places = left;
  places.resize(std::min(leave, come));
  for (std::uint32_t more = size; places.size() < come; ++more) places.push_back(more);
  if (!places.empty() && places.back() >= size) ids.resize(places.back() + 1);
  for (std::uint32_t i = 0; i < come; ++i) ids[places[i]] = size + i;
  set = set_of(ids, asleep);
  std::vector<std::uint32_t> in_order;
  const auto stay = [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t p = begin; p < end; ++p) {
      if (std::binary_search(left.begin(), left.end(), p)) continue;
      order.add({p, 1});
      in_order.push_back(p);
    }
  };
  stay(0, kAwakeBefore / 2);
  for (std::uint32_t i = 0; i < come; ++i) {
    order.add({places[i], 1});
    in_order.push_back(size + i);
  }
  stay(kAwakeBefore / 2, kAwakeBefore);
  const auto awake = static_cast<int>(in_order.size());
  EXPECT_EQ(order.is_as_in_memory(set), leave + come == 0);

  const GridLayout layout(2, Vec3::Constant(0.1), Vec3::Zero(), Vec3::Constant(4.0));
  for (const int threads : {1, 3}) {
    std::vector<ParticleSet> sets{set}, expected{set_of(in_order, 0)};
    Fields fields = make_fields(layout, 1), fields_expected = make_fields(layout, 1);
    const std::vector<ParticleOrder> orders{order};
    ASSERT_FALSE(Sorter(threads).sort(sets, fields, &orders));
    ASSERT_FALSE(Sorter(1).sort(expected, fields_expected));
    const ParticleSet& sorted = sets[0];
    ASSERT_EQ(sorted.awake(), awake);
    EXPECT_EQ(ids_of(sorted, 0, awake), ids_of(expected[0], 0, awake));
    EXPECT_EQ(sorted.begin, expected[0].begin);
    EXPECT_EQ(sorted.group, expected[0].group);
    for (int p = 0; p < sorted.size(); ++p) {
      const ParticleSet one = set_of({sorted.id[p]}, 0);
      ASSERT_EQ(sorted.x[1][p], one.x[1][0]);
      ASSERT_EQ(sorted.history[0][p], one.history[0][0]);
    }
    EXPECT_EQ(sorted.next_x[1].size(), sorted.id.size());

    // Moves of those asleep are as few as can be.
    ASSERT_EQ(sorted.asleep, asleep);
    std::vector<std::uint32_t> sleepers = ids_of(sorted, awake, sorted.size()), all(tail);
    const auto moved = std::min<int>(asleep, std::abs(awake - static_cast<int>(kAwakeBefore)));
    int kept = 0;
    for (int p = awake; p < sorted.size(); ++p) kept += sorted.id[p] == static_cast<std::uint32_t>(p);
    EXPECT_EQ(kept, asleep - moved);
    std::iota(all.begin(), all.end(), kAwakeBefore);
    std::sort(sleepers.begin(), sleepers.end());
    EXPECT_EQ(sleepers, all);
    std::uint32_t changes = 0;
    for (const std::uint32_t of_group : sorted.rest_changes) changes += of_group;
    EXPECT_EQ(changes, static_cast<std::uint32_t>(moved));
  }
}

// Finds what has failed to be sorted by its number in the order.
TEST(ParticleOrder, NumbersPlaces) {
  ParticleSet set = set_of({0, 1, 2, 3, 4, 5, 6, 7}, 0);
  ParticleOrder order;
  order.begin_anew(set);
  order.add({5, 2});
  order.add({0, 3});
  order.add({3, 1});
  EXPECT_EQ(order.count(), 6U);
  EXPECT_EQ(order.end(), 7U);
  EXPECT_EQ(order.number_of(6), 1U);
  EXPECT_EQ(order.number_of(0), 2U);
  EXPECT_EQ(order.number_of(3), 5U);
  std::vector<std::size_t> places;
  order.each_span(1, 4, [&](std::size_t first, std::size_t end) {
    for (; first < end; ++first) places.push_back(first);
  });
  EXPECT_EQ(places, (std::vector<std::size_t>{6, 0, 1}));
}

}  // namespace
}  // namespace mpm
