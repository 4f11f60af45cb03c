// Owners are shared out by their particles, and no thread scatters where another still does.

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <numeric>
#include <random>

#include "mpm/grid/each_share.hpp"

namespace block_shares_test {

using mpm::BlockShares;
using mpm::BlockTable;
using mpm::GridLayout;
using mpm::Vec3;

/// A bed in some cells of which nothing lies, and which is deeper at one end; periodic across, if asked for.
struct Bed {
  explicit Bed(int dim, bool periodic = false) : layout(dim, {1, 1, 1}, {0, 0, 0}, Vec3::Constant(64)), table(layout) {
    if (periodic) layout.make_periodic(dim - 1);
    std::mt19937 engine(5);
    std::vector<std::uint64_t> keys;
    for (int x = 0; x < 12; ++x) {
      for (int y = 0; y < (dim > 1 ? 16 : 1); ++y) {
        for (int z = 0; z < (dim > 2 ? 1 + x / 3 : 1); ++z) {
          if (engine() % 5 != 0) keys.push_back(layout.key({x, y, z}));
        }
      }
    }
    std::sort(keys.begin(), keys.end());
    table.rebuild(keys);
    for (int o = 0; o < table.owners(); ++o) particles.push_back(1 + engine() % 512);
  }
  bool neighbours(int a, int b) const {
    const int* near = table.neighbours(a);
    return std::find(near, near + table.neighbour_count(), table.owner_block(b)) != near + table.neighbour_count();
  }
  int colour(int owner) const {
    for (int c = 0; c < table.colours(); ++c) {
      const std::vector<int>& of = table.owners_of_colour(c);
      if (std::binary_search(of.begin(), of.end(), owner)) return c;
    }
    return -1;
  }

  GridLayout layout;
  BlockTable table;
  std::vector<std::uint32_t> particles;
};

// A cut is at most half a block away from where it would be if blocks could be divided. A block counts by its particles
// and a little more, less than its particles here.
TEST(BlockShares, HaveTheSameNumberOfParticlesToABlock) {
  const Bed bed(3);
  const double all = std::accumulate(bed.particles.begin(), bed.particles.end(), 0.0);
  for (const int parts : {1, 2, 3, 7}) {
    BlockShares shares;
    shares.rebuild(bed.table, bed.particles, parts);
    ASSERT_EQ(shares.parts(), parts);
    EXPECT_EQ(shares.begin(0), 0);
    EXPECT_EQ(shares.begin(parts), bed.table.owners());
    for (int part = 0; part < parts; ++part) {
      const auto first = bed.particles.begin() + shares.begin(part),
                 end = bed.particles.begin() + shares.begin(part + 1);
      EXPECT_NEAR(std::accumulate(first, end, 0.0), all / parts, 512.0) << part << " of " << parts;
    }
  }
}

TEST(BlockShares, OfFewOwnersLeavePartsEmpty) {
  const GridLayout layout(1, {1, 1, 1}, {0, 0, 0}, {40, 1, 1});
  BlockTable table(layout);
  BlockShares shares;
  for (const int owners : {0, 1, 3}) {
    std::vector<std::uint64_t> keys;
    for (int o = 0; o < owners; ++o) keys.push_back(layout.key({2 * o}));
    if (owners > 0) table.rebuild(keys);
    shares.rebuild(table, {}, 5);
    std::atomic<int> visited{0};
    shares.at_once("loop", 5, [&](int) { ++visited; });
    shares.by_colour("loop", 5, [&](int) { ++visited; });
    EXPECT_EQ(visited, 2 * owners);
  }
}

// By definition: each owner once; of two whose tiles share nodes the one of the earlier colour is done before the other
// begins. Also with fewer threads than parts, and with more.
TEST(BlockShares, TakeNeighboursInTheOrderOfTheirColours) {
  for (const bool periodic : {false, true}) {
    for (const int dim : {1, 2, 3}) {
      const Bed bed(dim, periodic);
      const int owners = bed.table.owners();
      for (const int parts : {1, 2, 5}) {
        BlockShares shares;
        shares.rebuild(bed.table, bed.particles, parts);
        for (const int threads : {1, 2, 5, 8}) {
          std::atomic<int> clock{0};
          std::vector<int> began(owners, -1), ended(owners, -1), visits(owners, 0);
          shares.by_colour("loop", threads, [&](int owner) {
            began[owner] = clock++;
            for (std::uint32_t i = 0; i < 50 * bed.particles[owner]; ++i) clock.load();
            ++visits[owner];
            ended[owner] = clock++;
          });
          EXPECT_EQ(visits, std::vector<int>(owners, 1));
          for (int a = 0; a < owners; ++a) {
            for (int b = 0; b < owners; ++b) {
              if (bed.colour(a) < bed.colour(b) && bed.neighbours(a, b)) {
                EXPECT_LT(ended[a], began[b]);
              }
            }
          }
        }
      }
    }
  }
}

// Every owner is visited by one of the two, and its part of the work counts there alone.
TEST(BlockShares, OfMarkedOwnersDivideTheOwners) {
  const Bed bed(3);
  const int owners = bed.table.owners();
  BlockShares all, marked, others;
  all.rebuild(bed.table, bed.particles, 2);
  std::vector<std::uint8_t> marks(owners), rest(owners);
  double work = 0.0;
  for (int o = 0; o < owners; ++o) {
    marks[o] = o > owners / 2 && o % 7 != 0;
    rest[o] = marks[o] == 0;
    work += marks[o] != 0 ? bed.particles[o] : 0.0;
  }
  marked.rebuild_of(all, bed.table, marks);
  others.rebuild_of(all, bed.table, rest);
  std::vector<int> by_marked(owners, 0), by_others(owners, 0);
  marked.by_colour("loop", 2, [&](int owner) { ++by_marked[owner]; });
  others.by_colour("loop", 2, [&](int owner) { ++by_others[owner]; });
  for (int o = 0; o < owners; ++o) {
    EXPECT_EQ(by_marked[o], marks[o]) << o;
    EXPECT_EQ(by_others[o], rest[o]) << o;
  }
  double first = 0.0;
  for (int o = 0; o < marked.begin(1); ++o) first += marks[o] != 0 ? bed.particles[o] : 0.0;
  EXPECT_NEAR(first, work / 2, 512.0);
}

}  // namespace block_shares_test
