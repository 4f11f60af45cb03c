// The layers of the project (doc/architecture.md): no ROS header in the solver library, and each folder of the library
// and of the ROS layer includes only folders of lower layers.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <string>
#include <vector>

#include "mpm/math/build_info.hpp"

namespace layers_test {

namespace fs = std::filesystem;

using Layers = std::map<std::string, int>;

const Layers kLayers = {
    {"math", 1},        {"loop", 1},       {"grid", 2},        {"particles", 2}, {"keys", 2},      {"shape", 3},
    {"material", 3},    {"rigid", 3},      {"ranks", 3},       {"step", 4},      {"kernel", 4},    {"robot", 4},
    {"mechanics", 5},   {"contact", 5},    {"boundary", 5},    {"sleep", 5},     {"transport", 5}, {"implicit", 6},
    {"crack", 6},       {"definition", 7}, {"rules", 8},       {"choice", 8},    {"modules", 9},   {"start", 9},
    {"simulation", 10}, {"pace", 11},      {"checkpoint", 11}, {"scene", 12},    {"yaml", 13},     {"terrain", 14},
    {"advice", 15},     {"building", 16},  {"sections", 16},   {"sweep", 17},    {"volumes", 5},   {"bed", 6}};
const Layers kRosLayers = {{"message", 1}, {"csv", 2},    {"command", 3}, {"sweep", 3}, {"aim", 4},     {"lead", 3},
                           {"report", 4},  {"record", 5}, {"run", 6},     {"node", 7},  {"sweeping", 7}};

struct Include {
  fs::path file;
  int line = 0;
  std::string folder;  // in which the file lies
  std::string header;  // as written between the quotes or brackets
};

std::vector<Include> includes_of(const std::string& library) {
  const std::regex pattern(R"re(^\s*#\s*include\s*[<"]([^>"]+)[>"])re");
  std::vector<Include> found;
  for (const char* root : {"include", "src"}) {
    const fs::path folder = fs::path(mpm::source_folder()) / root / library;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      if (!entry.is_regular_file()) continue;
      const std::string top = fs::relative(entry.path(), folder).begin()->string();
      std::ifstream stream(entry.path());
      std::string text;
      for (int line = 1; std::getline(stream, text); ++line) {
        std::smatch match;
        if (std::regex_search(text, match, pattern)) found.push_back({entry.path(), line, top, match[1]});
      }
    }
  }
  return found;
}

std::string place(const Include& include) {
  return include.file.string() + ":" + std::to_string(include.line) + " includes " + include.header;
}

void expect_only_lower_layers(const std::string& library, const Layers& layers) {
  const std::string prefix = library + "/";
  const auto includes = includes_of(library);
  ASSERT_FALSE(includes.empty());
  for (const auto& include : includes) {
    ASSERT_TRUE(layers.count(include.folder)) << include.file << " lies in a folder that has no layer";
    if (include.header.rfind(prefix, 0) != 0) continue;
    const std::string target = fs::path(include.header.substr(prefix.size())).begin()->string();
    if (library == "mpm_ros" && target.find('.') != std::string::npos) continue;  // a generated message
    ASSERT_TRUE(layers.count(target)) << place(include) << ", a folder that has no layer";
    if (target == include.folder) continue;
    EXPECT_LT(layers.at(target), layers.at(include.folder)) << place(include);
  }
}

TEST(Layers, LibraryIncludesNoRosHeader) {
  const std::regex ros(
      R"re(^(ros|rosbag|roslib|rosgraph_msgs|tf2?|tf2_\w+|catkin|diagnostic_updater|\w+_msgs|\w+_srvs|mpm_ros)/.*)re");
  const auto includes = includes_of("mpm");
  ASSERT_FALSE(includes.empty());
  for (const auto& include : includes) EXPECT_FALSE(std::regex_match(include.header, ros)) << place(include);
}

// Steps for a graphics processor are a library of their own, which programs reach through mpm_devices.
TEST(Layers, NothingIncludesStepsForAGraphicsProcessor) {
  for (const char* library : {"mpm", "mpm_ros", "mpm_ranks", "mpm_robots"}) {
    for (const auto& include : includes_of(library)) {
      EXPECT_NE(include.header.rfind("mpm_gpu/", 0), 0U) << place(include);
      EXPECT_NE(include.header.rfind("mpm_devices/", 0), 0U) << place(include);
    }
  }
  const auto own = includes_of("mpm_gpu");
  ASSERT_FALSE(own.empty());
  for (const auto& include : own) EXPECT_NE(include.header.rfind("mpm_ros/", 0), 0U) << place(include);
}

// So that every loop has a name in a profile, and how loops are shared out can change in one place.
TEST(Layers, ThreadsAreStartedInOneFile) {
  for (const char* root : {"include", "src"}) {
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(mpm::source_folder()) / root)) {
      if (!entry.is_regular_file() || entry.path().filename() == "loop.hpp") continue;
      std::ifstream stream(entry.path());
      const std::string text{std::istreambuf_iterator<char>(stream), {}};
      EXPECT_EQ(text.find("#pragma omp"), std::string::npos) << entry.path();
    }
  }
}

TEST(Layers, FoldersIncludeOnlyLowerLayers) {
  expect_only_lower_layers("mpm", kLayers);
  expect_only_lower_layers("mpm_ros", kRosLayers);
}

}  // namespace layers_test
