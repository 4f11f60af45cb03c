// The order of particles after a sort, the groups that kernels process together, and the blocks of the grid.
#include "mpm/step/sorter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace mpm {
namespace sorter_test {

constexpr double kCell = 0.1;

struct Case {
  int dim;
  Grouping grouping;
};

/// Bodies of `counts` particles scattered over a domain of 40 cells without order. v[0] holds each particle's initial
/// index.
struct Bodies {
  Bodies(int dim, const std::vector<int>& counts, Precision precision = Precision::float64, int field_count = 1)
      : fields(make_fields(GridLayout(dim, Vec3::Constant(kCell), Vec3::Zero(), Vec3::Constant(4.0)), field_count)) {
    std::mt19937 engine(5);
    std::uniform_real_distribution<double> place(0.0, 1.3);
    std::uint32_t id = 0;
    for (const int count : counts) {
      ParticleSet set;
      set.precision = precision;
      set.highest = {40.0, 40.0, 40.0};
      set.id.resize(count);
      set.x.assign(dim, PaddedArray<double>(count));
      set.v.assign(dim, ParticleScalar(precision, count));
      for (int p = 0; p < count; ++p) {
        set.id[p] = id++;
        for (auto& x : set.x) x[p] = place(engine);
        set.v[0].set(p, p);
      }
      sets.push_back(std::move(set));
    }
  }
  /// The key of a particle's block, and the number of its nearest node in the block.
  std::pair<std::uint64_t, int> home(const ParticleSet& set, int p) const {
    std::array<int, 3> block{};
    int local = 0;
    for (int k = 0; k < grid.layout.dim(); ++k) {
      const int node = static_cast<int>(std::floor(set.x[k][p] / kCell + 0.5));
      block[k] = node / 4;
      local = 4 * local + node % 4;
    }
    return {grid.layout.key(block), local};
  }
  Fields fields;
  Grid& grid = *fields.front();
  std::vector<ParticleSet> sets;
};

class SorterTest : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Groupings, SorterTest,
                         testing::Values(Case{3, {1, Grouping::By::node}}, Case{3, {4, Grouping::By::node}},
                                         Case{3, {8, Grouping::By::column}}, Case{2, {4, Grouping::By::column}},
                                         Case{2, {3, Grouping::By::node}}, Case{1, {4, Grouping::By::column}},
                                         Case{1, {8, Grouping::By::node}}));

TEST_P(SorterTest, IsTheStableSortByBlockAndNodeForAnyNumberOfThreads) {
  for (const int threads : {1, 2, 3}) {
    Bodies bodies(GetParam().dim, {20000, 7, 500});
    const Bodies start(GetParam().dim, {20000, 7, 500});
    ASSERT_FALSE(Sorter(threads, GetParam().grouping).sort(bodies.sets, bodies.fields));
    for (std::size_t s = 0; s < bodies.sets.size(); ++s) {
      const ParticleSet &set = bodies.sets[s], &before = start.sets[s];
      std::vector<int> order(set.size());
      std::iota(order.begin(), order.end(), 0);
      std::stable_sort(order.begin(), order.end(),
                       [&](int a, int b) { return start.home(before, a) < start.home(before, b); });
      for (int p = 0; p < set.size(); ++p) {
        ASSERT_EQ(set.v[0][p], order[p]) << threads << " threads, set " << s;
        ASSERT_EQ(set.id[p], before.id[order[p]]);
        for (std::size_t k = 0; k < set.x.size(); ++k) ASSERT_EQ(set.x[k][p], before.x[k][order[p]]);
      }
    }
  }
}

TEST_P(SorterTest, OwnersHoldTheirOwnParticles) {
  Bodies bodies(GetParam().dim, {20000, 7, 500});
  ASSERT_FALSE(Sorter(2, GetParam().grouping).sort(bodies.sets, bodies.fields));
  const BlockTable& blocks = bodies.grid.blocks;
  for (const ParticleSet& set : bodies.sets) {
    ASSERT_EQ(set.begin.size(), static_cast<std::size_t>(blocks.owners()) + 1);
    EXPECT_EQ(set.begin.front(), 0U);
    EXPECT_EQ(set.begin.back(), set.id.size());
    for (int o = 0; o < blocks.owners(); ++o) {
      for (std::uint32_t p = set.begin[o]; p < set.begin[o + 1]; ++p) {
        ASSERT_EQ(bodies.home(set, static_cast<int>(p)).first, blocks.key(blocks.owner_block(o)));
      }
    }
  }
}

