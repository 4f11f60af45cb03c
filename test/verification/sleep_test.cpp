// The error that sleep makes in the force on a tool, against what it saves, for speeds that count as rest. Costs 8 s.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "page.hpp"
#include "scene_run.hpp"

namespace verification {
namespace sleep_test {

struct Reached {
  double impulse = 0.0;         ///< on the plate, upwards [N s]
  double awake = 0.0;           ///< mean part of the particles that are awake
  double residual = 0.0;        ///< residual of the audit
  std::vector<double> surface;  ///< heights, the mean of the highest particles in columns of four cells [m]
};

std::vector<double> surface_of(const mpm::Simulation& run) {
  constexpr int kColumns = 40, kHighest = 8;
  const std::vector<double> x = field(run, "x"), z = field(run, "z");
  std::vector<std::vector<double>> of_column(kColumns);
  for (std::size_t p = 0; p < x.size(); ++p) {
    of_column[std::clamp(static_cast<int>(x[p] / 0.08), 0, kColumns - 1)].push_back(z[p]);
  }
  std::vector<double> heights;
  for (std::vector<double>& column : of_column) {
    std::sort(column.rbegin(), column.rend());
    column.resize(std::min<std::size_t>(column.size(), kHighest));
    double sum = 0.0;
    for (const double z_p : column) sum += z_p;
    heights.push_back(sum / static_cast<double>(column.size()));
  }
  return heights;
}

Reached run(const std::vector<std::string>& changes) {
  mpm::Simulation simulation = start("plate_in_sleeping_sand", changes);
  Reached reached;
  int periods = 0;
  for (; seconds(simulation) < 0.4 - 1e-9; ++periods) {
    simulation.advance();
    reached.awake += 1.0 - number(simulation, "asleep") / static_cast<double>(simulation.particles());
  }
  reached.awake /= periods;
  reached.impulse = simulation.take_contact(0).impulse.z();
  reached.residual = simulation.state().audit.residual;
  reached.surface = surface_of(simulation);
  return reached;
}

double farthest(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

// Runs that differ by the length of a step alone show what the force is certain to.
TEST(Sleep, ErrorAgainstWhatItSaves) {
  Page page("soil", "sleep", "Soil that sleeps: the error in a tool's force against what is saved");
  page.problem(
      "A plate 0.16 m wide is pressed at 0.1 m/s into a level bed of sand, 3.2 m by 0.2 m in cells of 2 cm, for 0.4 s. "
      "Blocks slower than `sleep.speed` sleep from the start; by default that is 4.4 mm/s here.");
  page.exact("the impulse on the plate of a run in which nothing sleeps", "the same method without sleep");
  page.scene("plate_in_sleeping_sand");
  const Reached without = run({});
  double scatter = 0.0;
  for (const char* cfl : {"time.cfl=0.48", "time.cfl=0.46"}) {
    scatter = std::max(scatter, std::abs(run({cfl}).impulse / without.impulse - 1.0));
  }
  page.report("impulse without sleep", without.impulse, "N s");
  page.report("scatter of the impulse with steps 4 to 8 % shorter", 100 * scatter, "%");
  Numbers speeds, errors, awake;
  for (const double speed : {0.5, 1.0, 2.0, 4.4, 10.0}) {  // mm/s
    const Reached with = run({fmt::format("sleep={{speed: {} mm/s, from_start: true}}", speed)});
    const double error = with.impulse / without.impulse - 1.0;
    speeds.push_back(speed);
    errors.push_back(100 * error);
    awake.push_back(100 * with.awake);
    page.report(fmt::format("{} mm/s: error of the impulse", speed), 100 * error, "%");
    page.report(fmt::format("{} mm/s: particles awake, mean", speed), 100 * with.awake, "%");
    EXPECT_LT(with.residual, 1e-10);
    if (speed == 4.4) {
      page.near("impulse with the default speed", with.impulse, without.impulse, 0.01, "N s");
      page.below("surface, largest difference with the default speed", farthest(with.surface, without.surface),
                 0.1 * 0.02, "m");
      page.below("particles awake with the default speed, mean", 100 * with.awake, 60, "%");
      const Reached longer = run({"grid.max=[12.8, 0.5]", "bodies.bed.shape.box.max=[12.8, 0.2]",
                                  "sleep={speed: 4.4 mm/s, from_start: true}"});
      page.near("particles awake in a bed four times as long, over those in this one", 4 * longer.awake / with.awake,
                1.0, 0.1, "1");
      page.near("impulse in a bed four times as long", longer.impulse, without.impulse, 0.01, "N s");
    }
  }
  for (const double balance : {0.4, 0.8}) {
    const Reached with = run({fmt::format("sleep={{speed: 4.4 mm/s, from_start: true, balance: {}}}", balance)});
    page.near(fmt::format("impulse with balance {}", balance), with.impulse, without.impulse, 0.01, "N s");
    page.report(fmt::format("balance {}: particles awake, mean", balance), 100 * with.awake, "%");
    EXPECT_LT(with.residual, 1e-10);
  }
  page.meaning(
      "Up to a tenth of the plate's speed sleep changes its impulse by less than 1 %, about what steps of another "
      "length "
      "do, and the surface by less than a tenth of a cell, while two thirds of the particles sleep. Blocks that wake "
      "only "
      "when the force on them has lost 0.4 or 0.8 of its balance, in place of a tenth, change the impulse no more. The "
      "audit closes to 1e-10.");
  const Numbers ends{speeds.front(), speeds.back()};
  page.figure()
      .panel("Error", "sleep.speed [mm/s]", "impulse over that without sleep, less 1 [%]")
      .log_x()
      .exact("steps of another length: at most", ends, {100 * scatter, 100 * scatter})
      .exact("and at least", ends, {-100 * scatter, -100 * scatter})
      .points("plate", speeds, errors);
  page.figure().panel("Work", "sleep.speed [mm/s]", "particles awake [%]").log_x().points("plate", speeds, awake);
}

}  // namespace sleep_test
}  // namespace verification
