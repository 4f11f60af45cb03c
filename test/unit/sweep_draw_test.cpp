// Draws of a sweep: the same on every machine, independent, and distributed as they say.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "mpm/sweep/draw.hpp"

namespace mpm::sweep {
namespace sweep_draw_test {

constexpr std::uint64_t kSeed = 7;
constexpr int kMany = 20000;

std::vector<double> draws(const Distribution& distribution, const std::string& name = "grid.cell",
                          std::uint64_t seed = kSeed) {
  std::vector<double> values;
  for (int i = 0; i < kMany; ++i) values.push_back(draw(distribution, seed, name, static_cast<std::uint64_t>(i)));
  return values;
}

double mean_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double covariance_of(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  const double mean_a = mean_of(a), mean_b = mean_of(b);
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - mean_a) * (b[i] - mean_b);
  return sum / static_cast<double>(a.size());
}

/// Largest distance of the values' distribution from `cumulative` (Kolmogorov and Smirnov).
template <class Cumulative>
double distance(std::vector<double> values, const Cumulative& cumulative) {
  std::sort(values.begin(), values.end());
  double most = 0.0;
  const double count = static_cast<double>(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double expected = cumulative(values[i]), below = static_cast<double>(i) / count;
    most = std::max({most, std::abs(expected - below), std::abs(expected - below - 1.0 / count)});
  }
  return most;
}

// One sample in a hundred thousand lies further from its distribution than 2.47 / sqrt(n): 2 exp(-2 c^2) = 1e-5. The
// draws are the same in every run of this test, so it fails for a wrong formula alone.
const double kFar = 2.47 / std::sqrt(kMany);

// By an independent program, in Python's integers of any size: FNV-1a of the name, three times SplitMix64's finaliser,
// and the formula of Box and Muller for the normal draw.
TEST(SweepDraw, HasTheBitsOfAnotherProgram) {
  EXPECT_EQ(random_part(7, "grid.cell", 0), 0.8900278769351103);
  EXPECT_EQ(random_part(7, "grid.cell", 1), 0.9052166526724036);
  EXPECT_EQ(random_part(8, "materials.sand.young", 12, 3), 0.5892026273510877);
  Distribution uniform{Distribution::Kind::uniform, 20.0, 40.0};
  EXPECT_EQ(draw(uniform, 7, "grid.cell", 0), 37.8005575387);
  Distribution log_uniform{Distribution::Kind::log_uniform, 0.1, 10.0};
  EXPECT_EQ(draw(log_uniform, 7, "grid.cell", 1), 6.46298734205);
  Distribution normal;
  normal.kind = Distribution::Kind::normal;
  normal.mean = 0.3;
  normal.deviation = 0.05;
  EXPECT_EQ(draw(normal, 7, "grid.cell", 2), 0.301421138955);
}

TEST(SweepDraw, IsDistributedAsItSays) {
  const auto uniform = draws({Distribution::Kind::uniform, 20.0, 40.0});
  EXPECT_LT(distance(uniform, [](double x) { return (x - 20.0) / 20.0; }), kFar);
  const auto log_uniform = draws({Distribution::Kind::log_uniform, 0.1, 10.0});
  EXPECT_LT(distance(log_uniform, [](double x) { return 0.5 * (std::log10(x) + 1.0); }), kFar);
  Distribution normal;
  normal.kind = Distribution::Kind::normal;
  normal.mean = 3.0;
  normal.deviation = 2.0;
  const auto cumulative = [](double x) { return 0.5 * std::erfc(-(x - 3.0) / (2.0 * std::sqrt(2.0))); };
  EXPECT_LT(distance(draws(normal), cumulative), kFar);
  // Cut off at 2 and 4, half a deviation to each side.
  normal.from = 2.0;
  normal.to = 4.0;
  const double low = cumulative(2.0), high = cumulative(4.0);
  EXPECT_LT(distance(draws(normal), [&](double x) { return (cumulative(x) - low) / (high - low); }), kFar);
}

TEST(SweepDraw, HasNothingToDoWithOtherNamesSeedsAndNeighbours) {
  const Distribution unit{Distribution::Kind::uniform, 0.0, 1.0};
  const auto a = draws(unit), b = draws(unit, "grid.max"), c = draws(unit, "grid.cell", kSeed + 1);
  std::vector<double> next(a.begin() + 1, a.end());
  next.push_back(a.front());
  // The covariance of n independent pairs of variance 1/12 has a deviation of 1 / (12 sqrt(n)); five of them.
  const double most = 5.0 / (12.0 * std::sqrt(kMany));
  EXPECT_LT(std::abs(covariance_of(a, b)), most);
  EXPECT_LT(std::abs(covariance_of(a, c)), most);
  EXPECT_LT(std::abs(covariance_of(a, next)), most);
  EXPECT_NEAR(covariance_of(a, a), 1.0 / 12.0, 0.05 / 12.0);
}

TEST(SweepDraw, BoundsThatNoDrawMeetsGiveNoNumber) {
  Distribution normal;
  normal.kind = Distribution::Kind::normal;
  normal.from = 50.0;
  EXPECT_TRUE(std::isnan(draw(normal, kSeed, "grid.cell", 0)));
}

}  // namespace sweep_draw_test
}  // namespace mpm::sweep
