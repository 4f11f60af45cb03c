// Tables of tips of cracks that grow, as run_scene writes them.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "mpm_ros/report/temporary_folder.hpp"
#include "mpm_ros/run/run_scene.hpp"
#include "test_files.hpp"

namespace mpm_ros {
namespace crack_tips_test {

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream text(line);
  for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
  return cells;
}

/// Numbers of a column of crack_tips.csv.
std::vector<double> column_of(const std::string& path, const std::string& heading) {
  std::ifstream file(path);
  std::string line;
  std::vector<double> values;
  std::getline(file, line);
  const std::vector<std::string> headings = cells_of(line);
  std::size_t column = 0;
  while (column < headings.size() && headings[column] != heading) ++column;
  EXPECT_LT(column, headings.size()) << heading << " is not in " << line;
  while (column < headings.size() && std::getline(file, line)) values.push_back(std::stod(cells_of(line).at(column)));
  return values;
}

// One of two rules has a limit that the pulled strip passes with its first wave, the other one a limit that it never
// reaches: 1e9 J/m^2 is millions of times the J of the handbooks, 330 J/m^2, and 1 m more than the strip is high. 2 s.
TEST(CrackTips, TellWhichRuleMadeThemGrow) {
  for (const bool alternate : {true, false}) {
    const TemporaryFolder folder;
    RunSceneOptions options;
    options.scene = source_file("config/scenes/edge_crack.yaml");
    options.set = {"cracks.growth={criterion: release_rate}", "cracks.alternate={criterion: opening}",
                   std::string("materials.aluminium.fracture=") +
                       (alternate ? "{j_ic: 1e9, opening_ic: 1e-12}" : "{j_ic: 1e-9, opening_ic: 1}"),
                   "time.end=2e-5"};
    options.threads = 1;
    options.csv = folder.file("csv");
    std::ostringstream out, err;
    ASSERT_EQ(run_scene(options, out, err, false, [] { return false; }), RunSceneResult::done) << err.str();
    const std::vector<double> growths = column_of(options.csv + "/crack_tips.csv", "growths [1]");
    const std::vector<double> by = column_of(options.csv + "/crack_tips.csv", "by alternate [1]");
    ASSERT_EQ(growths.size(), 6U);  // one tip at the start and after each of five sync periods
    EXPECT_EQ(growths.front(), 0.0);
    EXPECT_EQ(by.front(), 0.0);
    EXPECT_GE(growths.back(), 1.0);
    EXPECT_EQ(by.back(), alternate ? 1.0 : 0.0);
  }
}

}  // namespace crack_tips_test
}  // namespace mpm_ros
