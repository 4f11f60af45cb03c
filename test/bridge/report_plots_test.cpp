// scripts/plot_report.py on the tables of an artificial run: every picture exists and shows something.
#include "mpm_ros/report/report_plots.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "mpm_ros/report/report.hpp"
#include "report_run.hpp"
#include "test_files.hpp"

namespace mpm_ros {
namespace report_plots_test {

const std::string kScript = source_file("scripts/plot_report.py");

class ReportPlotsTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ReportOptions options;
    options.bags = {folder_.path() + "/run.bag"};
    options.csv = csv_;
    test::HalfSineRun().write(options.bags.front());
    std::ostringstream out;
    ASSERT_TRUE(report(options, out, out, false));
  }

  /// Exit code of the script with these arguments.
  int plot(const std::string& arguments) const {
    return WEXITSTATUS(std::system(fmt::format("{} {} {} 2>{}", kScript, csv_, arguments, errors_).c_str()));
  }

  /// True if more than a hundredth of a picture is not white, with more than one colour.
  static bool shows_something(const std::string& picture) {
    const std::string look =
        "import sys, matplotlib.image as i; p = i.imread(sys.argv[1])[..., :3]; w = p.min(axis=2) < 0.95; "
        "sys.exit(0 if w.mean() > 0.01 and p[w].std() > 0.05 else 1)";
    return std::system(fmt::format("/usr/bin/python3 -c '{}' {}", look, picture).c_str()) == 0;
  }

  TemporaryFolder folder_;
  const std::string csv_ = folder_.path() + "/csv";
  const std::string plots_ = folder_.path() + "/plots";
  const std::string errors_ = folder_.path() + "/errors";
};

TEST_F(ReportPlotsTest, DrawsEveryPicture) {
  ASSERT_EQ(plot(plots_ + " --title test"), 0);
  for (const char* name : {"contact_tool", "energies", "audit", "section_vx", "view_vx"}) {
    const std::string picture = plots_ + "/" + name + ".png";
    ASSERT_TRUE(std::filesystem::exists(picture)) << picture;
    EXPECT_TRUE(shows_something(picture)) << picture;
  }
}

TEST_F(ReportPlotsTest, RefusesAFieldThatWasNotRecorded) {
  EXPECT_EQ(plot(plots_ + " --field temperature"), 2);
  std::ifstream file(errors_);
  std::stringstream text;
  text << file.rdbuf();
  EXPECT_NE(text.str().find("no particle field 'temperature'"), std::string::npos) << text.str();
}

TEST_F(ReportPlotsTest, RefusesAFolderWithoutTables) {
  std::filesystem::remove(csv_ + "/contact_forces.csv");
  EXPECT_EQ(plot(plots_), 2);
}

}  // namespace report_plots_test
}  // namespace mpm_ros
