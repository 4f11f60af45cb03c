#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "mpm/ranks/hand_over.hpp"
#include "mpm/ranks/lists.hpp"
#include "mpm/step/sorter.hpp"
#include "ranks_promises.hpp"

namespace mpm {
namespace {

constexpr double kCell = 0.1;

GridLayout layout_of(int dim) {
  return GridLayout(dim, Vec3::Constant(kCell), Vec3::Zero(), Vec3(6.0, dim == 3 ? 2.0 : kCell, 3.0));
}

// --- the grid's division ---------------------------------------------------------------------------------------------

/// Blocks of the domain with particles, of uneven numbers and some far fuller than the rest.
Territory::Load uneven_load(const GridLayout& layout) {
  Territory::Load load;
  std::array<int, 3> last{};
  for (int k = 0; k < layout.dim(); ++k) last[k] = layout.last_node(k) / kBlockEdge;
  std::array<int, 3> block{};
  std::uint64_t number = 0;
  for (block[0] = -1; block[0] <= last[0]; ++block[0]) {
    for (block[1] = 0; block[1] <= last[1]; ++block[1]) {
      for (block[2] = 0; block[2] <= last[2]; ++block[2], ++number) {
        if (number % 5 == 3) continue;
        load.emplace_back(layout.key(block), number % 17 == 0 ? 300 : 10 + number * number % 23);
      }
    }
  }
  return load;
}

/// Has the grid cut with this rank's part of the load, and gives the number of particles that each rank then has.
std::vector<std::uint64_t> shares_of(Communicator& ranks, const GridLayout& layout, const Territory::Load& load) {
  Territory territory(layout, ranks.size());
  Territory::Load own;
  for (std::size_t i = 0; i < load.size(); ++i) {
    if (static_cast<int>(i * 7 % 11) % ranks.size() == ranks.rank()) own.push_back(load[i]);
  }
  territory.cut(own, [&](double* numbers, int count) { ranks.sum(numbers, count); });
  std::vector<int> owners;
  std::vector<std::uint64_t> shares(static_cast<std::size_t>(ranks.size()), 0);
  for (const auto& [key, particles] : load) {
    owners.push_back(territory.owner(key));
    EXPECT_GE(owners.back(), 0);
    EXPECT_LT(owners.back(), ranks.size());
    shares.at(static_cast<std::size_t>(owners.back())) += particles;
  }
  for (const Communicator::Bytes& others : ranks.gather(bytes_of(owners))) {
    EXPECT_EQ(list_of<int>(others), owners) << "ranks do not agree whose a block is";
  }
  return shares;
}

void shares_are_within_a_block_of_even(Communicator& ranks) {
  for (const int dim : {1, 2, 3}) {
    const GridLayout layout = layout_of(dim);
    const Territory::Load load = uneven_load(layout);
    std::uint64_t all = 0, fullest = 0;
    for (const auto& [key, particles] : load) {
      all += particles;
      fullest = std::max(fullest, particles);
    }
    const double even = static_cast<double>(all) / ranks.size();
    for (const std::uint64_t share : shares_of(ranks, layout, load)) {
      // A cut lies where a block ends, up to a block after the place where an even part would.
      EXPECT_LE(std::abs(static_cast<double>(share) - even), static_cast<double>(fullest)) << dim << " axes";
    }
  }
}

void fewer_blocks_than_ranks_have_an_owner_each(Communicator& ranks) {
  const GridLayout layout = layout_of(2);
  const std::vector<std::uint64_t> shares = shares_of(ranks, layout, {{layout.key({3, 4, 0}), 1000}});
  EXPECT_EQ(std::count(shares.begin(), shares.end(), 1000), 1);
  EXPECT_EQ(std::accumulate(shares.begin(), shares.end(), std::uint64_t{0}), 1000U);
  const std::vector<std::uint64_t> none = shares_of(ranks, layout, {});
  EXPECT_EQ(std::accumulate(none.begin(), none.end(), std::uint64_t{0}), 0U);
}

// --- particles -------------------------------------------------------------------------------------------------------

constexpr std::uint32_t kCounts[] = {700, 500};  ///< particles of each set
constexpr std::uint32_t kLeaves = 7;             ///< a particle that leaves its set's bounds in the last round
constexpr int kRounds = 6;

/// Place of a particle in a round [m]: they go about, and gather in a corner, so that shares become uneven.
double position(std::uint32_t id, int k, int round) {
  if (id == kLeaves && round == kRounds - 1) return 1e3;
  constexpr std::array<double, 3> kSize{6.0, 2.0, 3.0};
  const double extent = k == 0 ? kSize[0] : kSize[static_cast<std::size_t>(k) % 3];
  const double whole = std::fmod(id * (0.37 + 0.21 * k) + 0.17 * round * (k + 1), 1.0);
  return 0.99 * extent * std::pow(whole, 1.0 + 0.6 * round);
}

/// Content of a particle in a column: exact in single precision.
double content(std::uint32_t id, int column) { return 2.0 * id + 4096.0 * column; }

/// Visits every column that has to travel, the positions apart, with its number.
template <class Visit>
void each_content(ParticleSet& set, Visit&& visit) {
  int column = 0;
  set.each_scalar([&](auto& values) {
    if (column >= static_cast<int>(set.x.size())) visit(column, values);
    ++column;
  });
}

void put_in_place(ParticleSet& set, int round) {
  for (std::size_t k = 0; k < set.x.size(); ++k) {
    for (int p = 0; p < set.size(); ++p) set.x[k][p] = position(set.id[p], static_cast<int>(k), round);
  }
}

/// The particles that one of so many ranks begins with, dealt out by id: one set with all that a set can have, and a
/// plain one.
std::vector<ParticleSet> dealt(int rank, int ranks, const GridLayout& layout) {
  std::vector<ParticleSet> sets(2);
  std::uint32_t first = 0;
  for (std::size_t s = 0; s < sets.size(); ++s) {
    ParticleSet& set = sets[s];
    std::vector<std::uint32_t> ids;
    for (std::uint32_t id = first; id < first + kCounts[s]; ++id) {
      if (static_cast<int>(id) % ranks == rank) ids.push_back(id);
    }
    const auto count = static_cast<std::uint32_t>(ids.size());
    set.precision = s == 0 ? Precision::float32 : Precision::float64;
    set.first_id = first;
    for (int k = 0; k < layout.dim(); ++k) set.highest[k] = layout.last_node(k);
    set.id.assign(count, 0);
    std::copy(ids.begin(), ids.end(), set.id.begin());
    first += kCounts[s];
    const auto scalars = [&](int number) {
      return std::vector<ParticleScalar>(static_cast<std::size_t>(number), ParticleScalar(set.precision, count));
    };
    const auto doubles = [&] { return std::vector<PaddedArray<double>>(layout.dim(), PaddedArray<double>(count)); };
    set.x = doubles();
    set.v = scalars(layout.dim());
    set.f = scalars(4);
    set.tau = scalars(4);
    if (s == 0) {
      set.history = scalars(3);
      set.masses = scalars(1);
      set.surface = scalars(1);
      set.affine = scalars(4);
      set.domain = scalars(4);
      set.start_x = doubles();
      set.next_x = doubles();
      set.bring("temperature", "K");
      set.far_field = 1;
      set.side.assign(count, 0);
      for (std::uint32_t p = 0; p < count; ++p) set.side[p] = set.id[p] % 3 == 1;
    }
    each_content(set, [&](int column, auto& values) {
      for (int p = 0; p < set.size(); ++p) values[p] = content(set.id[p], column);
    });
    put_in_place(set, 0);
  }
  return sets;
}

void expect_contents(ParticleSet& set) {
  int wrong = 0;
  each_content(set, [&](int column, auto& values) {
    ASSERT_EQ(values.size(), set.id.size()) << "column " << column;
    for (int p = 0; p < set.size(); ++p) wrong += values[p] != content(set.id[p], column);
  });
  for (int p = 0; p < set.size() && set.far_field != set.field; ++p) wrong += set.side[p] != (set.id[p] % 3 == 1);
  EXPECT_EQ(wrong, 0);
  for (const auto& scalar : set.next_x) EXPECT_EQ(scalar.size(), set.id.size());
  for (const auto& scalar : set.domain) EXPECT_EQ(scalar.size(), set.id.size());
}

std::set<std::uint32_t> ids_of(const std::vector<ParticleSet>& sets) {
  std::set<std::uint32_t> ids;
  for (const ParticleSet& set : sets) ids.insert(set.id.begin(), set.id.end());
  return ids;
}

/// All particles are there once, in their own sets, and on the rank whose block they are in.
void expect_in_place(Communicator& ranks, const Territory& territory, const GridLayout& layout,
                     std::vector<ParticleSet>& sets, bool one_left) {
  for (std::size_t s = 0; s < sets.size(); ++s) {
    ParticleSet& set = sets[s];
    std::vector<std::uint32_t> all = gather_list(ranks, std::vector<std::uint32_t>(set.id.begin(), set.id.end()));
    std::sort(all.begin(), all.end());
    std::vector<std::uint32_t> expected(kCounts[s]);
    std::iota(expected.begin(), expected.end(), set.first_id);
    EXPECT_EQ(all, expected) << "set " << s;
    int astray = 0;
    for (int p = 0; p < set.size(); ++p) {
      if (one_left && set.id[p] == kLeaves) continue;
      std::array<int, 3> block{};
      for (int k = 0; k < layout.dim(); ++k) {
        block[k] = GridLayout::nearest(layout.in_cells(k, set.x[k][p])) / kBlockEdge;
      }
      astray += territory.owner(layout.key(block)) != ranks.rank();
    }
    EXPECT_EQ(astray, 0) << "set " << s;
    expect_contents(set);
  }
}

void particles_go_to_the_rank_of_their_block(Communicator& ranks) {
  for (const int dim : {1, 2, 3}) {
    const GridLayout layout = layout_of(dim);
    Territory territory(layout, ranks.size());
    HandOver hand_over(ranks, territory, layout);
    std::vector<ParticleSet> sets = dealt(ranks.rank(), ranks.size(), layout);
    hand_over.divide(sets);
    const std::uint64_t dealt_out = hand_over.handed_over();
    expect_in_place(ranks, territory, layout, sets, false);
    double came = 0.0;
    for (int round = 1; round < kRounds; ++round) {
      const std::set<std::uint32_t> before = ids_of(sets);
      for (ParticleSet& set : sets) put_in_place(set, round);
      hand_over.hand_over(sets);
      hand_over.settle(sets);
      const bool one_left = round == kRounds - 1;
      expect_in_place(ranks, territory, layout, sets, one_left);
      const std::set<std::uint32_t> after = ids_of(sets);
      for (const std::uint32_t id : after) came += before.count(id) == 0;
      if (one_left) {
        EXPECT_EQ(after.count(kLeaves), before.count(kLeaves)) << "what is outside stays where it was";
      }
    }
    const double went = static_cast<double>(hand_over.handed_over() - dealt_out);
    EXPECT_EQ(ranks.sum(came), ranks.sum(went)) << dim << " axes";
    if (ranks.size() > 1) {
      EXPECT_GT(ranks.sum(went), 0.0);
      EXPECT_GT(hand_over.divisions(), 1U) << "they gather in a corner";
    }
    // Division helps where nothing moves any more, and only as often as it does.
    hand_over.hand_over(sets);
    hand_over.settle(sets);
    const double held = hand_over.imbalance();
    for (int again = 0; again < 4; ++again) {
      hand_over.hand_over(sets);
      hand_over.settle(sets);
    }
    EXPECT_LE(hand_over.imbalance(), held);
    const std::uint64_t divided = hand_over.divisions();
    hand_over.hand_over(sets);
    EXPECT_EQ(hand_over.divisions(), divided);
  }
}

void put_in_order_of_ids(ParticleSet& set) {
  std::vector<int> order(set.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return set.id[a] < set.id[b]; });
  const auto permute = [&](auto& values) {
    const auto before = values;
    for (std::size_t p = 0; p < order.size(); ++p) values[p] = before[order[p]];
  };
  set.each_scalar(permute);
  if (!set.side.empty()) permute(set.side);
  permute(set.id);
}

/// Ids of the particles of each set's blocks, in their order.
using Order = std::map<std::pair<std::size_t, std::uint64_t>, std::vector<std::uint32_t>>;
Order order_of(const std::vector<ParticleSet>& sets, const Fields& fields) {
  const std::vector<std::uint64_t> keys = owner_keys(fields);
  Order order;
  for (std::size_t s = 0; s < sets.size(); ++s) {
    for (std::size_t owner = 0; owner < keys.size(); ++owner) {
      const auto first = sets[s].id.begin();
      if (sets[s].begin[owner] == sets[s].begin[owner + 1]) continue;
      order[{s, keys[owner]}].assign(first + sets[s].begin[owner], first + sets[s].begin[owner + 1]);
    }
  }
  return order;
}

// So that they are computed in the same groups, whatever the number of ranks.
void particles_keep_the_order_of_one_process(Communicator& ranks) {
  const GridLayout layout = layout_of(2);
  Territory territory(layout, ranks.size());
  HandOver hand_over(ranks, territory, layout);
  std::vector<ParticleSet> all = dealt(0, 1, layout), own = dealt(ranks.rank(), ranks.size(), layout);
  Fields of_all = make_fields(layout, 2), of_own = make_fields(layout, 2);
  Sorter sorter_of_all(1), sorter_of_own(1);
  hand_over.divide(own);
  for (ParticleSet& set : own) put_in_order_of_ids(set);  // as a run begins
  std::uint64_t blocks = 0;
  for (int round = 0; round < kRounds - 1; ++round) {  // in the last one a particle leaves
    for (auto* sets : {&all, &own}) {
      for (ParticleSet& set : *sets) put_in_place(set, round);
    }
    EXPECT_FALSE(sorter_of_all.sort(all, of_all));
    hand_over.hand_over(own, round == 0 ? std::vector<std::uint64_t>() : owner_keys(of_own));
    EXPECT_FALSE(sorter_of_own.sort(own, of_own, &hand_over.orders()));
    Order expected = order_of(all, of_all);
    for (const auto& [block, ids] : order_of(own, of_own)) {
      EXPECT_EQ(ids, expected[block]) << "round " << round;
      ++blocks;
    }
  }
  EXPECT_GT(blocks, 0U);
}

}  // namespace

std::vector<RanksPromise> hand_over_promises() {
  return {{"SharesAreWithinABlockOfEven", shares_are_within_a_block_of_even},
          {"FewerBlocksThanRanksHaveAnOwnerEach", fewer_blocks_than_ranks_have_an_owner_each},
          {"ParticlesGoToTheRankOfTheirBlock", particles_go_to_the_rank_of_their_block},
          {"ParticlesKeepTheOrderOfOneProcess", particles_keep_the_order_of_one_process}};
}

}  // namespace mpm
