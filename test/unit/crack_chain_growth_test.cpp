// A crack's chain that grows, and that goes on from its stored state.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "crack_chain_check.hpp"
#include "mpm/crack/chain.hpp"

namespace mpm::test {
namespace crack_chain_test {

TEST(CrackChainGrowth, GrowsAtBothEnds) {
  Chain chain({{0, 0}, {1, 0}}, {CrackEnd::tip, CrackEnd::exterior}, false);
  displace(chain, {{0, 1}, {0, 1}}, {{0, -1}, {0, -1}});
  chain.grow(0, {{-1, 0}, {-2, 1}});
  ASSERT_EQ(chain.size(), 4);
  EXPECT_EQ(chain.point_at(0), 0);
  EXPECT_EQ(chain.point_at(1), 3);
  EXPECT_EQ(chain.line(), (std::vector<Vec2>{{-2, 1}, {-1, 0}, {0, 0}, {5, 0}}));
  EXPECT_EQ(chain.end(0), CrackEnd::tip);
  EXPECT_LT((chain.direction(0) - std::sqrt(0.5) * Vec2(-1, 1)).norm(), 1e-15);
  chain.grow(1, {{2, 0}, {2, 1}});
  EXPECT_EQ(chain.line().back(), Vec2(2, 5));
  // New points: all positions equal (crack reference 5.3); old ones keep theirs.
  for (const int k : {0, 1, 4, 5}) {
    const CrackPoint& point = chain.points()[k];
    EXPECT_EQ(point.above, point.place);
    EXPECT_EQ(point.below, point.place);
    EXPECT_EQ(point.start, point.place);
  }
  EXPECT_EQ(chain.opening(2), Vec2(0, 2));
  // They move as those do that were there, from their first step on.
  const Motions motion = all(chain, {{1.0, 0.0}, {2.0, 0.0}, true});
  chain.move(motion.data(), motion.data(), nullptr, 0.5, Move::average, kInfinity);
  EXPECT_EQ(chain.points()[0].place, Vec2(-2 + 0.5 - 0.25, 1));  // V t - 1/2 a t^2, V at the end
}

TEST(CrackChainGrowth, DividesStepsOfGrowth) {
  const Vec2 cells(0.1, 0.2), tip(1, 1);
  // int(2 (D / h + 0.25)) segments from D = 0.7 h on, below it one (crack reference 5.3).
  const std::map<double, std::size_t> segments{{0.1, 1},  {0.5, 1}, {0.69, 1}, {0.7, 1},
                                               {0.75, 2}, {1.0, 2}, {1.25, 3}, {2.5, 5}};
  for (const auto& [length, number] : segments) {
    const std::vector<Vec2> points = growth_points(tip, {1, 0}, length, cells);
    ASSERT_EQ(points.size(), number) << length;
    for (std::size_t k = 0; k < number; ++k) {
      const double part = static_cast<double>(k + 1) / static_cast<double>(number);
      EXPECT_LT((points[k] - (tip + Vec2(0.1 * length * part, 0))).norm(), 1e-15) << length;  // round-off
    }
  }
  // The edge of the cell is that along the larger component, and the step goes along the direction.
  EXPECT_EQ(cell_along({0.6, -0.8}, cells), 0.2);
  EXPECT_EQ(cell_along({-0.8, 0.6}, cells), 0.1);
  EXPECT_LT((growth_points(tip, {0.6, -0.8}, 0.5, cells)[0] - (tip + 0.1 * Vec2(0.6, -0.8))).norm(), 1e-15);
}

/// Keeps what it is given in memory.
class MemoryArchive final : public StateArchive {
 public:
  bool reading() const override { return reading_; }
  void read() { reading_ = true; }

 private:
  void values(const std::string& name, Number number, void* data, std::size_t count) override {
    const std::size_t width = number == Number::uint8                                 ? 1
                              : number == Number::float64 || number == Number::uint64 ? 8
                                                                                      : 4;
    std::vector<char>& kept = kept_[name];
    if (count == 0) return;
    if (!reading_) {
      kept.resize(width * count);
      std::memcpy(kept.data(), data, kept.size());
      counts_[name] = count;
    } else {
      ASSERT_EQ(kept.size(), width * count) << name;
      std::memcpy(data, kept.data(), kept.size());
    }
  }
  std::size_t stored(const std::string& name) override { return counts_[name]; }

  bool reading_ = false;
  std::map<std::string, std::vector<char>> kept_;
  std::map<std::string, std::size_t> counts_;
};

// A chain that has moved and grown goes on from its state as if it had not stopped.
TEST(CrackChainGrowth, GoesOnFromItsState) {
  const std::vector<Vec2> points{{0, 0}, {1, 0}, {2, 0.5}};
  Chain chain(points, {CrackEnd::exterior, CrackEnd::tip}, false), again = chain;
  const auto run = [](Chain& one, double time) {
    Motions above, below;
    for (int k = 0; k < one.size(); ++k) {
      above.push_back({Vec2(std::sin(time + k), 1.0), Vec2(0.3, time), k != 1});
      below.push_back({Vec2(std::cos(time + k), -1.0), Vec2(0.1, -time), k != 2});
    }
    one.move(above.data(), below.data(), above.data(), 0.1, Move::centre_of_mass, kInfinity);
  };
  run(chain, 1.0);
  chain.grow(1, {{3, 0.5}});
  chain.set_end(0, CrackEnd::none);
  run(chain, 2.0);
  MemoryArchive archive;
  chain.serialise(archive);
  archive.read();
  again.serialise(archive);
  EXPECT_EQ(again.line(), chain.line());
  EXPECT_EQ(again.end(0), CrackEnd::none);
  run(chain, 3.0);
  std::vector<double> expected, stopped, found;
  chain.hashed(expected);
  again.hashed(stopped);
  run(again, 3.0);
  again.hashed(found);
  EXPECT_EQ(found, expected);
  EXPECT_NE(stopped, expected);
  EXPECT_EQ(again.points()[3].start, Vec2(3, 0.5));
}

}  // namespace crack_chain_test
}  // namespace mpm::test