// Every particle is in exactly one group. A group is never longer than the lanes, never extends over more than one
// column or node, and is as long as possible.
TEST_P(SorterTest, GroupsCoverTheParticlesWithinOneColumnOrNode) {
  const Grouping grouping = GetParam().grouping;
  const int span = grouping.by == Grouping::By::column ? 4 : 1;
  Bodies bodies(GetParam().dim, {20000, 7, 500});
  ASSERT_FALSE(Sorter(2, grouping).sort(bodies.sets, bodies.fields));
  for (const ParticleSet& set : bodies.sets) {
    const auto place = [&](std::uint32_t p) {
      const auto [key, node] = bodies.home(set, static_cast<int>(p));
      return std::pair(key, node / span);
    };
    ASSERT_EQ(set.group_begin.size(), set.begin.size());
    ASSERT_EQ(set.group_begin.back() + 1, set.group.size());
    EXPECT_EQ(set.group.front(), 0U);
    EXPECT_EQ(set.group.back(), set.id.size());
    for (std::size_t o = 0; o < set.begin.size(); ++o) EXPECT_EQ(set.group[set.group_begin[o]], set.begin[o]);
    for (std::size_t g = 0; g + 1 < set.group.size(); ++g) {
      const std::uint32_t first = set.group[g], end = set.group[g + 1];
      ASSERT_LT(first, end);
      ASSERT_LE(end - first, static_cast<std::uint32_t>(grouping.lanes));
      for (std::uint32_t p = first; p < end; ++p) ASSERT_EQ(place(p), place(first));
      if (end < set.id.size() && place(end) == place(first)) {
        ASSERT_EQ(end - first, static_cast<std::uint32_t>(grouping.lanes));
      }
    }
  }
}

// Owners are numbered through all fields, and in each field a particle is in the block that it would have in one field.
TEST(Sorter, PartsTheFieldsAndTheSidesOfASet) {
  for (const int threads : {1, 3}) {
    Bodies bodies(2, {2000, 500, 60}, Precision::float64, 4);
    std::vector<std::uint8_t> side_of(2560);
    bodies.sets[1].field = 1;
    bodies.sets[1].far_field = 2;
    bodies.sets[2].field = 3;
    bodies.sets[1].side.resize(500);
    for (int p = 0; p < 500; ++p) {
      bodies.sets[1].side[p] = static_cast<std::uint8_t>(p % 3 == 0);
      side_of[bodies.sets[1].id[p]] = bodies.sets[1].side[p];
    }
    ASSERT_FALSE(Sorter(threads, {4, Grouping::By::column}).sort(bodies.sets, bodies.fields));
    std::array<std::uint32_t, 4> count{};
    int owners = 0;
    for (std::size_t f = 0; f < bodies.fields.size(); ++f) {
      const BlockTable& blocks = bodies.fields[f]->blocks;
      EXPECT_EQ(bodies.fields[f]->first_owner, owners);
      for (int o = 0; o < blocks.owners(); ++o) {
        for (const ParticleSet& set : bodies.sets) {
          for (std::uint32_t p = set.begin[owners + o]; p < set.begin[owners + o + 1]; ++p) {
            ASSERT_EQ(set.field + side_of[set.id[p]], static_cast<int>(f));
            ASSERT_EQ(set.field_of(static_cast<int>(p)), static_cast<int>(f));
            ASSERT_EQ(bodies.home(set, static_cast<int>(p)).first, blocks.key(blocks.owner_block(o)));
            ++count[f];
          }
        }
      }
      owners += blocks.owners();
    }
    EXPECT_EQ(count, (std::array<std::uint32_t, 4>{2000, 333, 167, 60}));
  }
}

TEST(Sorter, MovesEveryScalarInEitherPrecision) {
  for (const Precision precision : {Precision::float32, Precision::float64}) {
    Bodies bodies(3, {3000}, precision);
    ParticleSet& set = bodies.sets[0];
    set.start_x = set.x;
    for (int p = 0; p < set.size(); ++p) set.v[2].set(p, 0.5 * p);
    Sorter sorter(2, {4, Grouping::By::node});
    ASSERT_FALSE(sorter.sort(bodies.sets, bodies.fields));
    EXPECT_NE(set.id[0], 0U);
    const auto same = [&] {
      for (int p = 0; p < set.size(); ++p) {
        ASSERT_EQ(set.v[0][p], set.id[p]);
        ASSERT_EQ(set.v[2][p], 0.5 * set.id[p]);
        ASSERT_EQ(set.start_x[1][p], set.x[1][p]);
      }
    };
    same();
    // Sorts again, with the memory of the first sort.
    for (auto& x : set.x) {
      for (double& place : x) place += 0.7 * kCell;
    }
    set.start_x = set.x;
    ASSERT_FALSE(sorter.sort(bodies.sets, bodies.fields));
    same();
  }
}

TEST(Sorter, NamesTheFirstParticleThatIsOutside) {
  for (const double wrong : {-0.01, 4.01, std::numeric_limits<double>::quiet_NaN()}) {
    Bodies bodies(3, {100, 4000});
    bodies.sets[1].x[2][3999] = bodies.sets[1].x[1][1234] = wrong;
    const auto found = Sorter(3).sort(bodies.sets, bodies.fields);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->set, 1);
    EXPECT_EQ(found->index, 1234);
    EXPECT_EQ(bodies.sets[0].id[5], 5U);
  }
}

}  // namespace sorter_test
}  // namespace mpm
