// The executor's loops, scan and sort, and the table of cells, against counts by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "gpu_buffers.hpp"
#include "mpm_gpu/cells.hpp"

namespace gpu_cells_test {

using gpu_buffers::there;
using mpm_gpu::Buffer;
using mpm_gpu::Executor;
using mpm_gpu::Visits;

template <class T>
std::vector<T> here(const T* there, long count) {
  std::vector<T> numbers(static_cast<std::size_t>(count));
  mpm_gpu::card::download(numbers.data(), there, numbers.size() * sizeof(T));
  return numbers;
}

TEST(GpuExecutor, VisitsEveryIndexOnce) {
  for (const Visits visits : {Visits::forwards, Visits::backwards, Visits::shuffled}) {
    for (const int threads : {1, 3}) {
      for (const long count : {0L, 1L, 2L, 7L, 1000L}) {
        Buffer<int> counts = there(std::vector<int>(count));
        int* to = counts.data();
        Executor(visits, threads).for_each("test", count, [=](long i) { ++to[i]; });
        const std::vector<int> seen = counts.download();
        EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), count);
      }
    }
  }
}

TEST(GpuExecutor, ReducesInOneOrder) {
  constexpr long kCount = 1000;
  Buffer<double> partial;
  partial.fit(Executor::groups_of(kCount));
  const auto number = [](long i) { return 1.0 / static_cast<double>(i + 1); };
  const double sum = Executor().reduce<double>("test", kCount, number, partial);
  EXPECT_NEAR(sum, 7.485470860550345, 1e-14);  // the thousandth harmonic number
  EXPECT_EQ(sum, Executor(Visits::backwards).reduce<double>("test", kCount, number, partial));
  EXPECT_EQ(sum, Executor(Visits::shuffled, 3).reduce<double>("test", kCount, number, partial));
}

// More numbers than groups of groups: n (n + 1) / 2 of the whole numbers to n, which double sums exactly.
TEST(GpuExecutor, ReducesGroupsOfGroups) {
  constexpr long kCount = 200'000;
  Buffer<double> partial;
  partial.fit(Executor::groups_of(kCount));
  const auto number = [](long i) { return static_cast<double>(i + 1); };
  EXPECT_EQ(Executor().reduce<double>("test", kCount, number, partial), 20'000'100'000.0);
  EXPECT_EQ(Executor(Visits::shuffled, 3).reduce<double>("test", kCount, number, partial), 20'000'100'000.0);
}

TEST(GpuExecutor, ScansAndSorts) {
  Executor run;
  run.reserve(3000);
  Buffer<std::uint32_t> numbers = there<std::uint32_t>({3, 0, 5, 1, 0});
  run.exclusive_scan(numbers.data(), numbers.data(), 5);
  EXPECT_EQ(numbers.download(), (std::vector<std::uint32_t>{0, 3, 3, 8, 9}));

  std::mt19937_64 random(7);
  constexpr std::uint64_t kLimit = 1ULL << 40;
  std::vector<std::uint64_t> keys(3000);
  std::vector<std::uint32_t> values(3000);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    keys[i] = random() % 50 * (kLimit / 50);  // many are equal
    values[i] = static_cast<std::uint32_t>(i);
  }
  std::vector<std::uint32_t> expected = values;
  std::stable_sort(expected.begin(), expected.end(), [&](auto a, auto b) { return keys[a] < keys[b]; });
  Buffer<std::uint64_t> sorted = there(keys), other = there(keys);
  Buffer<std::uint32_t> order = there(values), room = there(values);
  run.stable_sort(sorted.data(), order.data(), other.data(), room.data(), 3000, kLimit);
  EXPECT_EQ(order.download(), expected);
  keys = sorted.download();
  EXPECT_TRUE(std::is_sorted(keys.begin(), keys.end()));
}

// Cells of 1 m, 16 of them along x and z: places of five particles in two sets.
TEST(GpuCells, SortsAndFindsBlocks) {
  mpm_gpu::GridView grid{};
  for (int k = 0; k < 2; ++k) {
    grid.inverse_cell[k] = 1.0;
    grid.last_node[k] = 16;
    grid.blocks_along[k] = (16 + 1 + mpm_gpu::kBeside) / mpm_gpu::kEdge + 2;
  }
  // Nearest nodes: (5, 1), (1, 1), (5, 1); of the other set (1, 1), (-1, 2).
  const std::vector<double> x = {5.2, 0.9, 4.6, 1.4, -0.8}, z = {1.1, 1.3, 0.6, 1.0, 2.0};
  const std::vector<std::uint32_t> id = {12, 10, 11, 13, 14};
  std::vector<mpm_gpu::SetView> sets(2);
  sets[0].count = 3;
  sets[0].first_id = 10;
  sets[1].first = 3;
  sets[1].count = 2;
  sets[1].first_id = 13;
  const Buffer<double> along_x = there(x), along_z = there(z);
  const Buffer<std::uint32_t> ids = there(id);
  const mpm_gpu::CellTable::Places places{{along_x.data(), along_z.data(), nullptr}, ids.data()};
  mpm_gpu::CellTable cells(grid, 2);
  Executor run(Visits::backwards);
  cells.make_room(run, places, sets);
  cells.sort(run, places, sets, mpm_gpu::CellTable::Counts::waits_for);
  const std::vector<std::uint32_t> order = here(cells.order(), 5);
  EXPECT_EQ(order, (std::vector<std::uint32_t>{1, 2, 0, 4, 3}));  // by cells, in one by ids
  // Blocks (0, 0), (1, 0) and (-1, 0) hold particles; with those around them they are 5 by 3.
  EXPECT_EQ(cells.blocks(), 15);
  const mpm_gpu::NodeView nodes = cells.view();
  ASSERT_EQ(nodes.nodes, 15 * 16);
  const std::vector<std::uint32_t> of = here(cells.node_of_particles(), 5), begin = here(nodes.begin, 2 * nodes.nodes),
                                   end = here(nodes.end, 2 * nodes.nodes);
  const std::uint32_t five_one = of[1], one_one = of[0];
  EXPECT_EQ(of[2], five_one);
  EXPECT_EQ(of[4], one_one);
  EXPECT_EQ(end[five_one] - begin[five_one], 2U);
  EXPECT_EQ(begin[five_one], 1U);
  EXPECT_EQ(end[nodes.nodes + one_one] - begin[nodes.nodes + one_one], 1U);
  EXPECT_EQ(begin[nodes.nodes + one_one], 4U);
  EXPECT_EQ(end[nodes.nodes + five_one], begin[nodes.nodes + five_one]);
  // The block of node (5, 1) is the one after that of (1, 1) along x; none is beside the outermost.
  const std::vector<std::int32_t> neighbours = here(nodes.neighbours, nodes.blocks * 9);
  EXPECT_EQ(neighbours[one_one / 16 * 9 + 7], static_cast<std::int32_t>(five_one / 16));
  EXPECT_EQ(neighbours[0], -1);
}

}  // namespace gpu_cells_test
