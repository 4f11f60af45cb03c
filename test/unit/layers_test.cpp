// The shape of the house (doc/architecture.md): no ROS header in the solver library, and each room includes only
// rooms of lower floors.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

const std::map<std::string, int> kFloors = {{"math", 1},     {"grid", 2},     {"particles", 2},  {"shape", 3},
                                            {"material", 3}, {"rigid", 3},    {"step", 4},       {"mechanics", 5},
                                            {"contact", 5},  {"boundary", 5}, {"simulation", 6}, {"scene", 7}};

struct Include {
  fs::path file;
  int line = 0;
  std::string room;    // that the file lies in
  std::string header;  // as written between the quotes or brackets
};

std::vector<Include> includes_of_library() {
  const std::regex pattern(R"re(^\s*#\s*include\s*[<"]([^>"]+)[>"])re");
  std::vector<Include> found;
  for (const char* root : {"include/mpm", "src/mpm"}) {
    const fs::path folder = fs::path(MPM_SOURCE_DIR) / root;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      if (!entry.is_regular_file()) continue;
      const std::string room = fs::relative(entry.path(), folder).begin()->string();
      std::ifstream stream(entry.path());
      std::string text;
      for (int line = 1; std::getline(stream, text); ++line) {
        std::smatch match;
        if (std::regex_search(text, match, pattern)) found.push_back({entry.path(), line, room, match[1]});
      }
    }
  }
  return found;
}

std::string place(const Include& include) {
  return include.file.string() + ":" + std::to_string(include.line) + " includes " + include.header;
}

}  // namespace

TEST(Layers, LibraryIncludesNoRosHeader) {
  const std::regex ros(
      R"re(^(ros|rosbag|roslib|rosgraph_msgs|tf2?|tf2_\w+|catkin|diagnostic_updater|\w+_msgs|\w+_srvs|mpm_ros)/.*)re");
  const auto includes = includes_of_library();
  ASSERT_FALSE(includes.empty());
  for (const auto& include : includes) EXPECT_FALSE(std::regex_match(include.header, ros)) << place(include);
}

TEST(Layers, RoomsIncludeOnlyLowerFloors) {
  for (const auto& include : includes_of_library()) {
    ASSERT_TRUE(kFloors.count(include.room)) << include.file << " lies in a room that has no floor";
    if (include.header.rfind("mpm/", 0) != 0) continue;
    const std::string target = fs::path(include.header.substr(4)).begin()->string();
    ASSERT_TRUE(kFloors.count(target)) << place(include) << ", a room that has no floor";
    if (target == include.room) continue;
    EXPECT_LT(kFloors.at(target), kFloors.at(include.room)) << place(include);
  }
}
