// The figures that bag_report draws from a sweep's table.
#include "mpm_ros/report/report_sweep.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace mpm_ros {
namespace report_sweep_test {

TEST(ReportSweep, RanksCorrelateAsWorkedOutByHand) {
  // Ten pairs without ties: 1 - 6 sum d^2 / (n (n^2 - 1)), by hand with sum d^2 = 194.
  const std::vector<double> a = {86, 97, 99, 100, 101, 103, 106, 110, 112, 113};
  const std::vector<double> b = {2, 20, 28, 27, 50, 29, 7, 17, 6, 12};
  EXPECT_NEAR(rank_correlation(a, b), 1.0 - 6.0 * 194.0 / 990.0, 1e-14);
  // Ties: ranks 0, 1.5, 1.5, 3 against 0, 1, 2, 3, Pearson's correlation by hand: 4.5 / sqrt(4.5 * 5).
  EXPECT_NEAR(rank_correlation({1, 2, 2, 3}, {1, 20, 300, 4000}), 4.5 / std::sqrt(4.5 * 5.0), 1e-14);
  EXPECT_TRUE(std::isnan(rank_correlation({1, 1, 1}, {1, 2, 3})));
}

TEST(ReportSweep, AMetricIsThatOfTheRunsThatAreDone) {
  SweepTable table;
  table.header = {"run", "grid.cell", "method.update", "force", "state", "reason"};
  table.parameters = 2;
  table.metrics = 1;
  table.rows = {{"1", "0.1", "usf", "5", "done", ""},
                {"2", "0.2", "usf", "4", "done", ""},
                {"3", "0.3", "usl", "-100", "failed", "why"},
                {"4", "0.4", "usl", "", "done", ""},
                {"5", "0.5", "usl", "1.5", "done", ""}};
  const std::vector<SweepMetric> metrics = metrics_of(table);
  ASSERT_EQ(metrics.size(), 1U);
  EXPECT_EQ(metrics[0].name, "force");
  EXPECT_EQ(metrics[0].least, 1.5);
  EXPECT_EQ(metrics[0].least_run, "5");
  EXPECT_EQ(metrics[0].largest, 5.0);
  EXPECT_EQ(metrics[0].largest_run, "1");
  EXPECT_EQ(metrics[0].mean, 3.5);
  ASSERT_EQ(metrics[0].correlation.size(), 2U);
  EXPECT_NEAR(metrics[0].correlation[0], -1.0, 1e-15);
  EXPECT_TRUE(std::isnan(metrics[0].correlation[1]));
}

}  // namespace report_sweep_test
}  // namespace mpm_ros
